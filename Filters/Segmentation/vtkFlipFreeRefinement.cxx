#include "vtkFlipFreeRefinement.h"

#include "ContourMeshAdapter.h"
#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "Guard/SurfaceRefinement.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFlipFreeRefinement);

int vtkFlipFreeRefinement::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  try
  {
    const FlipFree::DeformableSurface surface = FlipFree::DeformableSurfaceOf(
      vtkPolyData::GetData(inputVector[0]), "the surface{ on port 0}", this->Check);
    const FlipFree::RefinedSurface refined = FlipFree::RefineSurface(surface.Mesh, surface.Points,
      this->Check, FlipFree::SMPFor, FlipFree::MonitorOf(this));
    if (FlipFree::IsAborted(this))
    {
      return 1;
    }
    if (!refined.Embedded)
    {
      throw FlipFree::Error(FlipFree::ErrorCode::SelfIntersecting,
        "the surface{ on port 0} is folded too sharply; smooth it, or deform it with more fairing");
    }
    FlipFree::AttachMesh(refined.Mesh, refined.Points, output);
    FlipFree::AttachCertificate(this->Check, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    FlipFreeErrorMacro("Nothing refined: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Check: " << this->Check << "\n";
}

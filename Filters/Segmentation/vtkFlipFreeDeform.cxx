#include "vtkFlipFreeDeform.h"

#include "ContourMeshAdapter.h"
#include "Deformation/DeformationStep.h"
#include "ExecutionAdapter.h"
#include "FieldData.h"
#include "PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>

vtkStandardNewMacro(vtkFlipFreeDeform);

int vtkFlipFreeDeform::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  FlipFree::DeformationStepSettings settings;
  settings.AvoidFlips = this->AvoidFlips;
  settings.FlipThreshold = this->FlipThreshold;
  settings.Propagation.Iterations = this->PropagationIterations;
  settings.Propagation.SmoothingIterations = this->SmoothingIterations;
  settings.Energy.PositionWeight = this->PositionWeight;
  settings.Energy.UniformWeight = this->UniformWeight;
  settings.Energy.Fairing = this->Fairing;
  try
  {
    FlipFree::RequireNumbers(
      { { "FlipThreshold", this->FlipThreshold }, { "PositionWeight", this->PositionWeight },
        { "UniformWeight", this->UniformWeight }, { "Fairing", this->Fairing } });
    FlipFree::DeformableSurface surface =
      FlipFree::DeformableSurfaceOf(input, "the surface on port 0", this->Guard);
    FlipFree::CorrespondenceField field = FlipFree::FieldOf(input, "the surface on port 0");
    std::unique_ptr<FlipFree::EmbeddingGuard> guard;
    if (this->Guard)
    {
      guard = std::make_unique<FlipFree::EmbeddingGuard>(surface.Mesh);
    }
    FlipFree::DeformationSolver solver(surface.Mesh);
    const FlipFree::DeformationStepReport report = FlipFree::DeformOnce(solver, guard.get(),
      settings, FlipFree::SMPFor, FlipFree::MonitorOf(this), field, surface.Points);
    if (FlipFree::IsAborted(this))
    {
      return 1;
    }
    output->ShallowCopy(input);
    output->SetPoints(FlipFree::MakePoints(surface.Points));
    // Those of the surface that was.
    output->GetPointData()->SetNormals(nullptr);
    output->GetPointData()->SetTangents(nullptr);
    output->GetCellData()->SetNormals(nullptr);
    output->GetCellData()->SetTangents(nullptr);
    FlipFree::AttachField(field, output);
    FlipFree::AddFieldValues("FlippingVertices", { static_cast<double>(report.Flipping) }, output);
    FlipFree::AddFieldValues("GuardedVertices", { static_cast<double>(report.Guarded) }, output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro("Nothing deformed: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeDeform::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "AvoidFlips: " << this->AvoidFlips << "\n";
  os << indent << "FlipThreshold: " << this->FlipThreshold << "\n";
  os << indent << "PropagationIterations: " << this->PropagationIterations << "\n";
  os << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "PositionWeight: " << this->PositionWeight << "\n";
  os << indent << "UniformWeight: " << this->UniformWeight << "\n";
  os << indent << "Fairing: " << this->Fairing << "\n";
  os << indent << "Guard: " << this->Guard << "\n";
}

#include "vtkSurfaceToLabelMap.h"

#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "LabelAdapter.h"
#include "Mesh/SurfaceVoxelization.h"
#include "PipelineAdapter.h"
#include "SurfaceAdapter.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceToLabelMap);

vtkSurfaceToLabelMap::vtkSurfaceToLabelMap()
{
  this->SetNumberOfInputPorts(2);
}

void vtkSurfaceToLabelMap::SetReferenceImageData(vtkImageData* image)
{
  this->SetInputData(1, image);
}

void vtkSurfaceToLabelMap::SetReferenceImageConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

int vtkSurfaceToLabelMap::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

int vtkSurfaceToLabelMap::RequestInformation(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  FlipFree::AnnounceLabelMap(inputVector[1]->GetInformationObject(0),
    outputVector->GetInformationObject(0));
  return 1;
}

int vtkSurfaceToLabelMap::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkImageData* reference = vtkImageData::GetData(inputVector[1]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize();
  try
  {
    if (reference->GetNumberOfPoints() == 0)
    {
      throw FlipFree::Error(FlipFree::ErrorCode::InvalidGeometry,
        "the reference image{ on port 1} has no voxels; give it a non-empty extent");
    }
    FlipFree::RequireProperGrid(reference, "the reference image{ on port 1}");
    const FlipFree::PolygonalSurface surface =
      FlipFree::SurfaceOf(vtkPolyData::GetData(inputVector[0]), "the surface{ on port 0}");
    std::vector<FlipFree::VoxelRun> runs;
    if (!FlipFree::VoxelizeSurface(surface.Points, surface.Triangles,
          FlipFree::GeometryOf(reference), FlipFree::SMPFor, FlipFree::MonitorOf(this), runs) ||
      FlipFree::IsAborted(this))
    {
      return 1;
    }
    FlipFree::MakeLabelMap(runs, static_cast<unsigned char>(this->LabelValue), reference, output);
  }
  catch (const std::exception& error)
  {
    FlipFreeErrorMacro("No label map: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkSurfaceToLabelMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LabelValue: " << this->LabelValue << "\n";
}

#include "vtkFlipFreeVesselSegmentation.h"

#include "ContourMeshAdapter.h"
#include "ConvergenceTable.h"
#include "ExecutionAdapter.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"
#include "Vessel/VesselParameters.h"
#include "VesselOutputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <string>

vtkStandardNewMacro(vtkFlipFreeVesselSegmentation);

using Stage = vtkFlipFreeVesselSegmentation;

#define PROPERTIES(P) FLIPFREE_VESSEL_SURFACE_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkFlipFreeVesselSegmentation::vtkFlipFreeVesselSegmentation()
{
  this->SetNumberOfOutputPorts(4);
}

vtkPolyData* vtkFlipFreeVesselSegmentation::GetSurface()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkImageData* vtkFlipFreeVesselSegmentation::GetLabelMap()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPolyData* vtkFlipFreeVesselSegmentation::GetCenterline()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

vtkTable* vtkFlipFreeVesselSegmentation::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(3));
}

const char* vtkFlipFreeVesselSegmentation::GetStopReasonAsString() const
{
  return FlipFree::ToString(static_cast<FlipFree::StopReason>(this->StopReason));
}

int vtkFlipFreeVesselSegmentation::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[4] = { "vtkPolyData", "vtkImageData", "vtkPolyData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

int vtkFlipFreeVesselSegmentation::RequestInformation(vtkInformation*,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  FlipFree::AnnounceLabelMap(inputs[0]->GetInformationObject(0), outputs->GetInformationObject(1));
  return 1;
}

int vtkFlipFreeVesselSegmentation::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  const auto clear = [outputs]
  {
    for (int port = 0; port < 4; ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
  };
  clear();
  this->StopReason = static_cast<int>(FlipFree::StopReason::NotRun);
  this->NumberOfSelfIntersections = -1;
  std::fill_n(this->StageSeconds, 4, 0.0);
  try
  {
    this->Segment(vtkImageData::GetData(inputs[0]), outputs);
  }
  catch (const std::exception& error)
  {
    clear();
    this->StopReason = static_cast<int>(FlipFree::StopReason::NotRun);
    vtkErrorMacro("No segmentation: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeVesselSegmentation::Segment(vtkImageData* image, vtkInformationVector* outputs)
{
  this->RequireProperties();
  const std::string name = "the image on port 0";
  FlipFree::RequireGrayImage(image, name);
  const FlipFree::VesselSegmentation result =
    FlipFree::SegmentVessel(FlipFree::GrayVolumeOf(image, name), name, this->Points->List(),
      *this->Settings, FlipFree::SMPThreading(), FlipFree::MonitorOf(this, 0, 0.95));
  std::copy(result.StageSeconds.begin(), result.StageSeconds.end(), this->StageSeconds);
  this->StopReason = static_cast<int>(result.Surface.Reason);
  FlipFree::FillConvergenceTable(result.Surface.Iterations, vtkTable::GetData(outputs, 3));
  if (result.Surface.Reason == FlipFree::StopReason::Aborted)
  {
    return;
  }
  this->NumberOfSelfIntersections = static_cast<int>(result.Surface.SelfIntersections);
  vtkPolyData* surface = vtkPolyData::GetData(outputs, 0);
  FlipFree::AttachMesh(result.Surface.Mesh, result.Surface.Points, surface);
  FlipFree::AttachField(result.Surface.Field, surface);
  FlipFree::AttachCertificate(true, surface);
  FlipFree::FillCenterline(result.Tree, vtkPolyData::GetData(outputs, 2));
  for (const std::string& warning : result.Warnings)
  {
    vtkWarningMacro(<< warning);
  }
  FlipFree::MakeLabelMap(result.Voxels, static_cast<unsigned char>(this->LabelValue), image,
    vtkImageData::GetData(outputs, 1));
  this->UpdateProgress(1);
}

void vtkFlipFreeVesselSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  os << indent << "LabelValue: " << this->LabelValue << "\n";
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
}

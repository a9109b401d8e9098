#include "vtkFlipFreeVesselSegmentation.h"

#include "ConstraintPoints.h"
#include "ContourMeshAdapter.h"
#include "Deformation/ConvergenceColumns.h"
#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "GrayImageAdapter.h"
#include "LabelAdapter.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"
#include "TableAdapter.h"
#include "Vessel/VesselParameters.h"
#include "Vessel/VesselProvenance.h"
#include "VesselOutputs.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <string>

vtkStandardNewMacro(vtkFlipFreeVesselSegmentation);

using FlipFree::ConstraintKind;
#define FLIPFREE_STAGE vtkFlipFreeVesselSegmentation

#define PROPERTIES(P) FLIPFREE_VESSEL_SURFACE_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

vtkFlipFreeVesselSegmentation::vtkFlipFreeVesselSegmentation()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
}

void vtkFlipFreeVesselSegmentation::SetConstraintData(vtkPointSet* points)
{
  this->SetInputDataObject(1, points);
}

void vtkFlipFreeVesselSegmentation::AddConstraintData(vtkPointSet* points)
{
  this->AddInputDataObject(1, points);
}

void vtkFlipFreeVesselSegmentation::AddInsidePoint(double x, double y, double z)
{
  this->Points->Corrections.push_back({ ConstraintKind::Inside, { x, y, z }, 0 });
  this->Modified();
}

void vtkFlipFreeVesselSegmentation::AddOutsidePoint(double x, double y, double z)
{
  this->Points->Corrections.push_back({ ConstraintKind::Outside, { x, y, z }, 0 });
  this->Modified();
}

void vtkFlipFreeVesselSegmentation::AddBoundaryPoint(double x, double y, double z)
{
  this->Points->Corrections.push_back({ ConstraintKind::Boundary, { x, y, z }, 0 });
  this->Modified();
}

int vtkFlipFreeVesselSegmentation::GetNumberOfCorrections() const
{
  return static_cast<int>(this->Points->Corrections.size());
}

void vtkFlipFreeVesselSegmentation::RemoveAllCorrections()
{
  if (!this->Points->Corrections.empty())
  {
    this->Points->Corrections.clear();
    this->Modified();
  }
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

int vtkFlipFreeVesselSegmentation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Set(INPUT_IS_OPTIONAL(), 1);
  info->Set(INPUT_IS_REPEATABLE(), 1);
  return 1;
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
  this->SetErrorCode(vtkErrorCode::NoError);
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
  this->Support = 0;
  this->Confidence = 0;
  std::fill_n(this->StageSeconds, 4, 0.0);
  try
  {
    this->Segment(vtkImageData::GetData(inputs[0]), inputs[1], outputs);
  }
  catch (const std::exception& error)
  {
    clear();
    this->StopReason = static_cast<int>(FlipFree::StopReason::NotRun);
    FlipFreeErrorMacro("No segmentation: ", error, ".");
    return 0;
  }
  return 1;
}

void vtkFlipFreeVesselSegmentation::Segment(vtkImageData* image, vtkInformationVector* corrections,
  vtkInformationVector* outputs)
{
  FlipFree::ConstraintList constraints = this->Points->Corrections;
  const auto more = FlipFree::ConstraintsOf(corrections, 1);
  constraints.insert(constraints.end(), more.begin(), more.end());
  const std::string name = "the image{ on port 0}";
  FlipFree::RequireGrayImage(image, name);
  const FlipFree::VesselSegmentation result =
    FlipFree::SegmentVessel(FlipFree::GrayVolumeOf(image, name), name, this->Points->List(),
      constraints, *this->Settings, FlipFree::SMPThreading(), FlipFree::MonitorOf(this, 0, 0.95));
  std::copy(result.StageSeconds.begin(), result.StageSeconds.end(), this->StageSeconds);
  this->StopReason = static_cast<int>(result.Surface.Reason);
  FlipFree::AddColumns(vtkTable::GetData(outputs, 3), FlipFree::ConvergenceColumns(),
    result.Surface.Iterations);
  if (result.Surface.Reason == FlipFree::StopReason::Aborted)
  {
    return;
  }
  this->NumberOfSelfIntersections = static_cast<int>(result.Surface.SelfIntersections);
  this->Support = result.Tree.Support;
  this->Confidence = result.Confidence.Value;
  vtkPolyData* surface = vtkPolyData::GetData(outputs, 0);
  FlipFree::AttachMesh(result.Surface.Mesh, result.Surface.Points, surface);
  FlipFree::AttachField(result.Surface.Field, surface);
  FlipFree::AttachCertificate(true, surface);
  FlipFree::AttachProvenance(FlipFree::ProvenanceOf(this->Points->List(), constraints,
                               *this->Settings, FlipFree::GeometryOf(image)),
    surface);
  FlipFree::FillCenterline(result.Tree, vtkPolyData::GetData(outputs, 2));
  for (const std::string& warning : result.Warnings)
  {
    FlipFreeWarningMacro(warning);
  }
  FlipFree::MakeLabelMap(result.Voxels, static_cast<unsigned char>(this->GetLabelValue()), image,
    vtkImageData::GetData(outputs, 1));
  this->UpdateProgress(1);
}

void vtkFlipFreeVesselSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  for (const FlipFree::PointConstraint& correction : this->Points->Corrections)
  {
    os << indent << "Correction: " << FlipFree::NameOf(correction) << "\n";
  }
  os << indent << "Support: " << this->Support << "\n";
  os << indent << "Confidence: " << this->Confidence << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
}

#undef FLIPFREE_STAGE
#undef PROPERTIES

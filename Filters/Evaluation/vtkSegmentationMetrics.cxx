#include "vtkSegmentationMetrics.h"

#include "ExecutionAdapter.h"
#include "LabelSurface.h"
#include "Measures/SurfaceDistance.h"
#include "Measures/VoxelOverlap.h"
#include "Mesh/SurfaceVoxelization.h"
#include "PipelineAdapter.h"
#include "SurfaceAdapter.h"
#include "TableAdapter.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkSegmentationMetrics);

namespace
{

FlipFree::BitMask Voxelize(const FlipFree::PolygonalSurface& surface,
  const FlipFree::ImageGeometry& geometry)
{
  const auto runs =
    FlipFree::VoxelizeSurface(surface.Points, surface.Triangles, geometry, FlipFree::SMPFor);
  if (runs.empty())
  {
    throw std::invalid_argument(
      "the segmentation on port 0, a surface, encloses no voxel center of the reference on port 1; "
      "check that both are in the same physical coordinates");
  }
  FlipFree::BitMask mask(geometry);
  for (const FlipFree::VoxelRun& run : runs)
  {
    mask.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  return mask;
}

// Throws where none of the image's voxels has the label, and says which there are.
void RequireLabel(const FlipFree::BitMask& mask, vtkImageData* image, const std::string& name,
  const std::string& property, int label)
{
  if (label < 0 || !mask.Bounds().IsEmpty())
  {
    return;
  }
  const FlipFree::LabelValues values = FlipFree::LabelsOf(image);
  const std::string labels = FlipFree::TextOf(values.Labels);
  const std::string others = FlipFree::TextOf(values.Others);
  std::string message = name + " is empty: no voxel has the label " + std::to_string(label);
  if (!labels.empty())
  {
    message += "; set " + property + " to one of " + labels +
      (others.empty() ? "" : ", if it is a label map: it holds " + others + ", too");
  }
  else
  {
    message += others.empty() ? ", all are 0; check that it is the intended label map"
                              : "; it is no label map: it holds " + others +
        ", where a label map holds whole numbers from 0 up; give it a label map";
  }
  throw std::invalid_argument(message);
}

double Milliliters(std::size_t numberOfVoxels, const FlipFree::ImageGeometry& geometry)
{
  return numberOfVoxels * geometry.VoxelVolume() / 1000;
}

} // namespace

vtkSegmentationMetrics::vtkSegmentationMetrics()
{
  this->SetNumberOfInputPorts(2);
  this->ForgetMeasures();
}

void vtkSegmentationMetrics::SetReferenceData(vtkImageData* labelMap)
{
  this->SetInputData(1, labelMap);
}

void vtkSegmentationMetrics::SetReferenceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

int vtkSegmentationMetrics::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 0)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  }
  return 1;
}

int vtkSegmentationMetrics::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector*)
{
  // A table has no extent from which the executive could derive those of the images: it would ask
  // the reference for the extent of the segmentation, and the next pair of images for that of the
  // last.
  for (int port = 0; port < 2; ++port)
  {
    FlipFree::RequestWholeExtent(inputVector[port]->GetInformationObject(0));
  }
  return 1;
}

int vtkSegmentationMetrics::RequestData(vtkInformation*, vtkInformationVector** inputVector,
  vtkInformationVector* outputVector)
{
  vtkTable* output = vtkTable::GetData(outputVector);
  output->Initialize();
  this->ForgetMeasures();
  try
  {
    if (this->Measure(vtkDataObject::GetData(inputVector[0]),
          vtkImageData::GetData(inputVector[1])))
    {
      this->FillTable(output);
      return 1;
    }
    this->ForgetMeasures();
  }
  catch (const std::exception& error)
  {
    this->ForgetMeasures();
    vtkErrorMacro(
      "No measures of the segmentation (port 0) against the reference (port 1): " << error.what());
    return 0;
  }
  return 1;
}

void vtkSegmentationMetrics::WarnOfLabels(vtkDataObject* input, vtkImageData* reference)
{
  if (this->ReferenceLabel >= 0)
  {
    return;
  }
  // Mostly there is but one, and the segmentation need not be looked through.
  const FlipFree::LabelValues values = FlipFree::LabelsOf(reference);
  vtkImageData* segmentation = vtkImageData::SafeDownCast(input);
  if (!values.AreSeveral() ||
    (segmentation && this->SegmentationLabel < 0 && FlipFree::LabelsOf(segmentation).AreSeveral()))
  {
    return;
  }
  const std::string labels = FlipFree::TextOf(values.Labels);
  const std::string others = FlipFree::TextOf(values.Others);
  if (others.empty())
  {
    vtkWarningMacro("The reference (port 1) has the labels "
      << labels
      << "; the segmentation has one organ only: it is compared with all of them together; to "
         "compare it with one, set ReferenceLabel.");
  }
  else
  {
    vtkWarningMacro("The reference (port 1) has the values "
      << others
      << ", which no label map has: all that are not 0 count as inside; give it a label map"
      << (labels.empty() ? "" : ", or set ReferenceLabel to one of " + labels) << ".");
  }
}

bool vtkSegmentationMetrics::Measure(vtkDataObject* input, vtkImageData* referenceImage)
{
  using namespace FlipFree;
  const BitMask reference = MaskOf(referenceImage, this->ReferenceLabel, "the reference on port 1");
  RequireLabel(reference, referenceImage, "the reference", "ReferenceLabel", this->ReferenceLabel);
  vtkPolyData* polyData = vtkPolyData::SafeDownCast(input);
  PolygonalSurface mesh;
  if (polyData)
  {
    mesh = SurfaceOf(polyData, "the segmentation on port 0");
  }
  vtkImageData* labels = vtkImageData::SafeDownCast(input);
  const BitMask segmentation = polyData
    ? Voxelize(mesh, reference.GetGeometry())
    : MaskOf(labels, this->SegmentationLabel, "the segmentation on port 0");
  if (labels)
  {
    RequireLabel(segmentation, labels, "the segmentation", "SegmentationLabel",
      this->SegmentationLabel);
  }
  const VoxelOverlap overlap = MeasureOverlap(segmentation, reference, SMPFor);
  this->Dice = overlap.Dice();
  this->Jaccard = overlap.Jaccard();
  this->RelativeVolumeDifference = overlap.RelativeVolumeDifference();
  this->SegmentationVolume = Milliliters(overlap.Segmentation, reference.GetGeometry());
  this->ReferenceVolume = Milliliters(overlap.Reference, reference.GetGeometry());
  this->OverlapOf = polyData ? "voxelized mesh" : "label map";

  const bool isMeshMeasured = polyData && !this->ScoreVoxelization;
  this->DistanceOf = isMeshMeasured ? "mesh" : "surface of " + this->OverlapOf;
  const LabelSurface surface = isMeshMeasured ? LabelSurface{ mesh.Points, mesh.Triangles }
                                              : SurfaceOf(segmentation, this->LabelSmoothing);
  const LabelSurface referenceSurface = SurfaceOf(reference, this->LabelSmoothing);
  const SurfaceDistance distance =
    MeasureSurfaceDistance(surface.Points, surface.Triangles, referenceSurface.Points,
      referenceSurface.Triangles, this->SampleSpacing, SMPFor, MonitorOf(this));
  this->ASD = distance.Average;
  this->RMS = distance.RootMeanSquare;
  this->HD95 = distance.Hausdorff95;
  this->HD = distance.Hausdorff;
  if (distance.Complete)
  {
    this->WarnOfLabels(input, referenceImage); // after all errors: one of them is enough
  }
  return distance.Complete;
}

void vtkSegmentationMetrics::FillTable(vtkTable* table) const
{
  FlipFree::AddColumn(table, "Dice", this->Dice);
  FlipFree::AddColumn(table, "Jaccard", this->Jaccard);
  FlipFree::AddColumn(table, "RelativeVolumeDifference", this->RelativeVolumeDifference);
  FlipFree::AddColumn(table, "ASD", this->ASD);
  FlipFree::AddColumn(table, "RMS", this->RMS);
  FlipFree::AddColumn(table, "HD95", this->HD95);
  FlipFree::AddColumn(table, "HD", this->HD);
  FlipFree::AddColumn(table, "SegmentationVolume", this->SegmentationVolume);
  FlipFree::AddColumn(table, "ReferenceVolume", this->ReferenceVolume);
  FlipFree::AddColumn(table, "OverlapOf", this->OverlapOf);
  FlipFree::AddColumn(table, "DistanceOf", this->DistanceOf);
}

void vtkSegmentationMetrics::ForgetMeasures()
{
  this->Dice = this->Jaccard = this->RelativeVolumeDifference = this->ASD = this->RMS = this->HD95 =
    this->HD = this->SegmentationVolume = this->ReferenceVolume =
      std::numeric_limits<double>::quiet_NaN();
  this->OverlapOf.clear();
  this->DistanceOf.clear();
}

void vtkSegmentationMetrics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SegmentationLabel: " << this->SegmentationLabel << "\n";
  os << indent << "ReferenceLabel: " << this->ReferenceLabel << "\n";
  os << indent << "SampleSpacing: " << this->SampleSpacing << "\n";
  os << indent << "LabelSmoothing: " << this->LabelSmoothing << "\n";
  os << indent << "ScoreVoxelization: " << this->ScoreVoxelization << "\n";
  os << indent << "Dice: " << this->Dice << "\n";
  os << indent << "Jaccard: " << this->Jaccard << "\n";
  os << indent << "RelativeVolumeDifference: " << this->RelativeVolumeDifference << "\n";
  os << indent << "ASD: " << this->ASD << "\n";
  os << indent << "RMS: " << this->RMS << "\n";
  os << indent << "HD95: " << this->HD95 << "\n";
  os << indent << "HD: " << this->HD << "\n";
  os << indent << "SegmentationVolume: " << this->SegmentationVolume << "\n";
  os << indent << "ReferenceVolume: " << this->ReferenceVolume << "\n";
  os << indent << "OverlapOf: " << this->OverlapOf << "\n";
  os << indent << "DistanceOf: " << this->DistanceOf << "\n";
}

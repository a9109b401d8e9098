#include "vtkSegmentationMetrics.h"

#include "ExecutionAdapter.h"
#include "LabelAdapter.h"
#include "Measures/SegmentationScores.h"
#include "PipelineAdapter.h"
#include "SurfaceAdapter.h"
#include "TableAdapter.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <exception>

vtkStandardNewMacro(vtkSegmentationMetrics);

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

bool vtkSegmentationMetrics::Measure(vtkDataObject* input, vtkImageData* referenceImage)
{
  using namespace FlipFree;
  ScoreSettings settings;
  settings.SegmentationLabel = this->SegmentationLabel;
  settings.ReferenceLabel = this->ReferenceLabel;
  settings.SampleSpacing = this->SampleSpacing;
  settings.LabelSmoothing = this->LabelSmoothing;
  settings.ScoreVoxelization = this->ScoreVoxelization;
  const LabelMask reference = LabelMaskOf(LabelVolumeOf(referenceImage, "the reference on port 1"),
    settings.ReferenceLabel, "ReferenceLabel");
  SegmentationScores scores;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(input))
  {
    const PolygonalSurface mesh = SurfaceOf(polyData, "the segmentation on port 0");
    scores =
      ScoreSurface(mesh.Points, mesh.Triangles, reference, settings, SMPFor, MonitorOf(this));
  }
  else
  {
    const LabelMask segmentation =
      LabelMaskOf(LabelVolumeOf(vtkImageData::SafeDownCast(input), "the segmentation on port 0"),
        settings.SegmentationLabel, "SegmentationLabel");
    scores = ScoreLabels(segmentation, reference, settings, SMPFor, MonitorOf(this));
  }
  this->Store(scores);
  if (!scores.Warning.empty())
  {
    vtkWarningMacro(<< scores.Warning);
  }
  return scores.Complete;
}

void vtkSegmentationMetrics::Store(const FlipFree::SegmentationScores& scores)
{
  this->Dice = scores.Dice;
  this->Jaccard = scores.Jaccard;
  this->RelativeVolumeDifference = scores.RelativeVolumeDifference;
  this->ASD = scores.ASD;
  this->RMS = scores.RMS;
  this->HD95 = scores.HD95;
  this->HD = scores.HD;
  this->SegmentationVolume = scores.SegmentationVolume;
  this->ReferenceVolume = scores.ReferenceVolume;
  this->OverlapOf = scores.OverlapOf;
  this->DistanceOf = scores.DistanceOf;
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
  this->Store({});
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

#include "vtkSegmentationMetrics.h"

#include "ExecutionAdapter.h"
#include "FilterReport.h"
#include "LabelAdapter.h"
#include "Measures/ScoreColumns.h"
#include "Measures/ScoreParameters.h"
#include "Measures/ScoreSummary.h"
#include "PipelineAdapter.h"
#include "StageProperties.h"
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

#define FLIPFREE_STAGE vtkSegmentationMetrics

#define PROPERTIES(P) FLIPFREE_SCORE_PARAMETERS(P, Settings->)

PROPERTIES(FLIPFREE_DEFINE_PROPERTY)

#define DEFINE_GETTER(Name, unit)                                                                  \
  double vtkSegmentationMetrics::Get##Name() const                                                 \
  {                                                                                                \
    return this->Scores->Name;                                                                     \
  }

FLIPFREE_SCORE_COLUMNS(DEFINE_GETTER)

vtkSegmentationMetrics::vtkSegmentationMetrics()
  : Settings(std::make_unique<FlipFree::ScoreSettings>())
  , Scores(std::make_unique<FlipFree::SegmentationScores>())
{
  this->SetNumberOfInputPorts(2);
}

vtkSegmentationMetrics::~vtkSegmentationMetrics() = default;

std::string vtkSegmentationMetrics::GetOverlapOf() const
{
  return this->Scores->OverlapOf;
}

std::string vtkSegmentationMetrics::GetDistanceOf() const
{
  return this->Scores->DistanceOf;
}

std::string vtkSegmentationMetrics::GetSummary() const
{
  return this->Scores->Complete ? FlipFree::SummaryOf(*this->Scores) : std::string();
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
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkTable* output = vtkTable::GetData(outputVector);
  output->Initialize();
  *this->Scores = {};
  try
  {
    const FlipFree::SegmentationScores scores =
      this->Measure(vtkDataObject::GetData(inputVector[0]), vtkImageData::GetData(inputVector[1]));
    if (scores.Complete)
    {
      *this->Scores = scores;
      FlipFree::ForEachScore(scores,
        [output](const char* name, const auto& value)
        { FlipFree::AddColumn(output, name, value); });
    }
  }
  catch (const std::exception& error)
  {
    FlipFreeErrorMacro(
      "The segmentation{ (port 0)} and the reference{ (port 1)} cannot be compared: ", error, ".");
    return 0;
  }
  return 1;
}

FlipFree::SegmentationScores vtkSegmentationMetrics::Measure(vtkDataObject* input,
  vtkImageData* referenceImage)
{
  using namespace FlipFree;
  const ScoreSettings& settings = *this->Settings;
  const LabelMask reference =
    LabelMaskOf(LabelVolumeOf(referenceImage, "the reference{ on port 1}"), settings.ReferenceLabel,
      "ReferenceLabel");
  SegmentationScores scores;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(input))
  {
    const PolygonalSurface mesh = SurfaceOf(polyData, "the segmentation{ on port 0}");
    scores =
      ScoreSurface(mesh.Points, mesh.Triangles, reference, settings, SMPFor, MonitorOf(this));
  }
  else
  {
    const LabelMask segmentation =
      LabelMaskOf(LabelVolumeOf(vtkImageData::SafeDownCast(input), "the segmentation{ on port 0}"),
        settings.SegmentationLabel, "SegmentationLabel");
    scores = ScoreLabels(segmentation, reference, settings, SMPFor, MonitorOf(this));
  }
  for (const std::string& warning : scores.Warnings)
  {
    FlipFreeWarningMacro(warning);
  }
  return scores;
}

void vtkSegmentationMetrics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PROPERTIES(FLIPFREE_PRINT_PROPERTY)
  FlipFree::ForEachScore(*this->Scores,
    [&os, &indent](const char* name, const auto& value)
    { os << indent << name << ": " << value << "\n"; });
}

#undef FLIPFREE_STAGE
#undef PROPERTIES
#undef DEFINE_GETTER

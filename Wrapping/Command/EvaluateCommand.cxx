#include "Failure.h"
#include "Messages.h"
#include "OtherRequests.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSegmentationMetrics.h"
#include "vtkStringArray.h"
#include "vtkSurfaceValidity.h"
#include "vtkTable.h"

#include <cstdio>

namespace Command
{
namespace
{

void PrintValidity(vtkPolyData* surface)
{
  vtkNew<vtkSurfaceValidity> validity;
  validity->SetInputData(surface);
  Run(validity, "checking");
  std::fputs(validity->GetSummary().c_str(), stdout);
}

vtkSmartPointer<vtkTable> NamedRow(vtkSegmentationMetrics* metrics,
  const EvaluateRequest& evaluation)
{
  auto row = vtkSmartPointer<vtkTable>::New();
  const auto add = [&row](const char* column, const std::string& value)
  {
    vtkNew<vtkStringArray> names;
    names->SetName(column);
    names->InsertNextValue(value);
    row->AddColumn(names);
  };
  add("Segmentation", evaluation.Segmentation);
  add("Reference", evaluation.Reference);
  for (vtkIdType column = 0; column < metrics->GetOutput()->GetNumberOfColumns(); ++column)
  {
    row->AddColumn(metrics->GetOutput()->GetColumn(column));
  }
  return row;
}

void Measure(vtkSegmentationMetrics* metrics, const EvaluateRequest& evaluation)
{
  const FlipFree::QuantityNames names{ { "SegmentationLabel", "--segmentation-label" },
    { "ReferenceLabel", "--reference-label" } };
  try
  {
    Run(metrics, "measuring", names);
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + evaluation.Segmentation + "' against '" + evaluation.Reference +
      "': " + failure.what());
  }
}

} // namespace

void Evaluate(const EvaluateRequest& evaluation)
{
  if (evaluation.Quiet)
  {
    ProgressBar::Disable();
  }
  OutputFiles outputs;
  if (!evaluation.Csv.empty())
  {
    RequireEnding("--csv", evaluation.Csv, { ".csv" });
    outputs.Announce("--csv", evaluation.Csv, { evaluation.Segmentation, evaluation.Reference });
  }

  vtkNew<vtkSegmentationMetrics> metrics;
  metrics->SetScoreVoxelization(evaluation.Voxelize);
  vtkSmartPointer<vtkPolyData> surface;
  if (HasEnding(evaluation.Segmentation, SurfaceEndings()))
  {
    surface = ReadSurface(evaluation.Segmentation);
    metrics->SetInputData(surface);
  }
  else
  {
    const ChosenLabels labels =
      ReadLabels(evaluation.Segmentation, evaluation.LabelOfSegmentation());
    metrics->SetInputData(labels.Map);
    metrics->SetSegmentationLabel(labels.Label);
  }
  const ChosenLabels reference = ReadLabels(evaluation.Reference, evaluation.LabelOfReference());
  metrics->SetReferenceData(reference.Map);
  metrics->SetReferenceLabel(reference.Label);
  Measure(metrics, evaluation);

  if (!evaluation.Csv.empty())
  {
    outputs.Write(evaluation.Csv,
      [&](const std::string& name) { WriteTable(name, NamedRow(metrics, evaluation)); });
    outputs.Commit();
  }
  if (!evaluation.Quiet)
  {
    std::fputs(metrics->GetSummary().c_str(), stdout);
    if (surface)
    {
      PrintValidity(surface);
    }
    std::fflush(stdout);
  }
}

} // namespace Command

#include "Failure.h"
#include "LabelNames.h"
#include "Messages.h"
#include "OtherRequests.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Subcommands.h"
#include "Summary.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "Exchange/FileNames.h"
#include "FilterSettings.h"
#include "LabelSurface/LabelSurfaceParameters.h"

#include "vtkFlipFreeLabelSurfaces.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <filesystem>
#include <vector>

namespace Command
{
namespace
{

std::string FileOf(vtkTable* table, vtkIdType row, const std::string& format)
{
  return FlipFree::LabelFileName(table->GetValueByName(row, "Label").ToInt(),
    table->GetValueByName(row, "Name").ToString(), format);
}

std::vector<LabelSummary> SummariesOf(vtkTable* table)
{
  std::vector<LabelSummary> labels;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto at = [&](const char* column) { return table->GetValueByName(row, column); };
    labels.push_back({ at("Label").ToInt(), at("Name").ToString(), at("Milliliters").ToDouble(),
      at("EulerNumber").ToInt(), at("Triangles").ToInt(), at("WrongVoxels").ToLongLong() });
  }
  return labels;
}

} // namespace

void MakeSurfaces(const SurfacesRequest& request)
{
  FlipFree::LabelSurfaceSettings settings;
  request.Parameters.Apply(settings);
  if (request.Quiet)
  {
    ProgressBar::Disable();
  }
  vtkSMPTools::Initialize(request.Threads);
  const OutputFolder made(request.Folder);
  const std::filesystem::path folder(request.Folder);
  const std::string csv = (folder / "surfaces.csv").string();
  OutputFiles outputs;
  outputs.Announce("--output", csv, { request.LabelMap });

  const vtkSmartPointer<vtkImageData> labels = ReadLabels(request.LabelMap, "").Map;
  if (!request.Names.empty())
  {
    NameLabels(request.Names, labels);
  }
  vtkNew<vtkFlipFreeLabelSurfaces> filter;
  filter->SetInputData(labels);
  for (const int label : request.Labels)
  {
    filter->AddLabel(label);
  }
  FlipFree::FilterSettings::Set(filter, settings);
  FlipFree::QuantityNames names = OptionNames(FlipFree::LabelSurfaceParameters());
  names["Labels"] = "--label";
  Run(filter, "surfaces", names);

  vtkTable* const table = filter->GetTable();
  vtkNew<vtkStringArray> files;
  files->SetName("File");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    auto* const surface =
      vtkPolyData::SafeDownCast(filter->GetSurfaces()->GetBlock(static_cast<unsigned int>(row)));
    if (surface->GetNumberOfPolys() == 0)
    {
      files->InsertNextValue("");
      continue;
    }
    const std::string own = FileOf(table, row, request.Format);
    const std::string file = (folder / own).string();
    files->InsertNextValue(own);
    outputs.Announce("--output", file, { request.LabelMap, request.Names });
    outputs.Write(file, [surface](const std::string& name) { WriteSurface(name, surface); });
  }
  table->AddColumn(files);
  outputs.Write(csv, [table](const std::string& name) { WriteTable(name, table); });
  outputs.Commit();
  if (!request.Quiet)
  {
    SurfacesSummary summary{ SummariesOf(table), filter->GetNumberOfWrongVoxels(),
      filter->GetGreatestDistance(), {} };
    if (settings.EdgeLength > 0 || settings.Triangles > 0)
    {
      summary.Collapse = { filter->GetOutput()->GetNumberOfPolys(), filter->GetCollapseDistance() };
    }
    PrintSummary(SurfacesText(summary));
  }
}

} // namespace Command

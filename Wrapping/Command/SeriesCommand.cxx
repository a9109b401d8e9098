#include "FileFormats.h"
#include "Messages.h"
#include "OtherRequests.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentationReport.h"
#include "Subcommands.h"
#include "Summary.h"
#include "TableFile.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMedicalImageReader.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>
#include <vector>

namespace Command
{
namespace
{

std::vector<SeriesSummary> SummariesOf(vtkMedicalImageReader* reader)
{
  std::vector<SeriesSummary> list;
  for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
  {
    SeriesSummary series{ reader->GetSeriesNumber(index), reader->GetSeriesUID(index),
      reader->GetSeriesModality(index), reader->GetSeriesNumberOfSlices(index), {},
      reader->GetSeriesDescription(index) };
    reader->GetSeriesSpacing(index, series.Spacing.data());
    list.push_back(series);
  }
  return list;
}

void WarnOfProblems(vtkMedicalImageReader* reader)
{
  for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
  {
    if (!reader->GetSeriesProblem(index).empty())
    {
      PrintWarning(reader->GetSeriesProblem(index));
    }
  }
}

vtkSmartPointer<vtkTable> TableOf(vtkMedicalImageReader* reader)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  const auto addText = [&](const char* name, std::string (vtkMedicalImageReader::*get)(int))
  {
    vtkNew<vtkStringArray> column;
    column->SetName(name);
    for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
    {
      column->InsertNextValue((reader->*get)(index));
    }
    table->AddColumn(column);
  };
  addText("number", &vtkMedicalImageReader::GetSeriesNumber);
  addText("uid", &vtkMedicalImageReader::GetSeriesUID);
  addText("description", &vtkMedicalImageReader::GetSeriesDescription);
  addText("modality", &vtkMedicalImageReader::GetSeriesModality);
  vtkNew<vtkIntArray> slices;
  slices->SetName("slices");
  vtkNew<vtkDoubleArray> axes[3];
  const char* const names[] = { "spacing_x", "spacing_y", "spacing_z" };
  for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
  {
    slices->InsertNextValue(reader->GetSeriesNumberOfSlices(index));
    double spacing[3];
    reader->GetSeriesSpacing(index, spacing);
    for (int axis = 0; axis < 3; ++axis)
    {
      axes[axis]->InsertNextValue(spacing[axis]);
    }
  }
  table->AddColumn(slices);
  for (int axis = 0; axis < 3; ++axis)
  {
    axes[axis]->SetName(names[axis]);
    table->AddColumn(axes[axis]);
  }
  addText("problem", &vtkMedicalImageReader::GetSeriesProblem);
  return table;
}

} // namespace

void ListSeries(const SeriesRequest& list)
{
  if (list.Quiet)
  {
    ProgressBar::Disable();
  }
  OutputFiles outputs;
  if (!list.Csv.empty())
  {
    RequireEnding("--csv", list.Csv, { ".csv" });
    outputs.Announce("--csv", list.Csv);
  }
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(list.Folder.c_str());
  Run(reader, "reading", {}, [&reader]() { reader->FindSeries(); });
  if (!list.Csv.empty())
  {
    outputs.Write(list.Csv,
      [&reader](const std::string& name) { WriteTable(name, TableOf(reader)); });
    outputs.Commit();
  }
  if (!list.Quiet)
  {
    PrintSummary(SeriesText(SummariesOf(reader)));
  }
  WarnOfProblems(reader);
}

} // namespace Command

#include "Failure.h"
#include "Messages.h"
#include "Options.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "Subcommands.h"
#include "TableFile.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMedicalImageReader.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>

namespace Command
{
namespace
{

struct SeriesList
{
  std::string Folder;
  std::string Csv;
  bool Quiet = false;
};

std::string SpacingText(const double spacing[3])
{
  if (spacing[0] <= 0)
  {
    return "-"; // it cannot be read
  }
  std::ostringstream text;
  text << spacing[0] << " x " << spacing[1] << " x " << spacing[2];
  return text.str();
}

void PrintSeries(vtkMedicalImageReader* reader)
{
  int widest = 3;
  for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
  {
    widest = std::max(widest, static_cast<int>(reader->GetSeriesUID(index).size()));
  }
  std::printf("%6s  %-*s  %-8s  %6s  %-24s  %s\n", "Number", widest, "UID", "Modality", "Slices",
    "Spacing (mm)", "Description");
  for (int index = 0; index < reader->GetNumberOfSeries(); ++index)
  {
    double spacing[3];
    reader->GetSeriesSpacing(index, spacing);
    std::printf("%6s  %-*s  %-8s  %6d  %-24s  %s\n", reader->GetSeriesNumber(index).c_str(), widest,
      reader->GetSeriesUID(index).c_str(), reader->GetSeriesModality(index).c_str(),
      reader->GetSeriesNumberOfSlices(index), SpacingText(spacing).c_str(),
      reader->GetSeriesDescription(index).c_str());
  }
  std::fflush(stdout);
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

void ListSeries(const SeriesList& list)
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
    PrintSeries(reader);
  }
  WarnOfProblems(reader);
}

} // namespace

void AddSeriesCommand(CLI::App& program)
{
  const auto list = std::make_shared<SeriesList>();
  CLI::App* command = AddCommand(program, "series");
  AddOption(*command, "FOLDER", list->Folder);
  AddOption(*command, "--csv", list->Csv);
  AddOption(*command, "--quiet", list->Quiet);
  command->callback([list]() { ListSeries(*list); });
}

} // namespace Command

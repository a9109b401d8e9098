#include "Failure.h"
#include "LabelNames.h"
#include "Messages.h"
#include "Options.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "Subcommands.h"
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

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

namespace Command
{
namespace
{

struct SurfacesRequest
{
  std::string LabelMap;
  std::string Folder;
  std::string Format;
  std::string Names;
  std::vector<int> Labels;
  GivenParameters<FlipFree::LabelSurfaceSettings> Parameters;
  int Threads = 0;
  bool Quiet = false;
};

// LABEL.stl, or LABEL-NAME.stl.
std::string FileOf(vtkTable* table, vtkIdType row, const std::string& format)
{
  const std::string label = table->GetValueByName(row, "Label").ToString();
  const std::string name = FlipFree::FileNamePart(table->GetValueByName(row, "Name").ToString());
  return label + (name.empty() ? "" : "-" + name) + "." + format;
}

void Print(vtkTable* table)
{
  std::printf("%10s  %-24s  %11s  %6s  %9s  %12s\n", "Label", "Name", "Milliliters", "Euler",
    "Triangles", "Wrong voxels");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto at = [&](const char* column) { return table->GetValueByName(row, column); };
    const std::string name = at("Name").ToString();
    // printf() counts bytes, of which letters beyond ASCII have several.
    const auto more =
      std::count_if(name.begin(), name.end(), [](char byte) { return (byte & 0xC0) == 0x80; });
    std::printf("%10d  %-*s  %11.3f  %6d  %9d  %12lld\n", at("Label").ToInt(),
      24 + static_cast<int>(more), name.c_str(), at("Milliliters").ToDouble(),
      at("EulerNumber").ToInt(), at("Triangles").ToInt(), at("WrongVoxels").ToLongLong());
  }
}

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
    Print(table);
    std::printf(
      "%lld voxels on the wrong side; vertices lie at most %.2f mm from the corners where "
      "voxels of different labels meet\n",
      static_cast<long long>(filter->GetNumberOfWrongVoxels()), filter->GetGreatestDistance());
    if (settings.EdgeLength > 0 || settings.Triangles > 0)
    {
      std::printf(
        "%lld triangles; walls lie at most %.2f mm from where they were before edges were "
        "collapsed\n",
        static_cast<long long>(filter->GetOutput()->GetNumberOfPolys()),
        filter->GetCollapseDistance());
    }
    std::fflush(stdout);
  }
}

} // namespace

void AddSurfacesCommand(CLI::App& program)
{
  const auto request = std::make_shared<SurfacesRequest>();
  CLI::App* command = AddCommand(program, "surfaces");
  AddOption(*command, "LABELS", request->LabelMap);
  AddOption(*command, "--output", request->Folder);
  AddOption(*command, "--format", request->Format);
  AddOption(*command, "--label", request->Labels)
    ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  AddOption(*command, "--names", request->Names);
  request->Parameters.AddOptions(*command, FlipFree::LabelSurfaceParameters());
  command->get_option("--distance")->excludes(command->get_option("--exact"));
  AddThreadsOption(*command, request->Threads);
  AddOption(*command, "--quiet", request->Quiet);
  command->callback([request]() { MakeSurfaces(*request); });
}

} // namespace Command

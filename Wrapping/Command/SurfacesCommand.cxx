#include "CommonOptions.h"
#include "Failure.h"
#include "LabelNames.h"
#include "Messages.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "Exchange/FileNames.h"

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
  std::string Format = "stl";
  std::string Names;
  std::vector<int> Labels;
  bool Exact = false;
  double Distance = 0;
  int Iterations = 0;
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
  filter->SetExact(request.Exact);
  filter->SetDistance(request.Distance);
  filter->SetIterations(request.Iterations);
  Run(filter, "surfaces",
    { { "Labels", "--label" }, { "Exact", "--exact" }, { "Distance", "--distance" },
      { "Iterations", "--iterations" } });

  vtkTable* const table = filter->GetTable();
  vtkNew<vtkStringArray> files;
  files->SetName("File");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const std::string own = FileOf(table, row, request.Format);
    const std::string file = (folder / own).string();
    files->InsertNextValue(own);
    outputs.Announce("--output", file, { request.LabelMap, request.Names });
    auto* const surface =
      vtkPolyData::SafeDownCast(filter->GetSurfaces()->GetBlock(static_cast<unsigned int>(row)));
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
    std::fflush(stdout);
  }
}

const char* const SurfacesFooter =
  "Writes a surface for each label, LABEL.stl, or LABEL-NAME.stl where labels have names, and\n"
  "the table surfaces.csv: volumes, areas, Euler numbers, triangles, and voxels on the wrong "
  "side.\n"
  "Each surface is closed, a 2-manifold, and does not intersect itself, and where two labels "
  "touch,\n"
  "both have the same triangles there. Names are those of the label map (a segmentation of 3D\n"
  "Slicer, .seg.nrrd, or a NIfTI file with a label table, as TotalSegmentator writes it), or "
  "those\n"
  "of a table: lines such as '5,liver', columns that its first line calls label and name, or\n"
  "the tables of colors of 3D Slicer, FreeSurfer and ITK-SNAP.\n"
  "\n"
  "Examples:\n"
  "  flipfree surfaces labels.nii.gz -o surfaces\n"
  "  flipfree surfaces labels.nii.gz -o surfaces --exact       # voxelized again: the same labels\n"
  "  flipfree surfaces labels.nii.gz -o surfaces --label 5 --label 6 --names names.csv\n";

} // namespace

void AddSurfacesCommand(CLI::App& program)
{
  const auto request = std::make_shared<SurfacesRequest>();
  {
    vtkNew<vtkFlipFreeLabelSurfaces> defaults;
    request->Distance = defaults->GetDistance();
    request->Iterations = defaults->GetIterations();
  }
  CLI::App* command =
    program.add_subcommand("surfaces", "Make surfaces of the labels of a label map");
  command->add_option("LABELS", request->LabelMap, "Label map: whole numbers, 0 is background")
    ->required();
  command->add_option("-o,--output", request->Folder, "Folder for the files; created if absent")
    ->type_name("DIR")
    ->required();
  command->add_option("--format", request->Format, "Of the surfaces: stl, ply, obj or vtp")
    ->type_name("FORMAT")
    ->check(CLI::IsMember({ "stl", "ply", "obj", "vtp" }))
    ->capture_default_str();
  command
    ->add_option("--label", request->Labels,
      "A label that gets a surface, all others being background; repeat it for several. "
      "Default: all")
    ->type_name("N")
    ->allow_extra_args(false)
    ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command
    ->add_option("--names", request->Names, "Table of the labels' names: lines such as '5,liver'")
    ->type_name("FILE");
  CLI::Option* const exact = command->add_flag("--exact", request->Exact,
    "Keep the center of each voxel on the side of its own label: voxelized again, the surfaces are "
    "the label map");
  command
    ->add_option("--distance", request->Distance,
      "How far surfaces may go along each axis to be smooth before voxels change sides, in voxels")
    ->type_name("VOXELS")
    ->check(CLI::Range(0.5, 1.0))
    ->excludes(exact)
    ->capture_default_str();
  command->add_option("--iterations", request->Iterations, "Of the smoothing")
    ->type_name("N")
    ->check(CLI::Range(0, 10000))
    ->capture_default_str();
  AddThreadsOption(*command, request->Threads);
  AddQuietOption(*command, request->Quiet);
  command->footer(SurfacesFooter);
  command->callback([request]() { MakeSurfaces(*request); });
}

} // namespace Command

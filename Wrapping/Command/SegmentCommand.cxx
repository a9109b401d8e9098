#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentParameters.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkMassProperties.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkTriangleFilter.h"

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>

namespace Command
{
namespace
{

using Point = std::array<double, 3>;

struct Segmentation
{
  std::string Input;
  std::string SeriesUID;
  std::vector<double> Seed;
  std::vector<int> SeedVoxel;
  double Radius = 0;
  std::string Surface;
  std::string Labels;
  std::string Convergence;
  std::string Snapshot;
  int Label = 1;
  int Threads = 0;
  bool Quiet = false;
  SegmentParameters Parameters;
};

/// All that can be wrong without a look at the volume.
void RequireSense(const Segmentation& segmentation)
{
  if (segmentation.Seed.empty() == segmentation.SeedVoxel.empty())
  {
    throw WrongUsage(segmentation.Seed.empty()
        ? "No seed is given. Give a point deep in the organ, by --seed X Y Z (LPS mm) or by "
          "--seed-voxel I J K."
        : "Both --seed and --seed-voxel are given. Give one of them.");
  }
  for (const double coordinate : segmentation.Seed)
  {
    if (!vtkMath::IsFinite(coordinate))
    {
      throw WrongUsage("--seed: a coordinate is not a finite number. Give three in millimeters.");
    }
  }
  if (!(segmentation.Radius > 0) || !vtkMath::IsFinite(segmentation.Radius))
  {
    throw WrongUsage("--radius must be a number of millimeters above 0, such that the sphere lies "
                     "within the organ.");
  }
  if (segmentation.Surface.empty() && segmentation.Labels.empty() &&
    segmentation.Convergence.empty() && segmentation.Snapshot.empty())
  {
    throw WrongUsage("No result is asked for. Name at least one: --output, --labels, "
                     "--convergence or --snapshot.");
  }
  const auto require =
    [](const char* option, const std::string& name, const std::vector<std::string>& endings)
  {
    if (!name.empty())
    {
      RequireEnding(option, name, endings);
    }
  };
  require("--output", segmentation.Surface, SurfaceEndings());
  require("--labels", segmentation.Labels, VolumeEndings());
  require("--convergence", segmentation.Convergence, { ".csv" });
  require("--snapshot", segmentation.Snapshot, { ".png" });
}

void AnnounceOutputs(const Segmentation& segmentation, OutputFiles& outputs)
{
  for (const std::string* name : { &segmentation.Surface, &segmentation.Labels,
         &segmentation.Convergence, &segmentation.Snapshot })
  {
    if (!name->empty())
    {
      outputs.Announce(*name, { segmentation.Input });
    }
  }
  if (!segmentation.Snapshot.empty())
  {
    RequireDisplay();
  }
}

/// The seed in millimeters, which must lie in the volume.
Point SeedIn(vtkImageData* image, const Segmentation& segmentation)
{
  Point seed;
  double index[3];
  char given[128];
  if (segmentation.SeedVoxel.empty())
  {
    std::copy_n(segmentation.Seed.begin(), 3, seed.begin());
    image->TransformPhysicalPointToContinuousIndex(seed.data(), index);
    std::snprintf(given, sizeof(given), "--seed: (%g, %g, %g) mm", seed[0], seed[1], seed[2]);
  }
  else
  {
    std::copy_n(segmentation.SeedVoxel.begin(), 3, index);
    image->TransformContinuousIndexToPhysicalPoint(index, seed.data());
    std::snprintf(given, sizeof(given), "--seed-voxel: (%g, %g, %g)", index[0], index[1], index[2]);
  }
  int extent[6];
  image->GetExtent(extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(index[axis] >= extent[2 * axis] - 0.5 && index[axis] <= extent[2 * axis + 1] + 0.5))
    {
      const double center[3] = { 0.5 * (extent[0] + extent[1]), 0.5 * (extent[2] + extent[3]),
        0.5 * (extent[4] + extent[5]) };
      double middle[3];
      image->TransformContinuousIndexToPhysicalPoint(center, middle);
      char place[256];
      std::snprintf(place, sizeof(place),
        "which has %d x %d x %d voxels around (%g, %g, %g) mm. Coordinates are LPS: a viewer that "
        "shows RAS has the signs of x and y the other way round.",
        extent[1] + 1, extent[3] + 1, extent[5] + 1, middle[0], middle[1], middle[2]);
      throw Failure(std::string(given) + " lies outside of '" + segmentation.Input + "', " + place);
    }
  }
  return seed;
}

double VolumeInMillilitres(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  vtkNew<vtkMassProperties> properties;
  properties->SetInputConnection(triangles->GetOutputPort());
  return properties->GetVolume() / 1000;
}

void PrintSummary(vtkFlipFreeSegmentation* filter, const Segmentation& segmentation,
  double readingSeconds)
{
  double seconds[4];
  filter->GetStageSeconds(seconds);
  std::printf("%s: volume %.1f ml, %d iterations, %s, %d self-intersections; reading %.2f s, "
              "smoothing %.2f s, feature %.2f s, deformation %.2f s, label map %.2f s\n",
    segmentation.Input.c_str(), VolumeInMillilitres(filter->GetSurface()),
    static_cast<int>(filter->GetConvergence()->GetNumberOfRows()), filter->GetStopReasonAsString(),
    filter->GetNumberOfSelfIntersections(), readingSeconds, seconds[0], seconds[1], seconds[2],
    seconds[3]);
  std::fflush(stdout);
}

void WriteResults(vtkFlipFreeSegmentation* filter, vtkImageData* image,
  const Segmentation& segmentation, OutputFiles& outputs)
{
  const auto write =
    [&outputs](const std::string& name, const std::function<void(const std::string&)>& how)
  {
    if (!name.empty())
    {
      outputs.Write(name, how);
    }
  };
  write(segmentation.Surface,
    [&](const std::string& name) { WriteSurface(name, filter->GetSurface()); });
  write(segmentation.Labels,
    [&](const std::string& name) { WriteVolume(name, filter->GetLabelMap()); });
  write(segmentation.Convergence,
    [&](const std::string& name) { WriteTable(name, filter->GetConvergence()); });
  write(segmentation.Snapshot,
    [&](const std::string& name) { WriteSnapshot(name, image, filter->GetSurface()); });
  outputs.Commit();
}

void Segment(const Segmentation& segmentation)
{
  if (segmentation.Quiet)
  {
    ProgressBar::Disable();
  }
  RequireSense(segmentation);
  vtkNew<vtkFlipFreeSegmentation> filter;
  segmentation.Parameters.Apply(filter);
  OutputFiles outputs;
  AnnounceOutputs(segmentation, outputs);
  vtkSMPTools::Initialize(segmentation.Threads);

  const auto start = std::chrono::steady_clock::now();
  const vtkSmartPointer<vtkImageData> image =
    ReadVolume(segmentation.Input, segmentation.SeriesUID);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;

  const Point seed = SeedIn(image, segmentation);
  filter->SetInputDataObject(image);
  filter->SetSeedCenter(seed[0], seed[1], seed[2]);
  filter->SetSeedRadius(segmentation.Radius);
  filter->SetLabelValue(segmentation.Label);
  try
  {
    Run(filter, "segmenting");
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + segmentation.Input +
      "': " + WithOptionNames(Replaced(failure.what(), " on port 0", "")));
  }
  if (filter->GetSurface()->GetNumberOfPolys() == 0)
  {
    throw Failure("'" + segmentation.Input +
      "': no surface was found. Check that the seed and its radius lie within the organ.");
  }
  if (filter->GetStopReason() == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
  {
    throw Failure("'" + segmentation.Input +
      "': no boundary of the organ was found. Check that the seed and its radius lie within the "
      "organ, raise --search-distance, or raise --foreground-mass.");
  }
  WriteResults(filter, image, segmentation, outputs);
  if (filter->GetNumberOfSelfIntersections() > 0)
  {
    PrintWarning("The surface intersects itself in " +
      std::to_string(filter->GetNumberOfSelfIntersections()) +
      " pairs of triangles; it would not with --guard.");
  }
  if (!segmentation.Quiet)
  {
    PrintSummary(filter, segmentation, reading.count());
  }
}

const char* const Footer =
  "Results are written once all of them are there, or none is. The picture of --snapshot shows an\n"
  "axial, a sagittal and a coronal slice through the surface's center with the contour, and the\n"
  "surface; it needs a display (xvfb-run gives one to machines that have none).\n"
  "\n"
  "Examples:\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --seed-voxel 120 140 60 --radius 15 -o spleen.stl \\\n"
  "      --labels spleen.nii.gz --convergence spleen.csv --snapshot spleen.png\n"
  "  flipfree segment dicom/ --series 1.2.840.1 --seed 90 20 -640 --radius 12 -o kidney.vtp\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --preset naive -o flips.ply\n"
  "\n"
  "The seed is the center of a sphere within the organ, with at least half the radius of the\n"
  "largest one that fits there: its voxels tell what the organ looks like, and the surface starts\n"
  "from it.\n";

void AddFiles(CLI::App* command, Segmentation& segmentation)
{
  command
    ->add_option("INPUT", segmentation.Input,
      "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), or folder of a DICOM series")
    ->required();
  command
    ->add_option("--series", segmentation.SeriesUID,
      "Series Instance UID, where the folder holds several; by default, the one with most files")
    ->type_name("UID");
  command->add_option("--seed", segmentation.Seed, "Center of the seed sphere, in LPS millimeters")
    ->type_name("X Y Z")
    ->expected(3);
  command
    ->add_option("--seed-voxel", segmentation.SeedVoxel,
      "The same, as indices of a voxel that count from 0")
    ->type_name("I J K")
    ->expected(3);
  command->add_option("--radius", segmentation.Radius, "Radius of the seed sphere, in millimeters")
    ->type_name("MM")
    ->required();
  command->add_option("-o,--output", segmentation.Surface, "Surface (.vtp .stl .ply .obj)")
    ->type_name("FILE");
  command->add_option("--labels", segmentation.Labels, "Label map (.nii.gz .nii .nrrd .mha)")
    ->type_name("FILE");
  command->add_option("--convergence", segmentation.Convergence, "Table of the iterations (.csv)")
    ->type_name("FILE");
  command->add_option("--snapshot", segmentation.Snapshot, "Picture of the result (.png)")
    ->type_name("FILE");
  command
    ->add_option("--label-value", segmentation.Label,
      "Value of the organ in the label map, 1 to 255")
    ->type_name("N")
    ->check(CLI::Range(1, 255))
    ->capture_default_str();
  command->add_option("--threads", segmentation.Threads, "Threads to use; 0: all that there are")
    ->type_name("N")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
  command->add_flag("-q,--quiet", segmentation.Quiet, "Print nothing but errors and warnings");
}

} // namespace

void AddSegmentCommand(CLI::App& program)
{
  const auto segmentation = std::make_shared<Segmentation>();
  CLI::App* command = program.add_subcommand("segment", "Segment an organ from a sphere in it");
  AddFiles(command, *segmentation);
  segmentation->Parameters.AddOptions(*command);
  command->footer(Footer);
  command->callback([segmentation]() { Segment(*segmentation); });
}

} // namespace Command

#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"
#include "PointOptions.h"
#include "ProgressBar.h"
#include "Run.h"
#include "SegmentParameters.h"
#include "Snapshot.h"
#include "Subcommands.h"
#include "SurfaceFile.h"
#include "TableFile.h"
#include "VolumeFile.h"

#include "vtkFlipFreeDeform.h"
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
  PointOptions Corrections;
};

/// Checks all that can be checked before the volume is read.
void RequireSense(const Segmentation& segmentation)
{
  if (segmentation.Seed.empty() == segmentation.SeedVoxel.empty())
  {
    throw WrongUsage(segmentation.Seed.empty()
        ? "There is no seed. Give a point deep inside the organ: --seed X Y Z (LPS mm) or "
          "--seed-voxel I J K."
        : "Both --seed and --seed-voxel are given. Give only one of them.");
  }
  for (const double coordinate : segmentation.Seed)
  {
    if (!vtkMath::IsFinite(coordinate))
    {
      throw WrongUsage(
        "--seed: a coordinate is not a finite number. Give three numbers, in millimeters.");
    }
  }
  if (segmentation.Surface.empty() && segmentation.Labels.empty() &&
    segmentation.Convergence.empty() && segmentation.Snapshot.empty())
  {
    throw WrongUsage("No output is requested. Give at least one of --output, --labels, "
                     "--convergence and --snapshot.");
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
  segmentation.Corrections.RequireSense();
}

void AnnounceOutputs(const Segmentation& segmentation, OutputFiles& outputs)
{
  for (const std::string* name : { &segmentation.Surface, &segmentation.Labels,
         &segmentation.Convergence, &segmentation.Snapshot, &segmentation.Corrections.Output() })
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

/// The seed in millimeters. Throws Failure if it lies outside the volume.
Point SeedIn(vtkImageData* image, const Segmentation& segmentation)
{
  Point seed;
  double index[3];
  char given[128];
  if (segmentation.SeedVoxel.empty())
  {
    std::copy_n(segmentation.Seed.begin(), 3, seed.begin());
    if (segmentation.Corrections.AreRAS())
    {
      seed = { { -seed[0], -seed[1], seed[2] } };
    }
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
        "which has %d x %d x %d voxels centered at (%g, %g, %g) mm. Coordinates are LPS: viewers "
        "that show RAS have the opposite signs of x and y.",
        extent[1] + 1, extent[3] + 1, extent[5] + 1, middle[0], middle[1], middle[2]);
      throw Failure(std::string(given) + " lies outside '" + segmentation.Input + "', " + place);
    }
  }
  return seed;
}

double VolumeInMilliliters(vtkPolyData* surface)
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
    segmentation.Input.c_str(), VolumeInMilliliters(filter->GetSurface()),
    static_cast<int>(filter->GetConvergence()->GetNumberOfRows()), filter->GetStopReasonAsString(),
    filter->GetNumberOfSelfIntersections(), readingSeconds, seconds[0], seconds[1], seconds[2],
    seconds[3]);
  std::fflush(stdout);
}

void WriteResults(vtkFlipFreeSegmentation* filter, vtkImageData* image,
  const Segmentation& segmentation, const std::vector<CorrectionPoint>& points,
  OutputFiles& outputs)
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
  write(segmentation.Corrections.Output(),
    [&](const std::string& name) { WritePoints(name, points); });
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
  filter->SetSeedRadius(segmentation.Radius);
  if (filter->GetSeedRadius() != segmentation.Radius) // clamped, or NaN
  {
    throw WrongUsage("--radius must be a positive number of millimeters, 1e-6 to 1e6. The sphere "
                     "should lie within the organ.");
  }
  segmentation.Parameters.Apply(filter);
  OutputFiles outputs;
  AnnounceOutputs(segmentation, outputs);
  vtkSMPTools::Initialize(segmentation.Threads);
  const std::vector<CorrectionPoint> points = segmentation.Corrections.Points();

  const auto start = std::chrono::steady_clock::now();
  const vtkSmartPointer<vtkImageData> image =
    ReadVolume(segmentation.Input, segmentation.SeriesUID);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;

  const Point seed = SeedIn(image, segmentation);
  filter->SetInputDataObject(image);
  filter->SetSeedCenter(seed[0], seed[1], seed[2]);
  AddPoints(points, filter);
  filter->SetLabelValue(segmentation.Label);
  try
  {
    Run(filter, "segmenting", SegmentParameters::Names());
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + segmentation.Input + "': " + failure.what());
  }
  if (filter->GetSurface()->GetNumberOfPolys() == 0)
  {
    throw Failure("'" + segmentation.Input +
      "': no surface was found. Check that the seed sphere lies within the organ.");
  }
  if (filter->GetStopReason() == vtkFlipFreeSegmentation::NO_BOUNDARY_FOUND)
  {
    throw Failure(
      "'" + segmentation.Input + "': no boundary of the organ was found, so nothing is written.");
  }
  WriteResults(filter, image, segmentation, points, outputs);
  if (!filter->GetDeform()->GetGuard() && filter->GetNumberOfSelfIntersections() == 0)
  {
    PrintWarning(
      "The surface is not certified: --guard is off. It does not intersect itself, though.");
  }
  if (!segmentation.Quiet)
  {
    PrintSummary(filter, segmentation, reading.count());
  }
}

const char* const Footer =
  "Either all output files are written or none. The picture of --snapshot shows the contour on\n"
  "axial, sagittal and coronal slices through the surface's center, and the surface; it needs a\n"
  "display (or xvfb-run).\n"
  "\n"
  "Examples:\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 -o liver.vtp\n"
  "  flipfree segment ct.nii.gz --seed-voxel 120 140 60 --radius 15 -o spleen.stl \\\n"
  "      --labels spleen.nii.gz --convergence spleen.csv --snapshot spleen.png\n"
  "  flipfree segment dicom/ --series 1.2.840.1 --seed 90 20 -640 --radius 12 -o kidney.vtp\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --preset naive -o flips.ply\n"
  "  flipfree segment ct.nii.gz --seed 83 -154 321 --radius 26 --outside 12 -160 310 \\\n"
  "      --inside 100 -120 330 -o corrected.vtp\n"
  "\n"
  "The seed sphere should lie within the organ and have at least half the radius of the largest\n"
  "sphere that fits there: the organ's intensities are learned from its voxels, and the surface\n"
  "starts from it.\n";

void AddFiles(CLI::App* command, Segmentation& segmentation)
{
  command
    ->add_option("INPUT", segmentation.Input,
      "Volume (.nii .nii.gz .nrrd .nhdr .mha .mhd) or folder of a DICOM series")
    ->required();
  command
    ->add_option("--series", segmentation.SeriesUID,
      "Series Instance UID, if the folder holds several series; by default, the one with the most "
      "files")
    ->type_name("UID");
  command->add_option("--seed", segmentation.Seed, "Center of the seed sphere, in LPS millimeters")
    ->type_name("X Y Z")
    ->expected(3);
  command
    ->add_option("--seed-voxel", segmentation.SeedVoxel,
      "The same as the indices of a voxel, which count from 0")
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
  command->add_option("--threads", segmentation.Threads, "Number of threads; 0: all available")
    ->type_name("N")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
  command->add_flag("-q,--quiet", segmentation.Quiet, "Print nothing but errors and warnings");
}

} // namespace

void AddSegmentCommand(CLI::App& program)
{
  const auto segmentation = std::make_shared<Segmentation>();
  CLI::App* command =
    program.add_subcommand("segment", "Segment an organ, starting from a sphere inside it");
  AddFiles(command, *segmentation);
  segmentation->Corrections.AddOptions(*command);
  segmentation->Parameters.AddOptions(*command);
  command->footer(Footer);
  command->callback([segmentation]() { Segment(*segmentation); });
}

} // namespace Command

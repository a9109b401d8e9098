#include "Segmentation.h"

#include "Coordinates.h"
#include "Failure.h"
#include "OutputFile.h"
#include "SeedRadius.h"
#include "SurfaceFile.h"
#include "VolumeFile.h"

#include <algorithm>

namespace Command
{
namespace
{

/// A label map in place of a seed.
void RequireNoSeed(const Segmentation& segmentation)
{
  if (!segmentation.Session.empty())
  {
    throw WrongUsage("--session has the seed. Leave out --start-labels.");
  }
  if (segmentation.HasSeed())
  {
    throw WrongUsage("--start-labels takes the place of the seed. Leave out --seed, --seed-voxel "
                     "and --radius; points correct the result.");
  }
}

/// Organs by name in place of a seed.
void RequireOnlyOrgans(const Segmentation& segmentation)
{
  if (!segmentation.Several.HasOrgans())
  {
    throw WrongUsage("--fixed is for organs that are given by --organ. Give one or more.");
  }
  if (segmentation.HasSeed() || !segmentation.Session.empty() || !segmentation.StartLabels.empty())
  {
    throw WrongUsage("--organ has the seed. Leave out --seed, --seed-voxel, --radius, --session "
                     "and --start-labels.");
  }
  if (segmentation.Corrections.HasFiles())
  {
    throw WrongUsage("--points and --save-points are for one organ. Give the points of several by "
                     "--inside, --outside and --boundary, after the organ that they belong to.");
  }
  segmentation.Several.Organs(segmentation.Corrections);
}

/// One for each seed.
void RequireRadii(const Segmentation& segmentation)
{
  const std::vector<double>& radii = segmentation.Radius;
  if (radii.empty())
  {
    throw WrongUsage(
      "--radius is missing. The seed is a sphere within the organ: give its radius in "
      "millimeters, --radius MM.");
  }
  if (!std::all_of(radii.begin(), radii.end(), IsSeedRadius))
  {
    throw WrongUsage(std::string("--radius ") + SeedRadiusRule + ".");
  }
  const std::size_t seeds = (segmentation.Seed.size() + segmentation.SeedVoxel.size()) / 3;
  if (radii.size() != seeds)
  {
    throw WrongUsage("There are " + std::to_string(seeds) + " seeds and " +
      std::to_string(radii.size()) + " radii. Give a --radius for each seed, in the same order.");
  }
}

/// An image and a seed, or a session.
void RequireStart(const Segmentation& segmentation)
{
  if (!segmentation.Session.empty())
  {
    if (segmentation.HasSeed() || segmentation.Parameters.HasPreset())
    {
      throw WrongUsage("--session has the seed and the preset. Leave out --seed, --seed-voxel, "
                       "--radius and --preset.");
    }
    if (!segmentation.Corrections.IsEmpty())
    {
      throw WrongUsage(
        "--session cannot be corrected by points. Give the image, --seed and --radius "
        "in its place.");
    }
    return;
  }
  if (segmentation.Input.empty())
  {
    throw WrongUsage("INPUT is required: a volume, or a folder of a DICOM series.");
  }
  if (!segmentation.StartLabels.empty() || segmentation.Several.HasOrgans())
  {
    return;
  }
  if (segmentation.Seed.empty() == segmentation.SeedVoxel.empty())
  {
    throw WrongUsage(segmentation.Seed.empty()
        ? "There is no seed. Give a point deep inside the organ: --seed X Y Z (LPS mm) or "
          "--seed-voxel I J K; or a label map to fill: --start-labels FILE; or several organs: "
          "--organ NAME X Y Z MM."
        : "Both --seed and --seed-voxel are given. Give only one of them.");
  }
  RequireCoordinates("--seed", segmentation.Seed);
  RequireCoordinates("--seed-voxel",
    { segmentation.SeedVoxel.begin(), segmentation.SeedVoxel.end() });
  RequireRadii(segmentation);
}

} // namespace

void RequireSense(const Segmentation& segmentation)
{
  segmentation.Corrections.RequireSense();
  if (!segmentation.Several.IsEmpty())
  {
    RequireOnlyOrgans(segmentation);
  }
  if (!segmentation.StartLabels.empty())
  {
    RequireNoSeed(segmentation);
  }
  RequireStart(segmentation);
  if (segmentation.Surface.empty() && segmentation.Labels.empty() &&
    segmentation.Convergence.empty() && segmentation.Snapshot.empty() &&
    segmentation.SessionOut.empty())
  {
    throw WrongUsage("No output is requested. Give at least one of --output, --labels, "
                     "--convergence, --snapshot and --save-session.");
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
  require("--save-session", segmentation.SessionOut, { ".json" });
}

std::string TitleOf(const Segmentation& segmentation, const char* quote)
{
  return quote + segmentation.Input + quote +
    (segmentation.Organ.empty() ? "" : ", " + segmentation.Organ);
}

OriginNames NamesOf(const Segmentation& segmentation)
{
  OriginNames names;
  names.Image = segmentation.Input;
  names.StartLabels = segmentation.StartLabels;
  names.Organs = { segmentation.Repeated.Title };
  names.Colors = { segmentation.Repeated.Color };
  for (const std::string* file : { &segmentation.Surface, &segmentation.Labels,
         &segmentation.Convergence, &segmentation.SessionOut })
  {
    if (names.Organs[0].empty() && !file->empty())
    {
      names.Organs[0] = OrganOfFile(*file);
    }
  }
  return names;
}

} // namespace Command

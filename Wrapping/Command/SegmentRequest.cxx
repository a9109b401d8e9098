#include "SegmentRequest.h"

#include "AskQuestions.h"
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
void RequireNoSeed(const SegmentRequest& request)
{
  if (!request.Session.empty())
  {
    throw WrongUsage("--session has the seed. Leave out --start-labels.");
  }
  if (request.HasSeed())
  {
    throw WrongUsage("--start-labels takes the place of the seed. Leave out --seed, --seed-voxel "
                     "and --radius; points correct the result.");
  }
}

/// Organs by name in place of a seed.
void RequireOnlyOrgans(const SegmentRequest& request)
{
  if (!request.Several.HasOrgans())
  {
    throw WrongUsage("--fixed is for organs that are given by --organ. Give one or more.");
  }
  if (request.HasSeed() || !request.Session.empty() || !request.StartLabels.empty())
  {
    throw WrongUsage("--organ has the seed. Leave out --seed, --seed-voxel, --radius, --session "
                     "and --start-labels.");
  }
  if (request.Corrections.HasFiles())
  {
    throw WrongUsage("--points and --save-points are for one organ. Give the points of several by "
                     "--inside, --outside and --boundary, after the organ that they belong to.");
  }
}

/// Somebody to answer, and one organ that the answers correct.
void RequireAnswers(const SegmentRequest& request)
{
  if (!request.Several.IsEmpty() || !request.Session.empty())
  {
    throw WrongUsage("--ask is for one organ, which starts from a seed or --start-labels. Leave it "
                     "out; --questions writes the questions of several.");
  }
  RequireTerminal();
}

/// One for each seed.
void RequireRadii(const SegmentRequest& request)
{
  const std::vector<double>& radii = request.Radius;
  if (radii.empty())
  {
    throw WrongUsage(
      "--radius is missing. The seed is a sphere within the organ: give its radius in "
      "millimeters, --radius MM.");
  }
  const auto wrong = std::find_if_not(radii.begin(), radii.end(), IsSeedRadius);
  if (wrong != radii.end())
  {
    throw WrongUsage("--radius " + SeedRadiusRule(*wrong) + ".");
  }
  const std::size_t seeds = (request.Seed.size() + request.SeedVoxel.size()) / 3;
  if (radii.size() != seeds)
  {
    throw WrongUsage(std::string("There are ") + (radii.size() > seeds ? "more" : "fewer") +
      " radii (" + std::to_string(radii.size()) + ") than seeds (" + std::to_string(seeds) +
      "). Give a --radius for each seed, in the same order.");
  }
}

/// An image and a seed, or a session.
void RequireStart(const SegmentRequest& request)
{
  if (!request.Session.empty())
  {
    if (request.HasSeed() || request.Parameters.HasPreset())
    {
      throw WrongUsage("--session has the seed and the preset. Leave out --seed, --seed-voxel, "
                       "--radius and --preset.");
    }
    if (!request.Corrections.IsEmpty())
    {
      throw WrongUsage(
        "--session cannot be corrected by points. Give the image, --seed and --radius "
        "in its place.");
    }
    return;
  }
  if (request.Input.empty())
  {
    throw WrongUsage("INPUT is required: a volume, or a folder of a DICOM series.");
  }
  if (!request.StartLabels.empty() || request.Several.HasOrgans())
  {
    return;
  }
  if (request.Seed.empty() == request.SeedVoxel.empty())
  {
    throw WrongUsage(request.Seed.empty()
        ? "There is no seed. Give a point deep inside the organ: --seed X Y Z (LPS mm) or "
          "--seed-voxel I J K; or a label map to fill: --start-labels FILE; or several organs: "
          "--organ NAME X Y Z MM."
        : "Both --seed and --seed-voxel are given. Give only one of them.");
  }
  RequireCoordinates("--seed", request.Seed);
  RequireCoordinates("--seed-voxel", { request.SeedVoxel.begin(), request.SeedVoxel.end() });
  RequireRadii(request);
}

} // namespace

void ValidateRequest(const SegmentRequest& request)
{
  request.Corrections.Validate();
  if (request.Asks)
  {
    RequireAnswers(request);
  }
  if (!request.Several.IsEmpty())
  {
    RequireOnlyOrgans(request);
  }
  if (!request.StartLabels.empty())
  {
    RequireNoSeed(request);
  }
  RequireStart(request);
  if (request.Surface.empty() && request.Labels.empty() && request.Convergence.empty() &&
    request.Questions.empty() && request.Snapshot.empty() && request.SessionOut.empty())
  {
    throw WrongUsage("No output is requested. Give at least one of --output, --labels, "
                     "--convergence, --questions, --snapshot and --save-session.");
  }
  const auto require =
    [](const char* option, const std::string& name, const std::vector<std::string>& endings)
  {
    if (!name.empty())
    {
      RequireEnding(option, name, endings);
    }
  };
  require("--output", request.Surface, SurfaceEndings());
  require("--labels", request.Labels, VolumeEndings());
  require("--convergence", request.Convergence, { ".csv" });
  require("--questions", request.Questions, { ".csv" });
  require("--snapshot", request.Snapshot, { ".png" });
  require("--save-session", request.SessionOut, { ".json" });
}

std::string TitleOf(const SegmentRequest& request, const char* quote)
{
  return InputTitle(quote + request.Input + quote, request.SeriesUID) +
    (request.Organ.empty() ? "" : ", " + request.Organ);
}

FlipFree::QuantityNames QuantitiesOf(const SegmentRequest& request)
{
  FlipFree::QuantityNames names = SegmentParameters::Names();
  if (request.Corrections.AreRas())
  {
    names["AddInsidePoint"] = "an inside point in LPS at";
    names["AddOutsidePoint"] = "an outside point in LPS at";
  }
  return names;
}

OriginNames NamesOf(const SegmentRequest& request)
{
  OriginNames names;
  names.Image = request.Input;
  names.Series = request.SeriesUID;
  names.StartLabels = request.StartLabels;
  names.StartLabel = request.StartLabel;
  names.Organs = { request.Repeated.Title };
  names.Colors = { request.Repeated.Color };
  for (const std::string* file :
    { &request.Surface, &request.Labels, &request.Convergence, &request.SessionOut })
  {
    if (names.Organs[0].empty() && !file->empty())
    {
      names.Organs[0] = OrganOfFile(*file);
    }
  }
  return names;
}

} // namespace Command

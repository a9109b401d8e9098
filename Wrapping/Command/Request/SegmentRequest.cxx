#include "SegmentRequest.h"

#include "Coordinates.h"
#include "Failure.h"
#include "FileFormats.h"
#include "Options.h"
#include "SeedRadius.h"

#include "Deformation/SegmentationParameters.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

#include <unistd.h>

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
  if (!isatty(STDIN_FILENO))
  {
    throw WrongUsage("--ask needs a terminal to ask at. Write the questions to a file by "
                     "--questions, and answer them by --inside and --outside.");
  }
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

/// Throws Failure for a voxel outside the volume.
void RequireVoxel(const std::array<int, 3>& index, const std::array<int, 3>& size,
  const std::string& volume)
{
  const bool isInside = std::equal(index.begin(), index.end(), size.begin(),
    [](int place, int count) { return place >= 0 && place < count; });
  if (!isInside)
  {
    std::ostringstream text;
    text << "--seed-voxel: (" << index[0] << ", " << index[1] << ", " << index[2]
         << ") lies outside '" << volume << "', which has " << size[0] << " x " << size[1] << " x "
         << size[2] << " voxels. The indices of a voxel count from 0.";
    throw Failure(text.str());
  }
}

} // namespace

std::vector<CorrectionPoint> SegmentRequest::Points() const
{
  return this->Session.empty() ? this->Corrections.Points() : this->Repeated.Corrections;
}

std::vector<CorrectionPoint> SegmentRequest::Seeds(const std::array<int, 3>& size,
  const std::function<std::array<double, 3>(const std::array<int, 3>&)>& placeOf) const
{
  std::vector<CorrectionPoint> seeds;
  for (std::size_t number = 0; number < this->Radius.size(); ++number)
  {
    CorrectionPoint seed{ FlipFree::ConstraintKind::Seed, {}, this->Radius[number] };
    if (this->SeedVoxel.empty())
    {
      seed.Place = this->Corrections.InLps(this->Seed.data() + 3 * number);
    }
    else
    {
      std::array<int, 3> index;
      std::copy_n(this->SeedVoxel.data() + 3 * number, 3, index.begin());
      RequireVoxel(index, size, this->Input);
      seed.Place = placeOf(index);
    }
    seeds.push_back(seed);
  }
  return seeds;
}

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
  RequireOutputs(OutputsOf(request));
}

std::vector<RequestedFile> OutputsOf(const SegmentRequest& request)
{
  return { { "--output", request.Surface, SurfaceEndings() },
    { "--labels", request.Labels, VolumeEndings() },
    { "--convergence", request.Convergence, { ".csv" } },
    { "--questions", request.Questions, { ".csv" } },
    { "--snapshot", request.Snapshot, { ".png" } },
    { "--save-session", request.SessionOut, { ".json" } } };
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
  if (names.Organs[0].empty())
  {
    names.Organs[0] =
      OrganOfFiles({ request.Surface, request.Labels, request.Convergence, request.SessionOut });
  }
  return names;
}

void AddOptions(CLI::App& command, SegmentRequest& request)
{
  AddOption(command, "INPUT", request.Input);
  AddOption(command, "--session", request.Session);
  AddOption(command, "--series", request.SeriesUID);
  AddOption(command, "--seed", request.Seed);
  AddOption(command, "--seed-voxel", request.SeedVoxel);
  AddOption(command, "--radius", request.Radius);
  AddOption(command, "--start-labels", request.StartLabels);
  AddOption(command, "--start-label", request.StartLabel)->needs("--start-labels");
  AddOption(command, "--output", request.Surface);
  AddOption(command, "--labels", request.Labels);
  AddOption(command, "--convergence", request.Convergence);
  AddOption(command, "--questions", request.Questions);
  AddOption(command, "--ask", request.Asks);
  AddOption(command, "--snapshot", request.Snapshot);
  AddOption(command, "--save-session", request.SessionOut);
  const auto* const label =
    FlipFree::FindParameter(FlipFree::SegmentationParameters(), "LabelValue");
  AddOption(command, "--label-value", request.Label)
    ->check(CLI::Range(static_cast<int>(label->Minimum), static_cast<int>(label->Maximum)));
  AddThreadsOption(command, request.Threads);
  AddOption(command, "--quiet", request.Quiet);
  request.Corrections.AddOptions(command);
  request.Several.AddOptions(command);
  request.Parameters.AddOptions(command);
}

} // namespace Command

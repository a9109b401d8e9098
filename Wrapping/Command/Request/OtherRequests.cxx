#include "OtherRequests.h"

#include "Failure.h"

#include "Phantom/AbdomenPhantom.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

namespace Command
{
namespace
{

/// Checks values of an option, one by one.
std::function<std::string(const std::string&)> MustBePositive(const char* values)
{
  return [values](const std::string& text)
  {
    double number = 0;
    const bool isNumber = CLI::detail::lexical_cast(text, number);
    return !isNumber || number > 0 // what is no number has a message of its own
      ? std::string()
      : text + " is not positive. Give " + values + ".";
  };
}

/// Three numbers with two digits.
std::string Coordinates(const Eigen::Vector3d& place)
{
  char text[100];
  std::snprintf(text, sizeof(text), "%.2f %.2f %.2f", place[0], place[1], place[2]);
  return text;
}

/// The seeds by their labels; the liver, which most start with, first.
std::vector<FlipFree::PhantomSeed> SeedsOf(const FlipFree::Phantom& phantom, bool isAbdomen)
{
  std::vector<FlipFree::PhantomSeed> seeds = phantom.Seeds;
  const auto rank = [isAbdomen](const FlipFree::PhantomSeed& seed)
  {
    const bool isLiver = isAbdomen && seed.Label == static_cast<int>(FlipFree::AbdomenLabel::Liver);
    return std::make_pair(!isLiver, seed.Label);
  };
  std::stable_sort(seeds.begin(), seeds.end(),
    [&rank](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return seeds;
}

/// The search lines reach the object. Until the end the surface also encloses background, so the
/// intensities must not be fitted again.
std::string FromOutsideText(const Eigen::Vector3d& seed, double radius,
  const Eigen::Vector3d& around, double radiusAround)
{
  char text[400];
  std::snprintf(text, sizeof(text),
    "object, from outside: --seed %s --radius %.2f --start-scale %.3f --start-offset %s "
    "--search-distance %.0f --no-reestimate-intensities --no-leak-control --iterations 100 "
    "--levels 4\n",
    Coordinates(seed).c_str(), radius, radiusAround / radius, Coordinates(around - seed).c_str(),
    2 * radiusAround);
  return text;
}

} // namespace

FlipFree::PhantomSettings SettingsOf(const PhantomRequest& request)
{
  const std::vector<std::string>& names = EntryOf("phantom", "NAME").Choices;
  const auto name = std::find(names.begin(), names.end(), request.Name);
  if (name == names.end())
  {
    std::vector<std::string> others = names;
    others.pop_back();
    throw WrongUsage("There is no phantom '" + request.Name + "'. Choose " + Joined(others, ", ") +
      " or " + names.back() + ".");
  }
  FlipFree::PhantomSettings settings;
  settings.Shape = static_cast<int>(name - names.begin());
  settings.Dimensions = request.Dimensions;
  settings.Spacing = Eigen::Vector3d(request.Spacing.data());
  return settings;
}

std::string PhantomText(const PhantomRequest& request)
{
  const FlipFree::PhantomSettings settings = SettingsOf(request);
  const FlipFree::ImageGeometry grid = FlipFree::GridOf(settings);
  const FlipFree::Phantom phantom = FlipFree::PhantomOf(settings, grid);
  const bool isAbdomen = settings.Shape == FlipFree::AbdomenShape;
  std::string text;
  for (const FlipFree::PhantomSeed& seed : SeedsOf(phantom, isAbdomen))
  {
    char radius[40];
    std::snprintf(radius, sizeof(radius), " --radius %.2f\n", seed.Start.Radius);
    text += std::string(FlipFree::NameOfPhantomLabel(settings.Shape, seed.Label)) + " (label " +
      std::to_string(seed.Label) + "): --seed " +
      Coordinates(FlipFree::GridToPhysical(grid, seed.Start.Center)) + radius;
  }
  // A vessel is too thin to be found from outside.
  if (phantom.Enclosing && !phantom.Ends && !phantom.Seeds.empty())
  {
    const FlipFree::Ball& start = phantom.Seeds.front().Start;
    text += FromOutsideText(FlipFree::GridToPhysical(grid, start.Center), start.Radius,
      FlipFree::GridToPhysical(grid, phantom.Enclosing->Center), phantom.Enclosing->Radius);
  }
  if (phantom.Ends)
  {
    text += "object, from end to end:";
    for (const Eigen::Vector3d& end : *phantom.Ends)
    {
      text += " --point " + Coordinates(FlipFree::GridToPhysical(grid, end));
    }
    text += "\n";
  }
  return text;
}

const std::string& EvaluateRequest::LabelOfSegmentation() const
{
  return this->SegmentationLabel.empty() ? this->Label : this->SegmentationLabel;
}

const std::string& EvaluateRequest::LabelOfReference() const
{
  return this->ReferenceLabel.empty() ? this->Label : this->ReferenceLabel;
}

void AddOptions(CLI::App& command, SurfacesRequest& request)
{
  AddOption(command, "LABELS", request.LabelMap);
  AddOption(command, "--output", request.Folder);
  AddOption(command, "--format", request.Format);
  AddOption(command, "--label", request.Labels)
    ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  AddOption(command, "--names", request.Names);
  request.Parameters.AddOptions(command, FlipFree::LabelSurfaceParameters());
  command.get_option("--distance")->excludes(command.get_option("--exact"));
  AddThreadsOption(command, request.Threads);
  AddOption(command, "--quiet", request.Quiet);
}

void AddOptions(CLI::App& command, EvaluateRequest& request)
{
  AddOption(command, "SEGMENTATION", request.Segmentation);
  AddOption(command, "REFERENCE", request.Reference);
  AddOption(command, "--label", request.Label);
  AddOption(command, "--segmentation-label", request.SegmentationLabel);
  AddOption(command, "--reference-label", request.ReferenceLabel);
  AddOption(command, "--csv", request.Csv);
  AddOption(command, "--voxelize", request.Voxelize);
  AddOption(command, "--quiet", request.Quiet);
}

void AddOptions(CLI::App& command, SeriesRequest& request)
{
  AddOption(command, "FOLDER", request.Folder);
  AddOption(command, "--csv", request.Csv);
  AddOption(command, "--quiet", request.Quiet);
}

void AddOptions(CLI::App& command, PhantomRequest& request)
{
  AddOption(command, "NAME", request.Name);
  AddOption(command, "--output", request.Folder);
  AddOption(command, "--size", request.Dimensions)->check(MustBePositive("--size NX NY NZ"));
  AddOption(command, "--spacing", request.Spacing)->check(MustBePositive("--spacing X Y Z, in mm"));
  AddOption(command, "--noise", request.Noise);
  AddOption(command, "--random-seed", request.RandomSeed);
  AddOption(command, "--lesions", request.Lesions)->check(CLI::Range(0, 20));
  AddOption(command, "--quiet", request.Quiet);
}

void AddOptions(CLI::App& command, CohortRequest& request)
{
  AddOption(command, "TABLE", request.Table);
  AddOption(command, "--output", request.Folder);
  AddOption(command, "--scheduler", request.Scheduler);
  AddOption(command, "--workers", request.Workers);
  AddOption(command, "--threads", request.Threads);
  AddOption(command, "--quiet", request.Quiet);
}

} // namespace Command

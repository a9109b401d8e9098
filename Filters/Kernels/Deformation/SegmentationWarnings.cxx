#include "Deformation/SegmentationWarnings.h"

#include "Deformation/PlausibilityCheck.h"
#include "Intensity/SurfaceConfidence.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace FlipFree
{
namespace
{

std::string WarningOf(const Implausibility& finding, double reach)
{
  // All of a surface is no warning, but a failure.
  const std::string percent =
    std::to_string(std::min(99L, std::lround(100 * finding.Fraction))) + " %";
  switch (finding.Reason)
  {
    case ImplausibilityReason::EndOfReach:
      return "The surface has reached the limit of its range, " + TextOf(reach) +
        " mm from the seed's center, and is cut there: it may have leaked, or the seed may lie in "
        "air; look at it, and raise {Reach} where the organ is that large.";
    case ImplausibilityReason::NoBoundary:
      return percent +
        " of the surface found no boundary, so it may not be an organ's; check that the seed "
        "sphere lies within the organ and not in air, or move {SeedCenter}.";
    case ImplausibilityReason::ImageBoundary:
      return percent +
        " of the surface lies at the image's border along two axes, so it may follow what "
        "surrounds the organ; check that the seed sphere lies within the organ and not in air, or "
        "move {SeedCenter}.";
    case ImplausibilityReason::None:
      break;
  }
  return {};
}

} // namespace

std::vector<std::string> WarningsOf(const OrganSurface& organ, const ImageGeometry& region,
  const ImageGeometry& image, const SeedSphere& seed, const OrganSegmentationSettings& settings,
  bool startsAtSeed)
{
  std::vector<std::string> warnings;
  if (!ContainsSphere(image, seed))
  {
    warnings.push_back("The seed sphere of " + TextOf(seed.Radius) +
      " mm reaches beyond the image; it should lie within the organ, so lower {SeedRadius} or move "
      "{SeedCenter}.");
  }
  if (!settings.Step.Guard && organ.SelfIntersections > 0)
  {
    warnings.push_back("The surface is not certified, and it intersects itself in " +
      std::to_string(organ.SelfIntersections) +
      " pairs of faces; switch {Guard} on for a valid surface.");
  }
  const bool foundNothing = organ.Reason == StopReason::NoBoundaryFound;
  if (foundNothing)
  {
    warnings.emplace_back("No vertex found the organ's boundary, so the surface is not the "
                          "organ's; check that the seed lies in the organ, or raise "
                          "{SearchDistance}, or raise {ForegroundMass}.");
  }
  if (organ.Reason == StopReason::NotRefined)
  {
    warnings.push_back(
      "The surface could not be refined without intersecting itself, so it has only " +
      std::to_string(organ.Mesh.NumberOfPoints()) +
      " vertices; lower {Levels} to start from a finer one.");
  }
  const Implausibility finding =
    CheckPlausibility(organ, region, image, seed.Radius, settings, startsAtSeed && !foundNothing);
  if (finding.Reason != ImplausibilityReason::None)
  {
    warnings.push_back(WarningOf(finding, ReachOf(settings.Smoothing, seed.Radius)));
  }
  return warnings;
}

std::string DoubtOf(double confidence, const OrganSegmentationSettings& settings)
{
  if (!settings.Feature.Carving || confidence >= DoubtfulConfidence)
  {
    return {};
  }
  char number[16];
  std::snprintf(number, sizeof(number), "%.2f", std::floor(100 * confidence) / 100);
  return "The result is doubtful: its confidence is " + std::string(number) + ", below " +
    TextOf(DoubtfulConfidence) +
    "; look at the contour where its confidence is low, and correct it there by points inside or "
    "outside the organ.";
}

} // namespace FlipFree

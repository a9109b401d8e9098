#include "Deformation/SegmentationWarnings.h"

#include "Evidence/SurfaceConfidence.h"
#include "Image/VoxelOffsets.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace FlipFree
{
namespace
{

// Times the scatter of the inner half. Of 98 seeds within organs, those of enough voxels have 3.9
// at most, two-colored kidneys included. In a phantom's liver, a sphere of 60 mm has 3.4, one of 70
// mm has 6.8.
constexpr double MixedSeedScatter = 4.5;

// Below this margin, per mm3, and of at least this part of the organ's volume; most of the smaller
// parts are neighbors, whatever their gray values. Of the 50 of that size that were cut off at
// first in 115 organs, 11 in 8 organs are below, and 4 of these were decided wrongly; of the other
// 39, 3.
constexpr double DoubtfulMargin = 2.1;
constexpr double DoubtfulVolume = 0.08;

// Of the vertices, beside voxels without data. Padding that only touches an organ stays below.
constexpr double EndsSilently = 0.02;

// A question with its remedy. To the millimeter, the place is still deep in the part.
std::string AskAbout(const DoubtfulPart& question)
{
  char milliliters[32];
  std::snprintf(milliliters, sizeof(milliliters), "%.0f ml", question.Volume / 1000);
  const Eigen::RowVector3d place = question.Place.array().round() + 0.0;
  const std::string numbers = TextOf(place[0]) + " " + TextOf(place[1]) + " " + TextOf(place[2]);
  return "Is the part of " + std::string(milliliters) + " at " + TextOf(place) + " mm organ? " +
    (question.IsIncluded ? "{AddOutsidePoint} " : "{AddInsidePoint} ") + numbers +
    (question.IsIncluded ? " removes it." : " adds it.");
}

std::string WarningOf(const Implausibility& finding, double reach)
{
  const std::string percent = PercentOf(finding.Fraction);
  switch (finding.Reason)
  {
    case ImplausibilityReason::EndOfReach:
      return "The surface has reached the limit of its range, " + TextOf(reach) +
        " mm from the seed's center, and is cut there: it may have leaked, or the seed may lie in "
        "air; look at it, and raise {Reach} where the organ is that large.";
    case ImplausibilityReason::NoBoundary:
      return percent +
        " of the surface found no boundary, so it may not be an organ's; check that the seed "
        "sphere lies within the organ and not in air, or move {SeedCenter}, or raise {SeedRadius} "
        "where the sphere is far too small.";
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

std::vector<std::string> WarningsOf(const OrganSurface& organ, const Implausibility& finding,
  const ImageGeometry& image, const SeedSphere& seed, const OrganSegmentationSettings& settings)
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
  if (organ.Reason == StopReason::NoBoundaryFound)
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
  if (finding.Reason != ImplausibilityReason::None)
  {
    warnings.push_back(WarningOf(finding, ReachOf(settings.Smoothing, seed.Radius)));
  }
  return warnings;
}

std::string WarningOfMixedSeed(double scatter, const SeedSphere& seed, const SeedSphere& used)
{
  if (!(scatter > MixedSeedScatter))
  {
    return {};
  }
  const std::string consequence = used.Radius < seed.Radius
    ? "a sphere of " + TextOf(used.Radius) + " mm was used in its place. If the result is wrong, "
    : std::string();
  return "The seed sphere of " + TextOf(seed.Radius) +
    " mm seems to reach out of the organ, since its gray values scatter far more than those in its "
    "inner half; " +
    consequence + "lower {SeedRadius} or move {SeedCenter}.";
}

std::string WarningOfNoData(const PointList& points, const BitMask& noData)
{
  if (!noData.HasGrid())
  {
    return {};
  }
  const ImageGeometry& geometry = noData.GetGeometry();
  Eigen::Index count = 0;
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const std::array<int, 3> voxel = NearestVoxel(geometry, points.row(vertex).transpose());
    bool isBeside = false;
    VisitSurroundings(voxel, geometry,
      [&](std::size_t offset)
      {
        const std::array<int, 3> other = IndexOf(offset, geometry);
        isBeside = isBeside || noData(other[0], other[1], other[2]);
      });
    count += isBeside ? 1 : 0;
  }
  const double fraction = static_cast<double>(count) / static_cast<double>(points.rows());
  if (fraction <= EndsSilently)
  {
    return {};
  }
  return PercentOf(fraction) +
    " of the surface lies where the image has no data (NaN), and goes no further; where the organ "
    "does, interpolate those voxels.";
}

std::string WarningOfDoubt(double confidence, const std::vector<DoubtfulPart>& questions,
  double volume, const OrganSegmentationSettings& settings)
{
  const auto doubtful = std::find_if(questions.begin(), questions.end(),
    [volume](const DoubtfulPart& part)
    { return part.Margin < DoubtfulMargin && part.Volume > DoubtfulVolume * volume; });
  std::string question = doubtful == questions.end() ? std::string() : AskAbout(*doubtful);
  if (!settings.Feature.Carving || confidence >= DoubtfulConfidence)
  {
    return question;
  }
  char number[16];
  std::snprintf(number, sizeof(number), "%.2f", std::floor(100 * confidence) / 100);
  return "The result is doubtful: its confidence is " + std::string(number) + ", below " +
    TextOf(DoubtfulConfidence) +
    (question.empty() ? "; look at the contour where its confidence is low, and correct it there "
                        "by points inside or outside the organ."
                      : ". " + question);
}

} // namespace FlipFree

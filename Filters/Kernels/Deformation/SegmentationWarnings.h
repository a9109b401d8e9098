/**
 * Warnings, in words, about a segmentation that has a result but may be wrong.
 */
#ifndef FlipFreeSegmentationWarnings_h
#define FlipFreeSegmentationWarnings_h

#include "Deformation/OrganSegmentation.h"
#include "Deformation/PlausibilityCheck.h"
#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Mesh/SurfaceVoxelization.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// A message for each, with its remedy.
std::vector<std::string> WarningsOf(const OrganSurface& organ, const Implausibility& finding,
  const ImageGeometry& image, const SeedSphere& seed, const OrganSegmentationSettings& settings);

/// A message for a seed sphere whose gray values scatter far more than those of its inner half
/// (ScatterOverInnerHalf); empty for any other. `used` is the sphere that took its place, or the
/// same.
std::string WarningOfMixedSeed(double scatter, const SeedSphere& seed, const SeedSphere& used);

/// A message for a surface of which a part lies where the image has no data (NoData.h), with its
/// remedy; empty for any other. `noData` may have no grid.
std::string WarningOfNoData(const PointList& points, const BitMask& noData);

/// A message for a result that is doubtful, with its remedy: its confidence is low, or there is a
/// question (PartQuestions.h) whose margin is small and whose part matters in an organ of this
/// volume, in mm3. The first such question is the remedy. Empty for any other result; without
/// carving, the confidence's threshold does not hold.
std::string WarningOfDoubt(double confidence, const std::vector<DoubtfulPart>& questions,
  double volume, const OrganSegmentationSettings& settings);

} // namespace FlipFree

#endif

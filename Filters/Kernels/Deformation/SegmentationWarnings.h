/**
 * Warnings, in words, about a segmentation that has a result but may be wrong.
 */
#ifndef FlipFreeSegmentationWarnings_h
#define FlipFreeSegmentationWarnings_h

#include "Deformation/OrganSegmentation.h"
#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Mesh/SurfaceVoxelization.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// A message for each, with its remedy.
std::vector<std::string> WarningsOf(const OrganSurface& organ, const ImageGeometry& region,
  const ImageGeometry& image, const SeedSphere& seed, const OrganSegmentationSettings& settings,
  bool startsAtSeed);

/// A message for a seed sphere whose gray values scatter far more than those of its inner half,
/// with its remedy; empty for any other. `image` has values in the sphere, before smoothing.
std::string WarningOfMixedSeed(const ImageView<float>& image, const SeedSphere& seed);

/// A message for each, with its remedy, about a surface that fills labels: it misses a part of
/// them, or, if it is free of constraints, which may add to them, it encloses much more. `voxels`
/// are the surface's; `name` is the labels'.
std::vector<std::string> WarningsOfFilling(const BitMask& labels,
  const std::vector<VoxelRun>& voxels, const std::string& name, bool isFree);

/// A message for each of the largest parts, with its remedy, of which the cut was not sure and
/// which matter in an organ of these voxels, on the grid of the image.
std::vector<std::string> WarningsOfParts(const std::vector<DoubtfulPart>& doubts,
  const std::vector<VoxelRun>& voxels, const ImageGeometry& image);

/// A message for a result of low confidence, with its remedy; empty for any other, and without
/// carving, for which the threshold does not hold.
std::string DoubtOf(double confidence, const OrganSegmentationSettings& settings);

} // namespace FlipFree

#endif

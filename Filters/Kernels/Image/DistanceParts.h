/**
 * The parts of a shape that are connected by necks, at any scale: one around each peak of its
 * distance transform, divided where the neck is narrow compared with the smaller of the two parts.
 */
#ifndef FlipFreeDistanceParts_h
#define FlipFreeDistanceParts_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

struct DistanceParts
{
  static constexpr int Outside = -1;

  std::vector<int> PartOf;     ///< of each voxel: the number of its part, or Outside
  std::vector<float> Peaks;    ///< of each part: its greatest squared distance
  std::vector<bool> HoldsSeed; ///< of each part
};

/// Voxels join their parts in the order of their distance from the outside (a max-tree). Two parts
/// that meet at a neck become one if the neck's radius is at least `ratio` times that of the
/// smaller part, or if both hold voxels of the seed. Voxels at distance zero are outside.
DistanceParts FindDistanceParts(const std::vector<float>& squaredDistance,
  const ImageGeometry& geometry, const std::vector<std::size_t>& seed, double ratio);

} // namespace FlipFree

#endif

/**
 * The part of a shape around a point that is connected to another point only by a neck.
 */
#ifndef FlipFreeDepthHill_h
#define FlipFreeDepthHill_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

struct DepthHill
{
  float Saddle = 0; ///< squared distance from the outside where the hill meets the other one
  float Peak = 0;   ///< the hill's greatest squared distance
  /// Per voxel whether it belongs to the hill: it is deeper than the saddle, and is connected
  /// to the point there. Empty if there is none: the way from the point to the other one never
  /// becomes narrower than it begins or ends.
  std::vector<bool> Holds;
};

/// Voxels join in the order of their squared distance from the outside (a max-tree), until the
/// parts of voxel `own` and of voxel `other` meet. Voxels at distance zero are outside.
DepthHill FindDepthHill(const std::vector<float>& squaredDistance, const ImageGeometry& geometry,
  std::size_t own, std::size_t other);

} // namespace FlipFree

#endif

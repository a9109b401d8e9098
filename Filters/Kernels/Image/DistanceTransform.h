/**
 * Exact Euclidean distance transform with any spacing, in time linear in the number of voxels
 * (P. Felzenszwalb, D. Huttenlocher: Distance transforms of sampled functions, 2012). The transform
 * works along one axis after the other. On a sheared grid (a tilted gantry's) the angles between
 * the axes are ignored.
 */
#ifndef FlipFreeDistanceTransform_h
#define FlipFreeDistanceTransform_h

#include "Image/BitMask.h"

namespace FlipFree
{

/// Squared distance, in square millimeters, from each voxel center to the nearest voxel center of
/// the mask whose value is `target` (0 or 1); a large number if there is none. Empty if the
/// monitor, asked before each of two passes over the mask, stopped it.
std::vector<float> SquaredDistance(const std::vector<unsigned char>& mask,
  const ImageGeometry& geometry, unsigned char target, const ParallelFor& parallelFor,
  const Monitor& monitor);

/// The same, to the voxels that are in the set, or to those that are not.
std::vector<float> SquaredDistance(const BitMask& mask, bool target, const ParallelFor& parallelFor,
  const Monitor& monitor);

} // namespace FlipFree

#endif

/**
 * Exact Euclidean distance transform with any spacing, in time linear in the number of voxels
 * (P. Felzenszwalb, D. Huttenlocher: Distance transforms of sampled functions, 2012). Euclidean
 * where the grid's axes are at right angles, whichever way they point. The transform works along
 * one axis after the other and knows no angle between them: on a sheared grid (a tilted gantry's)
 * its distances are those of the voxels put up at right angles.
 */
#ifndef FlipFreeDistanceTransform_h
#define FlipFreeDistanceTransform_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// Squared distance, in square millimeters, from each voxel center to the nearest voxel center of
/// the mask whose value is `target` (0 or 1); a large number where there is none. Empty if the
/// monitor, asked before each of two passes over the mask, stopped it.
std::vector<float> SquaredDistance(const std::vector<unsigned char>& mask,
  const ImageGeometry& geometry, unsigned char target, const ParallelFor& parallelFor,
  const Monitor& monitor);

} // namespace FlipFree

#endif

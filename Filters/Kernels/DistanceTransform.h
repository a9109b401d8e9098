/**
 * Exact Euclidean distance transform with any spacing, in time linear in the number of voxels
 * (P. Felzenszwalb, D. Huttenlocher: Distance transforms of sampled functions, 2012).
 */
#ifndef FlipFreeDistanceTransform_h
#define FlipFreeDistanceTransform_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// Squared distance, in square millimetres, from each voxel centre to the nearest voxel centre of
/// the mask whose value is `target` (0 or 1); a large number where there is none.
std::vector<float> SquaredDistance(const std::vector<unsigned char>& mask,
  const ImageGeometry& geometry, unsigned char target, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The order in which voxels join the parts of a max-tree of a distance transform.
 */
#ifndef FlipFreeDistanceOrder_h
#define FlipFreeDistanceOrder_h

#include <vector>

namespace FlipFree
{

/// The voxels of positive distance, from the greatest down, and equal ones by their number.
std::vector<int> OrderByDistance(const std::vector<float>& squaredDistance);

} // namespace FlipFree

#endif

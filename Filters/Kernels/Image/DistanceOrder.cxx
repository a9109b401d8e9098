#include "Image/DistanceOrder.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace FlipFree
{

// Positive floats are ordered as their bits, so that a number of 64 bits holds all that the order
// depends on.
std::vector<int> OrderByDistance(const std::vector<float>& squaredDistance)
{
  std::vector<std::uint64_t> keys;
  for (std::size_t voxel = 0; voxel < squaredDistance.size(); ++voxel)
  {
    if (squaredDistance[voxel] > 0)
    {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &squaredDistance[voxel], sizeof(bits));
      keys.push_back(std::uint64_t(~bits) << 32U | voxel);
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
    [](std::uint64_t key) { return static_cast<int>(key & 0xFFFFFFFFU); });
  return order;
}

} // namespace FlipFree

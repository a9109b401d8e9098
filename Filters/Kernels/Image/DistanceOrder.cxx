#include "Image/DistanceOrder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace FlipFree
{
namespace
{

struct Key
{
  std::uint32_t Bits;
  int Voxel;
};

// Stable sort by one 11-bit digit.
void SortByDigit(const std::vector<Key>& keys, int shift, std::vector<Key>& sorted)
{
  constexpr std::uint32_t mask = (1U << 11U) - 1;
  std::array<std::size_t, mask + 2> begin{};
  for (const Key& key : keys)
  {
    ++begin[(key.Bits >> shift & mask) + 1];
  }
  for (std::uint32_t digit = 0; digit < mask; ++digit)
  {
    begin[digit + 1] += begin[digit];
  }
  for (const Key& key : keys)
  {
    sorted[begin[key.Bits >> shift & mask]++] = key;
  }
}

} // namespace

// Positive floats are ordered as their bits. These are sorted digit by digit, the lowest first: a
// fraction of the time of comparisons, and equal distances stay in the order of the voxels.
std::vector<int> OrderByDistance(const std::vector<float>& squaredDistance)
{
  std::vector<Key> keys;
  keys.reserve(std::count_if(squaredDistance.begin(), squaredDistance.end(),
    [](float square) { return square > 0; }));
  for (std::size_t voxel = 0; voxel < squaredDistance.size(); ++voxel)
  {
    if (squaredDistance[voxel] > 0)
    {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &squaredDistance[voxel], sizeof(bits));
      keys.push_back({ ~bits, static_cast<int>(voxel) });
    }
  }
  std::vector<Key> sorted(keys.size());
  for (const int shift : { 0, 11, 22 })
  {
    SortByDigit(keys, shift, sorted);
    keys.swap(sorted);
  }
  std::vector<Key>().swap(sorted); // before another one takes memory
  std::vector<int> order;
  order.reserve(keys.size());
  for (const Key& key : keys)
  {
    order.push_back(key.Voxel);
  }
  return order;
}

} // namespace FlipFree

/**
 * The range of gray values that a picture of an image shows.
 */
#ifndef FlipFreeDisplayWindow_h
#define FlipFreeDisplayWindow_h

#include "KernelTypes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace FlipFree
{

/// From black to white. For a CT, recognized by its air, the abdominal window; otherwise from the
/// first to the 99th percentile. Never empty.
std::array<double, 2> DisplayWindowOf(std::vector<double> values);

/// Of about a million voxels, evenly chosen among those that are finite.
template <typename T>
std::array<double, 2> DisplayWindowOf(const ImageView<T>& image)
{
  const std::size_t size = image.Geometry.NumberOfVoxels();
  const std::size_t step = std::max<std::size_t>(1, size / 1000000);
  std::vector<double> values;
  for (std::size_t voxel = 0; voxel < size; voxel += step)
  {
    const auto value = static_cast<double>(image.Data[voxel]);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  return DisplayWindowOf(std::move(values));
}

} // namespace FlipFree

#endif

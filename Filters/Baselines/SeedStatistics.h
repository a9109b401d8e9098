/**
 * Private to the module: mean and deviation of an image over the seed sphere.
 */
#ifndef FlipFreeSeedStatistics_h
#define FlipFreeSeedStatistics_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace FlipFree
{

struct SeedStatistics
{
  double Mean = 0;
  double StandardDeviation = 0;
};

/// Over the voxels with the given offsets, of which there is one at least.
inline SeedStatistics StatisticsOf(const float* image, const std::vector<std::size_t>& voxels)
{
  double sum = 0;
  for (const std::size_t voxel : voxels)
  {
    sum += image[voxel];
  }
  const double mean = sum / static_cast<double>(voxels.size());
  double squares = 0;
  for (const std::size_t voxel : voxels)
  {
    squares += (image[voxel] - mean) * (image[voxel] - mean);
  }
  return { mean, std::sqrt(squares / static_cast<double>(voxels.size())) };
}

} // namespace FlipFree

#endif

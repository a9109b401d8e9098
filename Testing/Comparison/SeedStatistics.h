/**
 * Mean and standard deviation over the seeds, and how fast a front that is driven by them grows or
 * shrinks at an intensity.
 */
#ifndef FlipFreeSeedStatistics_h
#define FlipFreeSeedStatistics_h

#include "BaselineTask.h"

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

/// 1 at the middle of the interval, 0 at its ends, -1 at as far again and beyond. Bounded, since
/// the steps would follow the greatest speed: that of air beside bone.
struct IntensityInterval
{
  double Mean = 0;
  double HalfWidth = 1;

  double Speed(double value) const
  {
    return std::max(-1.0, 1 - std::abs(value - this->Mean) / this->HalfWidth);
  }
};

/// Reaches from the seed's mean by this many of its deviations to either side.
inline IntensityInterval IntervalOf(const BaselineTask& task, double deviations)
{
  const SeedStatistics seed = StatisticsOf(task.Region.Voxels.data(), task.SeedVoxels);
  // Of a seed of one value any other is background.
  return { seed.Mean,
    std::max(deviations * seed.StandardDeviation, 1e-6 * (1 + std::abs(seed.Mean))) };
}

} // namespace FlipFree

#endif

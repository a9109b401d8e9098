/**
 * Private to the module: how fast a front grows or shrinks where it meets a gray value.
 */
#ifndef FlipFreeIntensityInterval_h
#define FlipFreeIntensityInterval_h

#include "BaselineTask.h"
#include "SeedStatistics.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

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

/// Around the seed's mean, by so many of its deviations to either side.
inline IntensityInterval IntervalOf(const BaselineTask& task, double deviations)
{
  const SeedStatistics seed =
    StatisticsOf(task.Region.Voxels.data(), VoxelsInSphere(task.Region.Geometry, task.Seed));
  // Of a seed of one value any other is background.
  return { seed.Mean,
    std::max(deviations * seed.StandardDeviation, 1e-6 * (1 + std::abs(seed.Mean))) };
}

} // namespace FlipFree

#endif

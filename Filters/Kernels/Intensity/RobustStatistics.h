/**
 * Location and scale of gray values that outliers hardly affect.
 */
#ifndef FlipFreeRobustStatistics_h
#define FlipFreeRobustStatistics_h

#include <vector>

namespace FlipFree
{

struct RobustStatistics
{
  double Median = 0; ///< of an even number of values the upper one
  double StandardDeviation =
    0; ///< of normally distributed values, by the median absolute deviation
};

/// Values that are not finite do not count; without any, all is zero. Uses up the values.
RobustStatistics RobustStatisticsOf(std::vector<float>& values);

} // namespace FlipFree

#endif

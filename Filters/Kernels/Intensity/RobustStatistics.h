/**
 * Location and scale of gray values, which outliers hardly affect.
 */
#ifndef FlipFreeRobustStatistics_h
#define FlipFreeRobustStatistics_h

#include <vector>

namespace FlipFree
{

/// In gray values: of those that are all the same, in place of zero; below any difference of gray
/// values, whatever their unit is.
constexpr double LeastDeviation = 1e-30;

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

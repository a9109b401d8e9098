#include "Intensity/RobustStatistics.h"

#include "Quantile.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

RobustStatistics RobustStatisticsOf(std::vector<float>& values)
{
  constexpr double normal = 1.4826;
  values.erase(
    std::remove_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); }),
    values.end());
  if (values.empty())
  {
    return {};
  }
  const float median = TakeMedian(values);
  for (float& value : values)
  {
    value = std::abs(value - median);
  }
  return { median, normal * TakeMedian(values) };
}

} // namespace FlipFree

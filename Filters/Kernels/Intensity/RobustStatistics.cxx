#include "Intensity/RobustStatistics.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

float TakeMedian(std::vector<float>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

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

float TakeQuantile(std::vector<float>& values, double part)
{
  const auto place =
    values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

} // namespace FlipFree

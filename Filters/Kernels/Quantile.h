/**
 * Quantiles of values that need not be sorted.
 */
#ifndef FlipFreeQuantile_h
#define FlipFreeQuantile_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace FlipFree
{

/// The value that `place` others come before. There are more values than that, and none is NaN.
/// Changes their order.
template <typename T>
T TakePlace(std::vector<T>& values, std::size_t place)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The value that `part` of the values, 0 to 1, are not above; between two values the lesser one.
/// There is at least one, and none is NaN. Changes their order.
template <typename T>
T TakeQuantile(std::vector<T>& values, double part)
{
  return TakePlace(values, static_cast<std::size_t>(part * static_cast<double>(values.size() - 1)));
}

/// The median, of an even number of values the upper one; as TakeQuantile().
template <typename T>
T TakeMedian(std::vector<T>& values)
{
  return TakePlace(values, values.size() / 2);
}

} // namespace FlipFree

#endif

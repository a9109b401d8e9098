#include "Image/DisplayWindow.h"

namespace FlipFree
{

std::array<double, 2> DisplayWindowOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto quantile = [&values](double q)
  {
    return values.empty()
      ? 0.0
      : values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  };
  const double low = quantile(0.01);
  const double high = quantile(0.99);
  constexpr double least = -4096; // 12 bits; gray values of other scales have less
  if (low < -700 && low >= least && high > 100)
  {
    return { { -150, 250 } };
  }
  return { { low, high > low ? high : low + 1 } };
}

} // namespace FlipFree

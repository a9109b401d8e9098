#include "Image/DisplayWindow.h"

#include "Quantile.h"

namespace FlipFree
{

std::array<double, 2> DisplayWindowOf(std::vector<double> values)
{
  const double low = values.empty() ? 0 : TakeQuantile(values, 0.01);
  const double high = values.empty() ? 0 : TakeQuantile(values, 0.99);
  constexpr double least = -4096; // 12 bits; gray values of other scales have less
  if (low < -700 && low >= least && high > 100)
  {
    return { { -150, 250 } };
  }
  return { { low, high > low ? high : low + 1 } };
}

} // namespace FlipFree

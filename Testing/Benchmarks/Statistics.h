/**
 * Statistics of measurements: the median, and the exponent of a power law.
 */
#ifndef Statistics_h
#define Statistics_h

#include <Eigen/Core>

#include <algorithm>
#include <vector>

/// The mean of the middle two for an even number of values; zero for none.
inline double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// The b of y = a x^b, by least squares of the logarithms.
inline double FittedExponent(const std::vector<double>& xs, const std::vector<double>& ys)
{
  const auto size = static_cast<Eigen::Index>(xs.size());
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(xs.data(), size).log();
  const Eigen::ArrayXd y = Eigen::Map<const Eigen::ArrayXd>(ys.data(), size).log();
  return ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
}

#endif

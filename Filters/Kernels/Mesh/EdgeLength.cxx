#include "Mesh/EdgeLength.h"

#include <algorithm>
#include <numeric>

namespace FlipFree
{
namespace
{

// An edge that many times as long as the mean, or as the upper quartile, is not a usual one.
constexpr double MaximumRatio = 8;

// Each edge is visited from both ends.
template <typename Visit>
void VisitLengths(const std::vector<std::array<int, 4>>& neighbors, const PointList& points,
  const Visit& visit)
{
  for (std::size_t vertex = 0; vertex < neighbors.size(); ++vertex)
  {
    for (int neighbor : neighbors[vertex])
    {
      visit((points.row(vertex) - points.row(neighbor)).norm());
    }
  }
}

// Without strays, as long as they are less than a quarter.
double MeanOfUsual(const std::vector<std::array<int, 4>>& neighbors, const PointList& points)
{
  std::vector<double> lengths;
  lengths.reserve(4 * neighbors.size());
  VisitLengths(neighbors, points, [&](double length) { lengths.push_back(length); });
  const auto quartile = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4 * 3);
  std::nth_element(lengths.begin(), quartile, lengths.end());
  const double maximum = MaximumRatio * *quartile;
  const auto end = std::partition(lengths.begin(), lengths.end(),
    [=](double length) { return length <= maximum; });
  return std::accumulate(lengths.begin(), end, 0.0) / static_cast<double>(end - lengths.begin());
}

} // namespace

double TypicalEdgeLength(const std::vector<std::array<int, 4>>& neighbors, const PointList& points)
{
  double sum = 0;
  double maximum = 0;
  VisitLengths(neighbors, points,
    [&](double length)
    {
      sum += length;
      maximum = std::max(maximum, length);
    });
  const double mean = sum / (4.0 * neighbors.size());
  return maximum > MaximumRatio * mean ? MeanOfUsual(neighbors, points) : mean;
}

} // namespace FlipFree

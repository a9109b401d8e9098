#include "Mesh/EdgeLength.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

constexpr double MaximumRatio = 20;

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

double Median(const std::vector<std::array<int, 4>>& neighbors, const PointList& points)
{
  std::vector<double> lengths;
  lengths.reserve(4 * neighbors.size());
  VisitLengths(neighbors, points, [&](double length) { lengths.push_back(length); });
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
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
  return maximum > MaximumRatio * mean ? Median(neighbors, points) : mean;
}

} // namespace FlipFree

#include "Geometry/SurfaceGap.h"

#include "Geometry/ClosestDirection.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

double SquaredDistanceOfBoxes(const TriangleBox& one, const TriangleBox& two)
{
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double gap =
      std::max({ 0.0, one.Low[axis] - two.High[axis], two.Low[axis] - one.High[axis] });
    sum += gap * gap;
  }
  return sum;
}

HullCorners CornersOf(const PointList& points, const Hull& hull)
{
  return { { points.row(hull[0]), points.row(hull[1]), points.row(hull[2]), points.row(hull[3]) } };
}

// How far two hulls are apart along the line between their centers: cheaper than the distance, and
// enough for most.
double DistanceAlongCenters(const HullCorners& one, const HullCorners& two)
{
  const Eigen::Vector3d direction =
    (one[0] + one[1] + one[2] + one[3] - two[0] - two[1] - two[2] - two[3]).normalized();
  return DistanceAlong(direction, one, two);
}

} // namespace

double MeasureMinimumGap(const PointList& points, const FaceHulls& hulls,
  const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
  // Threads race for the minimum, but there is only one minimum.
  std::atomic<double> least{ std::numeric_limits<double>::infinity() };
  parallelFor(0, hulls.NumberOfHulls(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int hull = static_cast<int>(first); hull < last; ++hull)
      {
        const HullCorners corners = CornersOf(points, hulls.HullAt(hull));
        TriangleBox box;
        for (const Eigen::Vector3d& corner : corners)
        {
          box.Add(corner.data());
        }
        hulls.Tree().Query([&](int node)
          { return !(SquaredDistanceOfBoxes(box, boxes[node]) > least); },
          [&](int other)
          {
            if (other > hull && hulls.AreDisjoint(hull, other))
            {
              const double distance =
                ClosestDirection(corners, CornersOf(points, hulls.HullAt(other))).squaredNorm();
              double present = least;
              while (distance < present && !least.compare_exchange_weak(present, distance))
              {
              }
            }
          });
      }
    });
  return std::sqrt(least);
}

std::vector<HullPair> FindPairsNearerThan(double gap, const PointList& points,
  const FaceHulls& hulls, const std::vector<HullPair>& adjacent, const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = hulls.RefitBoxes(points);
  const double square = gap * gap;
  const auto isNearer = [&](const Hull& one, const Hull& two)
  {
    const HullCorners first = CornersOf(points, one);
    const HullCorners second = CornersOf(points, two);
    return !(DistanceAlongCenters(first, second) >= gap || ProvenDistance(first, second) >= gap);
  };
  std::vector<HullPair> near;
  for (const auto& pair : hulls.Tree().SelfPairs([&](int node, int other)
         { return SquaredDistanceOfBoxes(boxes[node], boxes[other]) <= square; },
         [&](int one, int two)
         { return hulls.AreDisjoint(one, two) && isNearer(hulls.HullAt(one), hulls.HullAt(two)); },
         parallelFor))
  {
    near.push_back({ hulls.HullAt(pair.first), hulls.HullAt(pair.second),
      { { hulls.FaceOf(pair.first), hulls.FaceOf(pair.second) } } });
  }
  const std::vector<HullPair> nearAdjacent = Select(
    adjacent, [&](const HullPair& pair) { return isNearer(pair.One, pair.Two); }, parallelFor);
  near.insert(near.end(), nearAdjacent.begin(), nearAdjacent.end());
  return near;
}

} // namespace FlipFree

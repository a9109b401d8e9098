#include "Geometry/SurfaceGap.h"

#include "Geometry/ClosestDirection.h"
#include "Geometry/TriangleTree.h"

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

using Corners = std::array<Eigen::Vector3d, 3>;

Corners CornersOf(const PointList& points, const TriangleList& triangles, Eigen::Index triangle)
{
  return { { points.row(triangles(triangle, 0)), points.row(triangles(triangle, 1)),
    points.row(triangles(triangle, 2)) } };
}

bool ShareVertex(const TriangleList& triangles, Eigen::Index one, Eigen::Index two)
{
  for (int i = 0; i < 3; ++i)
  {
    if ((triangles.row(two).array() == triangles(one, i)).any())
    {
      return true;
    }
  }
  return false;
}

} // namespace

double MeasureMinimumGap(const PointList& points, const TriangleList& triangles,
  const ParallelFor& parallelFor)
{
  const TriangleTree tree(points, triangles);
  const std::vector<TriangleBox> boxes = tree.RefitBoxes(points, triangles);
  // Threads race for the minimum, but there is only one minimum.
  std::atomic<double> least{ std::numeric_limits<double>::infinity() };
  parallelFor(0, triangles.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t triangle = first; triangle < last; ++triangle)
      {
        const Corners corners = CornersOf(points, triangles, triangle);
        TriangleBox box;
        for (const Eigen::Vector3d& corner : corners)
        {
          box.Add(corner.data());
        }
        tree.Query([&](int node) { return !(SquaredDistanceOfBoxes(box, boxes[node]) > least); },
          [&](int other)
          {
            if (other > triangle && !ShareVertex(triangles, triangle, other))
            {
              const double distance =
                ClosestDirection(corners, CornersOf(points, triangles, other)).squaredNorm();
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

std::vector<std::pair<int, int>> FindPairsNearerThan(double gap, const TriangleTree& tree,
  const PointList& points, const TriangleList& triangles, const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = tree.RefitBoxes(points, triangles);
  const double square = gap * gap;
  return tree.SelfPairs([&](int node, int other)
    { return SquaredDistanceOfBoxes(boxes[node], boxes[other]) < square; },
    [&](int one, int two)
    {
      return !ShareVertex(triangles, one, two) &&
        ClosestDirection(CornersOf(points, triangles, one), CornersOf(points, triangles, two))
          .squaredNorm() < square;
    },
    parallelFor);
}

} // namespace FlipFree

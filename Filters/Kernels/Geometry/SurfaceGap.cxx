#include "Geometry/SurfaceGap.h"

#include "Geometry/ClosestTriangle.h"
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

// The distance of two segments is that of their lines' closest points, or else that of an end point
// to the other segment; the end points are left to the distances of vertices and triangles.
double SquaredDistanceOfEdges(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d cd = d - c;
  const Eigen::Vector3d normal = ab.cross(cd);
  const double squaredNormal = normal.squaredNorm();
  if (squaredNormal == 0)
  {
    return std::numeric_limits<double>::infinity();
  }
  const double s = (c - a).cross(cd).dot(normal) / squaredNormal;
  const double t = (c - a).cross(ab).dot(normal) / squaredNormal;
  if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1))
  {
    return std::numeric_limits<double>::infinity();
  }
  return (a + s * ab - c - t * cd).squaredNorm();
}

using Corners = std::array<Eigen::Vector3d, 3>;

Corners CornersOf(const PointList& points, const TriangleList& triangles, Eigen::Index triangle)
{
  return { { points.row(triangles(triangle, 0)), points.row(triangles(triangle, 1)),
    points.row(triangles(triangle, 2)) } };
}

double SquaredDistanceOfTriangles(const Corners& one, const Corners& two)
{
  const TriangleForDistance first(one[0], one[1], one[2]);
  const TriangleForDistance second(two[0], two[1], two[2]);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    least = std::min({ least, second.SquaredDistance(one[i]), first.SquaredDistance(two[i]) });
    for (int j = 0; j < 3; ++j)
    {
      least =
        std::min(least, SquaredDistanceOfEdges(one[i], one[(i + 1) % 3], two[j], two[(j + 1) % 3]));
    }
  }
  return least;
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
                SquaredDistanceOfTriangles(corners, CornersOf(points, triangles, other));
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
        SquaredDistanceOfTriangles(CornersOf(points, triangles, one),
          CornersOf(points, triangles, two)) < square;
    },
    parallelFor);
}

} // namespace FlipFree

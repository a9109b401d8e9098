#include "ClosestTriangle.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Distances are rounded, those to boxes too: only boxes that are farther beyond doubt are skipped,
// so that the result does not depend on the order of the search.
constexpr double Slack = 1 + 1e-12;

double SquaredDistanceToBox(const Eigen::Vector3d& point, const TriangleBox& box)
{
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double outside =
      std::max({ 0.0, box.Low[axis] - point[axis], point[axis] - box.High[axis] });
    sum += outside * outside;
  }
  return sum;
}

double SquaredDistanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b)
{
  const Eigen::Vector3d along = b - a;
  const double squaredLength = along.squaredNorm();
  const double t =
    squaredLength > 0 ? std::clamp(along.dot(point - a) / squaredLength, 0.0, 1.0) : 0.0;
  return (a + t * along - point).squaredNorm();
}

} // namespace

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = point - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double squaredArea = normal.squaredNorm();
  // The normal of a needle has no reliable direction; its sides are as good as its inside.
  if (squaredArea > 1e-20 * ab.squaredNorm() * ac.squaredNorm())
  {
    const double v = ap.cross(ac).dot(normal);
    const double w = ab.cross(ap).dot(normal);
    if (v >= 0 && w >= 0 && v + w <= squaredArea)
    {
      const double height = normal.dot(ap);
      return height * height / squaredArea;
    }
  }
  return std::min({ SquaredDistanceToSegment(point, a, b), SquaredDistanceToSegment(point, b, c),
    SquaredDistanceToSegment(point, c, a) });
}

ClosestTriangleFinder::ClosestTriangleFinder(const PointList& points, const TriangleList& triangles)
  : Points(points)
  , Triangles(triangles)
  , Tree(points, triangles)
  , Boxes(Tree.RefitBoxes(points, triangles))
{
}

double ClosestTriangleFinder::SquaredDistance(const Eigen::Vector3d& point, int triangle) const
{
  return SquaredDistanceToTriangle(point, this->Points.row(this->Triangles(triangle, 0)),
    this->Points.row(this->Triangles(triangle, 1)), this->Points.row(this->Triangles(triangle, 2)));
}

ClosestTriangle ClosestTriangleFinder::Find(const Eigen::Vector3d& point, int likelyTriangle) const
{
  ClosestTriangle closest;
  const auto visit = [&](int triangle)
  {
    const double squaredDistance = this->SquaredDistance(point, triangle);
    if (squaredDistance < closest.SquaredDistance)
    {
      closest = { triangle, squaredDistance };
    }
    return closest.SquaredDistance * Slack;
  };
  this->Tree.QueryNearestFirst([&](int node)
    { return SquaredDistanceToBox(point, this->Boxes[node]); },
    likelyTriangle >= 0 ? visit(likelyTriangle) : closest.SquaredDistance, visit);
  return closest;
}

} // namespace FlipFree

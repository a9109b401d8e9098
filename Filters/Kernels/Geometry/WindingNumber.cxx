#include "Geometry/WindingNumber.h"

#include "Geometry/TriangleTree.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

constexpr double Pi = 3.14159265358979323846;

Vector3d ClosestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& point)
{
  const Vector3d edge = b - a;
  const double square = edge.squaredNorm();
  const double along = square > 0 ? edge.dot(point - a) / square : 0;
  return a + std::fmax(0.0, std::fmin(1.0, along)) * edge;
}

Vector3d ClosestOnTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
  const Vector3d& point)
{
  const Vector3d normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  if (square > 0)
  {
    Vector3d foot = point - normal * (normal.dot(point - a) / square);
    if (normal.dot((b - a).cross(foot - a)) >= 0 && normal.dot((c - b).cross(foot - b)) >= 0 &&
      normal.dot((a - c).cross(foot - c)) >= 0)
    {
      return foot;
    }
  }
  Vector3d closest = a;
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& candidate :
    { ClosestOnSegment(a, b, point), ClosestOnSegment(b, c, point), ClosestOnSegment(c, a, point) })
  {
    const double away = (candidate - point).squaredNorm();
    if (away < least)
    {
      least = away;
      closest = candidate;
    }
  }
  return closest;
}

} // namespace

int WindingNumber(const PointList& points, const TriangleList& triangles, const Vector3d& point)
{
  double sum = 0;
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Vector3d a = points.row(triangles(triangle, 0)).transpose() - point;
    const Vector3d b = points.row(triangles(triangle, 1)).transpose() - point;
    const Vector3d c = points.row(triangles(triangle, 2)).transpose() - point;
    const double toA = a.norm();
    const double toB = b.norm();
    const double toC = c.norm();
    sum += std::atan2(a.dot(b.cross(c)),
      toA * toB * toC + a.dot(b) * toC + b.dot(c) * toA + c.dot(a) * toB);
  }
  return static_cast<int>(std::lround(sum / (2 * Pi)));
}

SurfacePlace ClosestPlace(const PointList& points, const TriangleList& triangles,
  const Vector3d& point)
{
  SurfacePlace place;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Vector3d closest = ClosestOnTriangle(points.row(triangles(triangle, 0)).transpose(),
      points.row(triangles(triangle, 1)).transpose(),
      points.row(triangles(triangle, 2)).transpose(), point);
    const double away = (closest - point).squaredNorm();
    if (away < least)
    {
      least = away;
      place = { static_cast<int>(triangle), closest };
    }
  }
  return place;
}

PointList ClosestPlaces(const PointList& points, const TriangleList& triangles,
  const PointList& queries, const ParallelFor& parallelFor)
{
  const TriangleTree tree(points, triangles);
  const std::vector<TriangleBox> boxes = tree.RefitBoxes(points, triangles);
  const std::vector<int> order = tree.Order();
  PointList closest(queries.rows(), 3);
  const auto closestTo = [&](const Vector3d& query)
  {
    Vector3d place = points.row(triangles(0, 0)).transpose();
    double least = (place - query).squaredNorm();
    tree.QueryNearestFirst(
      [&](int node)
      {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double outside = std::fmax(0.0,
            std::fmax(boxes[node].Low[axis] - query[axis], query[axis] - boxes[node].High[axis]));
          square += outside * outside;
        }
        return square;
      },
      least,
      [&](int leaf)
      {
        const auto corner = [&](int index) -> Vector3d
        { return points.row(triangles(order[leaf], index)).transpose(); };
        const Vector3d candidate = ClosestOnTriangle(corner(0), corner(1), corner(2), query);
        if ((candidate - query).squaredNorm() < least)
        {
          least = (candidate - query).squaredNorm();
          place = candidate;
        }
        return least;
      });
    return place;
  };
  parallelFor(0, queries.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t query = first; query < last; ++query)
      {
        closest.row(query) = closestTo(queries.row(query).transpose()).transpose();
      }
    });
  return closest;
}

} // namespace FlipFree

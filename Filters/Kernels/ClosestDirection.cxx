#include "ClosestDirection.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

double Clamp(double value)
{
  return std::min(std::max(value, 0.0), 1.0);
}

// From the closest point of the segment a b to p.
Vector3d FromSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const Vector3d edge = b - a;
  const double squaredLength = edge.squaredNorm();
  const double fraction = squaredLength > 0 ? Clamp((p - a).dot(edge) / squaredLength) : 0.0;
  return p - (a + fraction * edge);
}

Vector3d Shorter(const Vector3d& one, const Vector3d& two)
{
  return one.squaredNorm() <= two.squaredNorm() ? one : two;
}

} // namespace

Vector3d ClosestDirection(const std::array<Vector3d, 1>& point,
  const std::array<Vector3d, 3>& triangle)
{
  const Vector3d& p = point[0];
  const Vector3d& a = triangle[0];
  const Vector3d normal = (triangle[1] - a).cross(triangle[2] - a);
  const double squaredNormal = normal.squaredNorm();
  bool isAbove = squaredNormal > 0;
  for (int corner = 0; corner < 3 && isAbove; ++corner)
  {
    const Vector3d& start = triangle[corner];
    const Vector3d& end = triangle[(corner + 1) % 3];
    isAbove = (end - start).cross(p - start).dot(normal) >= 0;
  }
  if (isAbove)
  {
    return (p - a).dot(normal) / squaredNormal * normal;
  }
  return Shorter(FromSegment(p, triangle[0], triangle[1]),
    Shorter(FromSegment(p, triangle[1], triangle[2]), FromSegment(p, triangle[2], triangle[0])));
}

Vector3d ClosestDirection(const std::array<Vector3d, 2>& one, const std::array<Vector3d, 2>& two)
{
  const Vector3d u = one[1] - one[0];
  const Vector3d v = two[1] - two[0];
  const Vector3d w = one[0] - two[0];
  const Vector3d across = u.cross(v);
  const double squaredAcross = across.squaredNorm();
  if (squaredAcross > 0)
  {
    // Where the common perpendicular of the lines meets them.
    const double onOne = v.cross(w).dot(across);
    const double onTwo = u.cross(w).dot(across);
    if (onOne >= 0 && onOne <= squaredAcross && onTwo >= 0 && onTwo <= squaredAcross)
    {
      return across.dot(w) / squaredAcross * across;
    }
  }
  return Shorter(Shorter(FromSegment(one[0], two[0], two[1]), FromSegment(one[1], two[0], two[1])),
    Shorter(-FromSegment(two[0], one[0], one[1]), -FromSegment(two[1], one[0], one[1])));
}

Vector3d ClosestDirection(const std::array<Vector3d, 3>& one, const std::array<Vector3d, 3>& two)
{
  Vector3d shortest = one[0] - two[0];
  for (int i = 0; i < 3; ++i)
  {
    shortest = Shorter(shortest, ClosestDirection(std::array<Vector3d, 1>{ { one[i] } }, two));
    shortest = Shorter(shortest, -ClosestDirection(std::array<Vector3d, 1>{ { two[i] } }, one));
    for (int j = 0; j < 3; ++j)
    {
      shortest = Shorter(shortest,
        ClosestDirection(std::array<Vector3d, 2>{ { one[i], one[(i + 1) % 3] } },
          std::array<Vector3d, 2>{ { two[j], two[(j + 1) % 3] } }));
    }
  }
  return shortest;
}

} // namespace FlipFree

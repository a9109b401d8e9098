#include "Geometry/ClosestDirection.h"

#include <algorithm>
#include <limits>

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

// All ways in which two triangles may be closest, what they have in common worked out once. Vectors
// run from the second triangle to the first.
class TrianglePair
{
public:
  TrianglePair(const std::array<Vector3d, 3>& one, const std::array<Vector3d, 3>& two)
  {
    for (int i = 0; i < 3; ++i)
    {
      this->EdgesOfOne[i] = one[(i + 1) % 3] - one[i];
      this->EdgesOfTwo[i] = two[(i + 1) % 3] - two[i];
      for (int j = 0; j < 3; ++j)
      {
        this->Offsets[i][j] = one[i] - two[j];
      }
    }
  }

  Vector3d Find()
  {
    this->FromVerticesToEdges();
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        this->BetweenEdges(i, j);
      }
    }
    this->FromVerticesToFaces();
    return this->Shortest;
  }

private:
  void Offer(const Vector3d& offset)
  {
    const double square = offset.squaredNorm();
    if (square < this->ShortestSquare)
    {
      this->ShortestSquare = square;
      this->Shortest = offset;
    }
  }

  // The ends of the edges with them.
  void FromVerticesToEdges()
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const Vector3d& u = this->EdgesOfOne[edge];
      const Vector3d& v = this->EdgesOfTwo[edge];
      const double perU = InverseOf(u.squaredNorm());
      const double perV = InverseOf(v.squaredNorm());
      for (int vertex = 0; vertex < 3; ++vertex)
      {
        const Vector3d& toU = this->Offsets[edge][vertex];
        this->Offer(toU + Clamp(-toU.dot(u) * perU) * u);
        const Vector3d& fromV = this->Offsets[vertex][edge];
        this->Offer(fromV - Clamp(fromV.dot(v) * perV) * v);
      }
    }
  }

  // Where the common perpendicular of their lines meets both edges between their ends.
  void BetweenEdges(int i, int j)
  {
    const Vector3d& u = this->EdgesOfOne[i];
    const Vector3d& v = this->EdgesOfTwo[j];
    const Vector3d& w = this->Offsets[i][j];
    const Vector3d across = u.cross(v);
    const double square = across.squaredNorm();
    const double height = across.dot(w);
    if (square > 0 && height * height < this->ShortestSquare * square)
    {
      const double onOne = v.cross(w).dot(across);
      const double onTwo = u.cross(w).dot(across);
      if (onOne >= 0 && onOne <= square && onTwo >= 0 && onTwo <= square)
      {
        this->Offer(height / square * across);
      }
    }
  }

  // Where a vertex lies above the inside of the other triangle.
  void FromVerticesToFaces()
  {
    const auto& offsets = this->Offsets;
    for (int vertex = 0; vertex < 3; ++vertex)
    {
      this->AboveFace(this->EdgesOfTwo,
        { offsets[vertex][0], offsets[vertex][1], offsets[vertex][2] }, 1);
      this->AboveFace(this->EdgesOfOne,
        { -offsets[0][vertex], -offsets[1][vertex], -offsets[2][vertex] }, -1);
    }
  }

  // `fromCorners` run from the face's corners to the vertex.
  void AboveFace(const std::array<Vector3d, 3>& edges, const std::array<Vector3d, 3>& fromCorners,
    double sign)
  {
    const Vector3d normal = edges[0].cross(edges[1]);
    const double square = normal.squaredNorm();
    const double height = fromCorners[0].dot(normal);
    if (!(square > 0 && height * height < this->ShortestSquare * square))
    {
      return;
    }
    for (int corner = 0; corner < 3; ++corner)
    {
      if (edges[corner].cross(fromCorners[corner]).dot(normal) < 0)
      {
        return;
      }
    }
    this->Offer(sign * height / square * normal);
  }

  static double InverseOf(double square) { return square > 0 ? 1 / square : 0.0; }

  std::array<Vector3d, 3> EdgesOfOne;
  std::array<Vector3d, 3> EdgesOfTwo;
  std::array<std::array<Vector3d, 3>, 3> Offsets;
  Vector3d Shortest = Vector3d::Zero();
  double ShortestSquare = std::numeric_limits<double>::infinity();
};

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
  return TrianglePair(one, two).Find();
}

} // namespace FlipFree

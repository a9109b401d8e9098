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

// What the closest points of a hull may lie on.
struct Features
{
  explicit Features(const HullCorners& corners)
    : Corners(corners)
  {
    while (this->Count > 1 && corners[this->Count - 1] == corners[this->Count - 2])
    {
      --this->Count;
    }
    for (int i = 0; i < this->Count; ++i)
    {
      for (int j = i + 1; j < this->Count; ++j)
      {
        this->Edges[this->NumberOfEdges] = corners[j] - corners[i];
        const double square = this->Edges[this->NumberOfEdges].squaredNorm();
        this->PerEdge[this->NumberOfEdges] = square > 0 ? 1 / square : 0;
        this->Starts[this->NumberOfEdges++] = i;
      }
    }
  }

  const HullCorners& Corners;
  int Count = 4; // of different corners
  int NumberOfEdges = 0;
  std::array<Vector3d, 6> Edges;
  std::array<double, 6> PerEdge; // the inverse of its square
  std::array<int, 6> Starts;     // the corner that it starts from
};

// All ways in which two hulls may be closest.
class HullDistance
{
public:
  HullDistance(const HullCorners& one, const HullCorners& two)
    : One(one)
    , Two(two)
  {
    for (int i = 0; i < this->One.Count; ++i)
    {
      for (int j = 0; j < this->Two.Count; ++j)
      {
        this->Offsets[i][j] = one[i] - two[j];
      }
    }
  }

  Vector3d Find()
  {
    this->FromVerticesToEdges();
    for (int i = 0; i < this->One.NumberOfEdges; ++i)
    {
      for (int j = 0; j < this->Two.NumberOfEdges; ++j)
      {
        this->BetweenEdges(i, j);
      }
    }
    this->FromVerticesToFaces();
    return this->Shortest;
  }

private:
  // Vectors run from the second hull to the first.
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
    this->Offer(this->Offsets[0][0]); // there may be no edge
    for (int edge = 0; edge < this->One.NumberOfEdges; ++edge)
    {
      const Vector3d& u = this->One.Edges[edge];
      for (int vertex = 0; vertex < this->Two.Count; ++vertex)
      {
        const Vector3d& offset = this->Offsets[this->One.Starts[edge]][vertex];
        this->Offer(offset + Clamp(-offset.dot(u) * this->One.PerEdge[edge]) * u);
      }
    }
    for (int edge = 0; edge < this->Two.NumberOfEdges; ++edge)
    {
      const Vector3d& v = this->Two.Edges[edge];
      for (int vertex = 0; vertex < this->One.Count; ++vertex)
      {
        const Vector3d& offset = this->Offsets[vertex][this->Two.Starts[edge]];
        this->Offer(offset - Clamp(offset.dot(v) * this->Two.PerEdge[edge]) * v);
      }
    }
  }

  // Where the common perpendicular of their lines meets both edges between their ends.
  void BetweenEdges(int i, int j)
  {
    const Vector3d& u = this->One.Edges[i];
    const Vector3d& v = this->Two.Edges[j];
    const Vector3d& w = this->Offsets[this->One.Starts[i]][this->Two.Starts[j]];
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

  // Where a vertex lies above the inside of a face of the other hull.
  void FromVerticesToFaces()
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        for (int k = j + 1; k < 4; ++k)
        {
          for (int vertex = 0; k < this->Two.Count && vertex < this->One.Count; ++vertex)
          {
            const auto& from = this->Offsets[vertex];
            this->AboveFace(this->Two.Corners, { { i, j, k } }, from[i], from[j], from[k], 1);
          }
          for (int vertex = 0; k < this->One.Count && vertex < this->Two.Count; ++vertex)
          {
            const auto from = [&](int corner) -> Vector3d
            { return -this->Offsets[corner][vertex]; };
            this->AboveFace(this->One.Corners, { { i, j, k } }, from(i), from(j), from(k), -1);
          }
        }
      }
    }
  }

  // The vectors run from the face's corners to the vertex.
  void AboveFace(const HullCorners& corners, const std::array<int, 3>& face, const Vector3d& fromA,
    const Vector3d& fromB, const Vector3d& fromC, double sign)
  {
    const Vector3d ab = corners[face[1]] - corners[face[0]];
    const Vector3d bc = corners[face[2]] - corners[face[1]];
    const Vector3d normal = ab.cross(bc);
    const double square = normal.squaredNorm();
    const double height = fromA.dot(normal);
    if (square > 0 && height * height < this->ShortestSquare * square &&
      ab.cross(fromA).dot(normal) >= 0 && bc.cross(fromB).dot(normal) >= 0 &&
      (-ab - bc).cross(fromC).dot(normal) >= 0)
    {
      this->Offer(sign * height / square * normal);
    }
  }

  const Features One;
  const Features Two;
  std::array<std::array<Vector3d, 4>, 4> Offsets;
  Vector3d Shortest = Vector3d::Zero();
  double ShortestSquare = std::numeric_limits<double>::infinity();
};

} // namespace

Vector3d ClosestDirection(const HullCorners& one, const HullCorners& two)
{
  return HullDistance(one, two).Find();
}

double DistanceAlong(const Vector3d& direction, const HullCorners& one, const HullCorners& two)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int corner = 0; corner < 4; ++corner)
  {
    low = std::min(low, one[corner].dot(direction));
    high = std::max(high, two[corner].dot(direction));
  }
  return low - high;
}

double ProvenDistance(const HullCorners& one, const HullCorners& two)
{
  return DistanceAlong(ClosestDirection(one, two).normalized(), one, two);
}

} // namespace FlipFree

#include "Geometry/DistanceQuery.h"

#include <algorithm>
#include <limits>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Several points share one search, and vector instructions serve all of them: one lane each.
constexpr Eigen::Index NumberOfLanes = 8;
template <typename Scalar>
using LanesOf = Eigen::Array<Scalar, NumberOfLanes, 1>;
using Lanes = LanesOf<double>;
template <typename Scalar>
using PacketOf = std::array<LanesOf<Scalar>, 3>; // x, y, z
using PointPacket = PacketOf<double>;

// Boxes are kept in single precision. They are widened by this fraction of the surface's extent,
// and skipped only if they are farther beyond doubt, so that the result does not depend on the
// order of the search.
constexpr float Rounding = 1e-6F;
constexpr float Slack = 1 + 1e-5F;

double InverseOrZero(double value)
{
  return value > 0 ? 1 / value : 0;
}

Lanes Dot(const Vector3d& vector, const PointPacket& points)
{
  return vector.x() * points[0] + vector.y() * points[1] + vector.z() * points[2];
}

PointPacket Offsets(const PointPacket& points, const Vector3d& from)
{
  return { { points[0] - from.x(), points[1] - from.y(), points[2] - from.z() } };
}

// `offsets` are measured from the start of the edge.
Lanes SquaredDistancesToEdge(const PointPacket& offsets, const Vector3d& edge,
  double inverseSquaredLength)
{
  const Lanes t = (Dot(edge, offsets) * inverseSquaredLength).max(0.0).min(1.0);
  return (offsets[0] - t * edge.x()).square() + (offsets[1] - t * edge.y()).square() +
    (offsets[2] - t * edge.z()).square();
}

} // namespace

DistanceQuery::Triangle::Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
  : A(a)
  , AB(b - a)
  , AC(c - a)
  , Normal(AB.cross(AC))
  , SquaredNormal(Normal.squaredNorm())
  , InverseSquaredAB(InverseOrZero(AB.squaredNorm()))
  , InverseSquaredAC(InverseOrZero(AC.squaredNorm()))
  , InverseSquaredBC(InverseOrZero((AC - AB).squaredNorm()))
{
  // The normal of a needle has no reliable direction, and its edges are as close as its inside.
  if (!(this->SquaredNormal > 1e-20 * this->AB.squaredNorm() * this->AC.squaredNorm()))
  {
    this->SquaredNormal = 0;
  }
}

// Eight points near each other, which share one descent through the tree.
struct DistanceQuery::Packet
{
  PointPacket Points;
  PacketOf<float> Rounded;
  Box Bounds;
  Lanes Least;          // squared distances
  LanesOf<float> Bound; // of each point

  float UpdateBound()
  {
    this->Bound = Slack * this->Least.cast<float>();
    return this->Bound.maxCoeff();
  }
  Lanes SquaredDistancesTo(const Triangle& triangle) const
  {
    const PointPacket fromA = Offsets(this->Points, triangle.A);
    Lanes toEdges = SquaredDistancesToEdge(fromA, triangle.AB, triangle.InverseSquaredAB)
                      .min(SquaredDistancesToEdge(fromA, triangle.AC, triangle.InverseSquaredAC))
                      .min(SquaredDistancesToEdge(Offsets(fromA, triangle.AB),
                        triangle.AC - triangle.AB, triangle.InverseSquaredBC));
    if (triangle.SquaredNormal == 0)
    {
      return toEdges;
    }
    const Lanes weightOfB = Dot(triangle.AC.cross(triangle.Normal), fromA);
    const Lanes weightOfC = Dot(triangle.Normal.cross(triangle.AB), fromA);
    const Lanes minimumWeight =
      weightOfB.min(weightOfC).min(triangle.SquaredNormal - weightOfB - weightOfC);
    const Lanes toPlane = Dot(triangle.Normal, fromA).square() * (1 / triangle.SquaredNormal);
    return (minimumWeight < 0).select(toEdges, toPlane);
  }
  LanesOf<float> SquaredDistancesTo(const Box& box) const
  {
    LanesOf<float> sum = LanesOf<float>::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      sum += (box.Low[axis] - this->Rounded[axis])
               .max(this->Rounded[axis] - box.High[axis])
               .max(0.0F)
               .square();
    }
    return sum;
  }
};

DistanceQuery::DistanceQuery(const PointList& points, const TriangleList& triangles)
  : Tree(points, triangles)
  , Triangles(triangles.rows(), 3)
{
  TriangleBox extent;
  for (const int triangle : this->Tree.Order())
  {
    const Eigen::RowVector3i corners = triangles.row(triangle);
    this->Triangles.row(static_cast<Eigen::Index>(this->Shapes.size())) = corners;
    this->Shapes.emplace_back(points.row(corners[0]), points.row(corners[1]),
      points.row(corners[2]));
    for (const int corner : corners)
    {
      extent.Add(points.row(corner).data());
    }
  }
  const Eigen::Map<const Eigen::RowVector3d> low(extent.Low);
  const Eigen::Map<const Eigen::RowVector3d> high(extent.High);
  this->Center = (low + high) / 2;
  const auto margin = static_cast<float>(Rounding * (high - low).maxCoeff());
  this->Tree.Refit(this->Boxes,
    [&](int triangle)
    {
      Box box{ Eigen::Array4f::Zero(), Eigen::Array4f::Zero() };
      const auto corner = [&](int which) -> Eigen::Array3f
      { return (points.row(triangles(triangle, which)) - this->Center).cast<float>(); };
      box.Low.head<3>() = corner(0).min(corner(1)).min(corner(2)) - margin;
      box.High.head<3>() = corner(0).max(corner(1)).max(corner(2)) + margin;
      return box;
    });
}

Eigen::VectorXd DistanceQuery::DistancesOf(const PointList& points) const
{
  Eigen::VectorXd distances(points.rows());
  int closest = 0; // the place of the triangle closest to the last point of a packet
  for (Eigen::Index first = 0; first < points.rows(); first += NumberOfLanes)
  {
    const Eigen::Index size = std::min(NumberOfLanes, points.rows() - first);
    Packet packet{ {}, {}, { Eigen::Array4f::Zero(), Eigen::Array4f::Zero() }, {}, {} };
    for (int axis = 0; axis < 3; ++axis)
    {
      packet.Points[axis].setConstant(points(first, axis));
      packet.Points[axis].head(size) = points.col(axis).segment(first, size).array();
      packet.Rounded[axis] = (packet.Points[axis] - this->Center[axis]).cast<float>();
      packet.Bounds.Low[axis] = packet.Rounded[axis].minCoeff();
      packet.Bounds.High[axis] = packet.Rounded[axis].maxCoeff();
    }
    packet.Least = packet.SquaredDistancesTo(this->Shapes[closest]);
    float bound = packet.UpdateBound();
    this->Tree.QueryNearestFirst(
      [&](int node)
      {
        const float toBox = this->Boxes[node].SquaredDistanceTo(packet.Bounds);
        if (toBox > bound)
        {
          return toBox;
        }
        const LanesOf<float> toPoints = packet.SquaredDistancesTo(this->Boxes[node]);
        return (toPoints <= packet.Bound).any() ? toPoints.minCoeff()
                                                : std::numeric_limits<float>::infinity();
      },
      bound,
      [&](int place)
      {
        const Lanes found = packet.SquaredDistancesTo(this->Shapes[place]);
        closest = found[NumberOfLanes - 1] < packet.Least[NumberOfLanes - 1] ? place : closest;
        packet.Least = packet.Least.min(found);
        bound = packet.UpdateBound();
        return bound;
      });
    distances.segment(first, size) = packet.Least.head(size).sqrt();
  }
  return distances;
}

} // namespace FlipFree

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
using Lanes = Eigen::Array<double, NumberOfLanes, 1>;
using PointPacket = std::array<Lanes, 3>; // x, y, z

// Boxes are skipped only if they are farther by more than rounding errors, so that the result does
// not depend on the order of the search.
constexpr double Slack = 1 + 1e-9;

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
Lanes SquaredDistancesToEdge(const PointPacket& offsets, const Vector3d& edge)
{
  const Lanes t = (Dot(edge, offsets) * InverseOrZero(edge.squaredNorm())).max(0.0).min(1.0);
  return (offsets[0] - t * edge.x()).square() + (offsets[1] - t * edge.y()).square() +
    (offsets[2] - t * edge.z()).square();
}

struct Triangle
{
  Vector3d A;
  Vector3d B;
  Vector3d C;

  Lanes SquaredDistancesOf(const PointPacket& points) const
  {
    const Vector3d ab = this->B - this->A;
    const Vector3d ac = this->C - this->A;
    const PointPacket fromA = Offsets(points, this->A);
    Lanes toEdges = SquaredDistancesToEdge(fromA, ab)
                      .min(SquaredDistancesToEdge(fromA, ac))
                      .min(SquaredDistancesToEdge(Offsets(fromA, ab), ac - ab));
    const Vector3d normal = ab.cross(ac);
    const double squaredNormal = normal.squaredNorm();
    // The normal of a needle has no reliable direction, and its edges are as close as its inside.
    if (!(squaredNormal > 1e-20 * ab.squaredNorm() * ac.squaredNorm()))
    {
      return toEdges;
    }
    const Lanes weightOfB = Dot(ac.cross(normal), fromA);
    const Lanes weightOfC = Dot(normal.cross(ab), fromA);
    const Lanes minimumWeight = weightOfB.min(weightOfC).min(squaredNormal - weightOfB - weightOfC);
    const Lanes toPlane = Dot(normal, fromA).square() * (1 / squaredNormal);
    return (minimumWeight < 0).select(toEdges, toPlane);
  }
};

template <typename Box>
Lanes SquaredDistancesToBox(const PointPacket& points, const Box& box)
{
  Lanes sum = Lanes::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += (box.Low[axis] - points[axis]).max(points[axis] - box.High[axis]).max(0.0).square();
  }
  return sum;
}

} // namespace

DistanceQuery::DistanceQuery(const PointList& points, const TriangleList& triangles)
  : Points(points)
  , Triangles(triangles)
  , Tree(points, triangles)
{
  this->Tree.Refit(this->Boxes,
    [&](int triangle)
    {
      Box box{ Eigen::Array4d::Zero(), Eigen::Array4d::Zero() };
      const auto corner = [&](int which)
      { return points.row(triangles(triangle, which)).transpose().array(); };
      box.Low.head<3>() = corner(0).min(corner(1)).min(corner(2));
      box.High.head<3>() = corner(0).max(corner(1)).max(corner(2));
      return box;
    });
}

Eigen::VectorXd DistanceQuery::DistancesOf(const PointList& points) const
{
  const auto triangleAt = [this](int triangle)
  {
    const auto corner = this->Triangles.row(triangle);
    return Triangle{ this->Points.row(corner[0]), this->Points.row(corner[1]),
      this->Points.row(corner[2]) };
  };
  Eigen::VectorXd distances(points.rows());
  int closest = 0; // the triangle closest to the last point of a packet, where the next one begins
  for (Eigen::Index first = 0; first < points.rows(); first += NumberOfLanes)
  {
    const Eigen::Index size = std::min(NumberOfLanes, points.rows() - first);
    PointPacket packet;
    Box box{ Eigen::Array4d::Zero(), Eigen::Array4d::Zero() };
    for (int axis = 0; axis < 3; ++axis)
    {
      packet[axis].setConstant(points(first, axis));
      packet[axis].head(size) = points.col(axis).segment(first, size).array();
      box.Low[axis] = packet[axis].minCoeff();
      box.High[axis] = packet[axis].maxCoeff();
    }
    Lanes least = triangleAt(closest).SquaredDistancesOf(packet);
    double bound = Slack * least.maxCoeff();
    this->Tree.QueryNearestFirst(
      [&](int node)
      {
        const double toBox = this->Boxes[node].SquaredDistanceTo(box);
        if (toBox > bound)
        {
          return toBox;
        }
        const Lanes toPoints = SquaredDistancesToBox(packet, this->Boxes[node]);
        return (toPoints <= Slack * least).any() ? toPoints.minCoeff()
                                                 : std::numeric_limits<double>::infinity();
      },
      bound,
      [&](int index)
      {
        const Lanes found = triangleAt(index).SquaredDistancesOf(packet);
        closest = found[NumberOfLanes - 1] < least[NumberOfLanes - 1] ? index : closest;
        least = least.min(found);
        bound = Slack * least.maxCoeff();
        return bound;
      });
    distances.segment(first, size) = least.head(size).sqrt();
  }
  return distances;
}

TriangleList DistanceQuery::SortedTriangles() const
{
  TriangleList sorted(this->Triangles.rows(), 3);
  Eigen::Index row = 0;
  this->Tree.Query([](int) { return true; },
    [&](int triangle) { sorted.row(row++) = this->Triangles.row(triangle); });
  return sorted;
}

} // namespace FlipFree

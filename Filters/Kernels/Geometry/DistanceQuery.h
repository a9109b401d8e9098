/**
 * The exact distances of points to a surface of triangles.
 */
#ifndef FlipFreeDistanceQuery_h
#define FlipFreeDistanceQuery_h

#include "Geometry/TriangleTree.h"

namespace FlipFree
{

class DistanceQuery
{
public:
  /// The lists must have at least one triangle and be valid (RequireValidFaces).
  DistanceQuery(const PointList& points, const TriangleList& triangles);

  /// The distance of each point to the surface. Faster if consecutive points are close together.
  Eigen::VectorXd DistancesOf(const PointList& points) const;

  /// The triangles, in an order in which consecutive ones are close together.
  const TriangleList& GetSortedTriangles() const { return this->Triangles; }

private:
  // What the distances of many points to a triangle need.
  struct Triangle
  {
    Eigen::Vector3d A;
    Eigen::Vector3d AB;
    Eigen::Vector3d AC;
    Eigen::Vector3d Normal;
    double SquaredNormal; // 0 for a needle
    double InverseSquaredAB;
    double InverseSquaredAC;
    double InverseSquaredBC;

    Triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  };

  // Relative to the surface's center, and wider than in double precision. Four coordinates, the
  // last of them 0, for vector instructions without branches.
  struct Box
  {
    Eigen::Array4f Low;
    Eigen::Array4f High;

    void Merge(const Box& other)
    {
      this->Low = this->Low.min(other.Low);
      this->High = this->High.max(other.High);
    }
    float SquaredDistanceTo(const Box& other) const
    {
      return (this->Low - other.High).max(other.Low - this->High).max(0.0F).square().sum();
    }
  };

  struct Packet;

  TriangleTree Tree;
  TriangleList Triangles;       // in the tree's order
  std::vector<Triangle> Shapes; // in the same order
  Eigen::RowVector3d Center;
  std::vector<Box> Boxes; // per node
};

} // namespace FlipFree

#endif

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
  /// Keeps references to the lists, which must have at least one triangle and be valid
  /// (RequireValidFaces).
  DistanceQuery(const PointList& points, const TriangleList& triangles);

  /// The distance of each point to the surface. Faster if consecutive points are close together.
  Eigen::VectorXd DistancesOf(const PointList& points) const;

  /// The triangles, in an order in which consecutive ones are close together.
  TriangleList SortedTriangles() const;

private:
  // Four coordinates, the last of them 0, for vector instructions without branches.
  struct Box
  {
    Eigen::Array4d Low;
    Eigen::Array4d High;

    void Merge(const Box& other)
    {
      this->Low = this->Low.min(other.Low);
      this->High = this->High.max(other.High);
    }
    double SquaredDistanceTo(const Box& other) const
    {
      return (this->Low - other.High).max(other.Low - this->High).max(0.0).square().sum();
    }
  };

  const PointList& Points;
  const TriangleList& Triangles;
  TriangleTree Tree;
  std::vector<Box> Boxes; // per node
};

} // namespace FlipFree

#endif

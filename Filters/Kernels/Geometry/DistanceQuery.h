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
  const PointList& Points;
  const TriangleList& Triangles;
  TriangleTree Tree;
  std::vector<TriangleBox> Boxes;
};

} // namespace FlipFree

#endif

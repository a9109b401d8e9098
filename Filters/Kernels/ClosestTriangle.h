/**
 * The exact distance from a point to a surface of triangles.
 */
#ifndef FlipFreeClosestTriangle_h
#define FlipFreeClosestTriangle_h

#include "TriangleTree.h"

namespace FlipFree
{

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

struct ClosestTriangle
{
  int Triangle = -1;
  double SquaredDistance = std::numeric_limits<double>::infinity();
};

/// Finds closest triangles by a bounding-volume tree.
class ClosestTriangleFinder
{
public:
  /// The lists must outlive the finder, have at least one triangle, and be valid
  /// (RequireValidFaces).
  ClosestTriangleFinder(const PointList& points, const TriangleList& triangles);

  /// A triangle that is likely to be close (that of a neighbouring query) makes it faster and
  /// changes nothing else, except which one of several triangles at the same distance is found.
  ClosestTriangle Find(const Eigen::Vector3d& point, int likelyTriangle = -1) const;

private:
  double SquaredDistance(const Eigen::Vector3d& point, int triangle) const;

  const PointList& Points;
  const TriangleList& Triangles;
  TriangleTree Tree;
  std::vector<TriangleBox> Boxes;
};

} // namespace FlipFree

#endif

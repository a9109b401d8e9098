/**
 * A bounding-volume tree over the triangles of a surface, for the exact distance from a point to
 * it.
 */
#ifndef FlipFreeClosestTriangle_h
#define FlipFreeClosestTriangle_h

#include "KernelTypes.h"

#include <limits>
#include <vector>

namespace FlipFree
{

class ClosestTriangleTree
{
public:
  /// The lists must outlive the tree, have at least one triangle, and be valid
  /// (RequireValidFaces).
  ClosestTriangleTree(const PointList& points, const TriangleList& triangles);

  struct Closest
  {
    int Triangle = -1;
    double SquaredDistance = std::numeric_limits<double>::infinity();
  };

  /// The triangle closest to the point. A triangle that is likely to be close (that of a
  /// neighbouring query) makes it faster and changes nothing else, except among triangles at the
  /// same distance.
  Closest FindClosest(const Eigen::Vector3d& point, int likelyTriangle = -1) const;

private:
  // Node n's first child is node n + 1.
  struct Node
  {
    Eigen::AlignedBox3d Box;
    int SecondChild = -1; // none: a leaf
    int First = 0;        // a leaf's triangles, in Order
    int Last = 0;
  };

  void Build(int first, int last, const PointList& centroids);
  double SquaredDistance(const Eigen::Vector3d& point, int triangle) const;

  const PointList& Points;
  const TriangleList& Triangles;
  std::vector<int> Order;
  std::vector<Node> Nodes;
};

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

} // namespace FlipFree

#endif

/**
 * The exact distance from a point to a surface of triangles.
 */
#ifndef FlipFreeClosestTriangle_h
#define FlipFreeClosestTriangle_h

#include "KernelTypes.h"

#include <array>
#include <limits>
#include <vector>

namespace FlipFree
{

/// A triangle, with what the distances to many points need of it.
class TriangleForDistance
{
public:
  TriangleForDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  double SquaredDistance(const Eigen::Vector3d& point) const;

private:
  Eigen::Vector3d A;
  Eigen::Vector3d AB;
  Eigen::Vector3d AC;
  Eigen::Vector3d Normal;  ///< of the length of twice the area
  Eigen::Vector3d TowardB; ///< its product with a point minus A: b's weight, times SquaredArea
  Eigen::Vector3d TowardC;
  double SquaredArea;      ///< of the parallelogram; zero for a needle
  double InverseSquaredAB; ///< of its length; zero without a length
  double InverseSquaredAC;
  double InverseSquaredBC;
};

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

struct ClosestTriangle
{
  int Triangle = -1;
  double SquaredDistance = std::numeric_limits<double>::infinity();
};

/// Finds closest triangles by a bounding-volume tree: four boxes to a node, so that the distances
/// to them are worked out at once.
class ClosestTriangleFinder
{
public:
  /// The lists must have at least one triangle, and be valid (RequireValidFaces).
  ClosestTriangleFinder(const PointList& points, const TriangleList& triangles);

  /// A triangle that is likely to be close (that of a neighbouring query) makes it faster and
  /// changes nothing else, except which one of several triangles at the same distance is found.
  ClosestTriangle Find(const Eigen::Vector3d& point, int likelyTriangle = -1) const;

private:
  // The boxes of four triangles or of four nodes below, around the surface's middle.
  struct Node
  {
    std::array<Eigen::Array4f, 3> Low;
    std::array<Eigen::Array4f, 3> High;

    Eigen::Array4f SquaredDistances(const Eigen::Vector3f& point) const
    {
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        const Eigen::Array4f outside =
          (this->Low[axis] - point[axis]).max(point[axis] - this->High[axis]).max(0.0F);
        sum += outside * outside;
      }
      return sum;
    }
  };

  void MakeLeaves(const PointList& points, const TriangleList& triangles);
  void MakeNodesAbove();

  std::vector<TriangleForDistance> Shapes;
  std::vector<int> Order; ///< of the triangles; four that follow each other make a leaf
  Eigen::Vector3d Middle;
  std::vector<Node> Nodes; ///< level by level; node i of one covers nodes 4 i to 4 i + 3 below
  std::vector<int> Levels; ///< where in the list each level begins, from the leaves up
};

} // namespace FlipFree

#endif

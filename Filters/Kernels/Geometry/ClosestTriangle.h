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

/// A few points, coordinate by coordinate, so that the same can be done to all of them at once.
struct PointPacket
{
  static constexpr int Size = 8;
  using Values = std::array<double, Size>;

  Values X;
  Values Y;
  Values Z;

  void Set(int lane, const Eigen::Vector3d& point)
  {
    this->X[lane] = point.x();
    this->Y[lane] = point.y();
    this->Z[lane] = point.z();
  }
  void Copy(int from, int to)
  {
    this->X[to] = this->X[from];
    this->Y[to] = this->Y[from];
    this->Z[to] = this->Z[from];
  }
};

/// A triangle, with what the distances to many points need of it.
class TriangleForDistance
{
public:
  TriangleForDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  double SquaredDistance(const Eigen::Vector3d& point) const;

  /// Lowers each value to the squared distance of its point, where that is less.
  void LowerToSquaredDistances(const PointPacket& points, PointPacket::Values& least) const;

private:
  // The product with a point minus A: b's weight, times SquaredArea. Worked out when needed: two
  // lines of the cache hold the rest.
  Eigen::Vector3d TowardB() const { return this->AC.cross(this->Normal); }
  Eigen::Vector3d TowardC() const { return this->Normal.cross(this->AB); }

  Eigen::Vector3d A;
  Eigen::Vector3d AB;
  Eigen::Vector3d AC;
  Eigen::Vector3d Normal;  ///< of the length of twice the area
  double SquaredArea;      ///< of the parallelogram; zero for a needle
  double InverseSquaredAB; ///< of its length; zero without a length
  double InverseSquaredAC;
  double InverseSquaredBC;
};

double SquaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Finds the distances of points to a surface by a bounding-volume tree: four boxes to a node, so
/// that the distances to them are worked out at once, and one search for several points.
class ClosestTriangleFinder
{
public:
  /// The lists must have at least one triangle, and be valid (RequireValidFaces).
  ClosestTriangleFinder(const PointList& points, const TriangleList& triangles);

  /// The squared distance of each point. The nearer the points lie to each other, the less there is
  /// to search. `hint` is where to begin: that of a search nearby makes it faster and changes
  /// nothing else. Pass 0 at first, then what the last search left there.
  void FindSquaredDistances(const PointPacket& points, int& hint,
    PointPacket::Values& squaredDistances) const;

  /// All triangles, in an order in which those that follow each other lie close together.
  const std::vector<int>& GetOrder() const { return this->Order; }

private:
  // The boxes of four triangles or of four nodes below, around the surface's middle.
  struct Node
  {
    std::array<Eigen::Array4f, 3> Low;
    std::array<Eigen::Array4f, 3> High;

    Eigen::Array4f SquaredDistancesTo(const Eigen::Array3f& low, const Eigen::Array3f& high) const
    {
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        const Eigen::Array4f outside =
          (this->Low[axis] - high[axis]).max(low[axis] - this->High[axis]).max(0.0F);
        sum += outside * outside;
      }
      return sum;
    }
  };

  void MakeLeaves(const PointList& points, const TriangleList& triangles);
  void MakeNodesAbove();

  std::vector<int> Order; ///< of the triangles; four that follow each other make a leaf
  std::vector<TriangleForDistance> Shapes; ///< in this order
  Eigen::Vector3d Middle;
  double Extent;           ///< greatest distance from it along an axis
  std::vector<Node> Nodes; ///< level by level; node i of one covers nodes 4 i to 4 i + 3 below
  std::vector<int> Levels; ///< where in the list each level begins, from the leaves up
};

} // namespace FlipFree

#endif

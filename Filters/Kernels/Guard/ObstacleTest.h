/**
 * Fixed points that a moving surface keeps away from, so that each stays on its side.
 *
 * Claim: a point that lies in none of the hulls of a closed surface's faces at any time of a motion
 * stays on the same side of it, however the faces are cut. Proof: every cut lies in the hulls, so
 * its winding number around the point, which is a whole number and continuous in time while the
 * surface does not pass the point, does not change. A motion within a face's hull leads from one
 * cut of the face to another.
 */
#ifndef FlipFreeObstacleTest_h
#define FlipFreeObstacleTest_h

#include "Guard/MotionTest.h"

#include <limits>

namespace FlipFree
{

/// The vertices from `Begin` to, not including, `End`.
struct VertexRange
{
  int Begin = 0;
  int End = std::numeric_limits<int>::max();

  bool Holds(int vertex) const { return this->Begin <= vertex && vertex < this->End; }
};

/// TimeOfImpact of a hull and a fixed point.
double TimeToObstacle(const Motion& motion, const Hull& hull, const Eigen::Vector3d& obstacle,
  const MinimumDistance& distance);

/// Whether a motion may bring a hull nearer to a fixed point than `gap`, by their boxes.
bool MayComeNear(const Motion& motion, const Hull& hull, const Eigen::Vector3d& obstacle,
  double gap);

/// The hulls whose distance from a point is not proven to be at least `gap`, which is more than 0.
std::vector<Hull> HullsNearerThan(double gap, const PointList& points, const FaceHulls& hulls,
  const Eigen::Vector3d& obstacle);

} // namespace FlipFree

#endif

/**
 * The narrow phase of the guard: how long parts of a surface stay apart, and the corners of its
 * faces unflipped, while its vertices move along straight lines in unit time.
 *
 * Claim: a direction along which two sets of vertices are separated at both ends of an interval of
 * time separates their convex hulls throughout. Proof: along a fixed direction the difference of
 * two moving points is linear in time, so it is positive between two times at which it is. Shared
 * motion cancels. The proof holds for any unit direction, however it was found; a poor one only
 * proves a smaller distance.
 *
 * Rounding: no distance below MinimumDistance::Resolution is ever proven. The caller chooses it
 * more than a hundred times as large as the error of a proven distance, so rounding may reduce a
 * distance slightly but cannot change its sign. That error is below 1e-14 X, X being the greatest
 * absolute coordinate at either end: with u = 2^-53 and gamma_n = n u / (1 - n u), a coordinate
 * between the ends is off by gamma_3 X, and a projection onto a unit vector, whose components sum
 * up to at most sqrt(3), by sqrt(3) (gamma_3 + gamma_3) X; the difference of two projections by
 * twice that and 2 sqrt(3) u X, in all 25 u X. The time reached is off by 6 u, in which the
 * difference changes by at most 6 u 4 sqrt(3) X = 42 u X.
 */
#ifndef FlipFreeMotionTest_h
#define FlipFreeMotionTest_h

#include "Geometry/FaceHulls.h"

namespace FlipFree
{

/// Every vertex moves from its row of `From` to its row of `To`, in unit time.
struct Motion
{
  const PointList& From;
  const PointList& To;

  Eigen::Vector3d At(int vertex, double time) const
  {
    return (1 - time) * this->From.row(vertex) + time * this->To.row(vertex);
  }
  bool IsAtRest(int vertex) const { return this->From.row(vertex) == this->To.row(vertex); }
};

/// A distance is certain if it is more than this part of the greatest coordinate: a hundred times
/// the error that rounding can make, see above.
constexpr double RelativeResolution = 1e-12;

/// The distance to be kept, in millimeters. Parts that are nearer than `Wanted` at the start keep
/// all but a millionth of their distance and what rounding takes, a hundredth of `Resolution` at
/// most; parts that are nearer than `Resolution` may not move at all.
struct MinimumDistance
{
  double Wanted = 0;
  double Resolution = 0;
};

/// Conservative time of impact of two hulls without a common vertex: they are proven to keep their
/// minimum distance until then. 1 if there is no impact, also for hulls at rest. Negative if they
/// are not proven to be apart at the start. The search may end at `maximumTime` or later with the
/// time that it has reached.
double TimeOfImpact(const Motion& motion, const Hull& one, const Hull& two,
  const MinimumDistance& distance, double maximumTime = 1);

/// The time at which the normal of the corner before-vertex-after has turned by 90 degrees; 1 if it
/// never does, if the corner is at rest, or if it is degenerate: twice its area is at most 1e-12 of
/// the square of its longest edge at either end.
double TimeOfFlip(const Motion& motion, const std::array<int, 3>& corner);

} // namespace FlipFree

#endif

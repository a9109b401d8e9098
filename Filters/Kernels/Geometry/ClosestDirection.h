/**
 * The vector between the closest points of two convex hulls.
 */
#ifndef FlipFreeClosestDirection_h
#define FlipFreeClosestDirection_h

#include <Eigen/Dense>

#include <array>

namespace FlipFree
{

/// Up to four points. If there are fewer, the last one is repeated.
using HullCorners = std::array<Eigen::Vector3d, 4>;

/// From the closest point of the second hull to that of the first. Where they intersect, or are
/// degenerate, it is some short vector between them.
Eigen::Vector3d ClosestDirection(const HullCorners& one, const HullCorners& two);

/// By how much the first hull lies above the second one along a unit direction; a lower bound of
/// their distance.
double DistanceAlong(const Eigen::Vector3d& direction, const HullCorners& one,
  const HullCorners& two);

/// A lower bound of the distance of two hulls, tight but for rounding: how far they are apart along
/// the closest direction. Not positive where they intersect.
double ProvenDistance(const HullCorners& one, const HullCorners& two);

} // namespace FlipFree

#endif

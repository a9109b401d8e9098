/**
 * The vector between the closest points of two simplices. Where they intersect, or are degenerate,
 * it is some short vector between them.
 */
#ifndef FlipFreeClosestDirection_h
#define FlipFreeClosestDirection_h

#include <Eigen/Dense>

#include <array>

namespace FlipFree
{

/// From the closest point of the triangle to the point.
Eigen::Vector3d ClosestDirection(const std::array<Eigen::Vector3d, 1>& point,
  const std::array<Eigen::Vector3d, 3>& triangle);

/// From the second segment to the first.
Eigen::Vector3d ClosestDirection(const std::array<Eigen::Vector3d, 2>& one,
  const std::array<Eigen::Vector3d, 2>& two);

/// From the second triangle to the first.
Eigen::Vector3d ClosestDirection(const std::array<Eigen::Vector3d, 3>& one,
  const std::array<Eigen::Vector3d, 3>& two);

} // namespace FlipFree

#endif

/**
 * The check that a point which a user has given lies in the image.
 */
#ifndef FlipFreePointCheck_h
#define FlipFreePointCheck_h

#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

/// Throws Error, naming the point by `what`, such as "the seed (1, 2, 3) mm", and the image by
/// `name`, unless the point has finite coordinates in a voxel of the image. Says so if it would lie
/// inside with x and y negated, as it does where RAS coordinates were taken for LPS.
void RequirePoint(const ImageGeometry& geometry, const Eigen::Vector3d& point,
  const std::string& what, const std::string& name);

} // namespace FlipFree

#endif

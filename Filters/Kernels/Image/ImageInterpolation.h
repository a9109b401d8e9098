/**
 * Trilinear interpolation of voxels; beyond the border, the nearest voxel counts.
 */
#ifndef FlipFreeImageInterpolation_h
#define FlipFreeImageInterpolation_h

#include "KernelTypes.h"

#include <algorithm>

namespace FlipFree
{

/// `read` maps the values of four voxels at once to those that are interpolated.
template <typename Read>
double InterpolateClamped(const ImageView<float>& image, const Eigen::Vector3d& index,
  const Read& read)
{
  const auto& dimensions = image.Geometry.Dimensions;
  int low[3];
  int high[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double x = std::max(0.0, std::min(index[axis], dimensions[axis] - 1.0));
    low[axis] = std::min(static_cast<int>(x), std::max(0, dimensions[axis] - 2));
    high[axis] = std::min(low[axis] + 1, dimensions[axis] - 1);
    part[axis] = x - low[axis];
  }
  // The four edges of the cell along x.
  Eigen::Array4d from;
  Eigen::Array4d to;
  for (int edge = 0; edge < 4; ++edge)
  {
    const int j = edge % 2 == 0 ? low[1] : high[1];
    const int k = edge / 2 == 0 ? low[2] : high[2];
    from[edge] = image(low[0], j, k);
    to[edge] = image(high[0], j, k);
  }
  from = read(from);
  to = read(to);
  const Eigen::Array4d along = from + part[0] * (to - from);
  const double a = along[0] + part[1] * (along[1] - along[0]);
  const double b = along[2] + part[1] * (along[3] - along[2]);
  return a + part[2] * (b - a);
}

inline double InterpolateClamped(const ImageView<float>& image, const Eigen::Vector3d& index)
{
  return InterpolateClamped(image, index, [](const Eigen::Array4d& values) { return values; });
}

} // namespace FlipFree

#endif

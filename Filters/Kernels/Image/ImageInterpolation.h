/**
 * Trilinear interpolation of voxels; beyond the border, the nearest voxel counts.
 */
#ifndef FlipFreeImageInterpolation_h
#define FlipFreeImageInterpolation_h

#include "KernelTypes.h"

#include <algorithm>

namespace FlipFree
{

/// `read` maps a voxel's value to the one that is interpolated.
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
  const auto along = [&](int j, int k)
  {
    const double a = read(image(low[0], j, k));
    return a + part[0] * (read(image(high[0], j, k)) - a);
  };
  const auto across = [&](int k)
  {
    const double a = along(low[1], k);
    return a + part[1] * (along(high[1], k) - a);
  };
  const double a = across(low[2]);
  return a + part[2] * (across(high[2]) - a);
}

inline double InterpolateClamped(const ImageView<float>& image, const Eigen::Vector3d& index)
{
  return InterpolateClamped(image, index, [](float value) { return static_cast<double>(value); });
}

} // namespace FlipFree

#endif

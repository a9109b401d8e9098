#include "Image/BallInside.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{

SeedSphere BallInside(const BitMask& mask, const SeedSphere& seed)
{
  const ImageGeometry& whole = mask.GetGeometry();
  // With a layer of voxels around, where the image has one.
  const VoxelBox box = mask.Bounds().Widened({ { 1, 1, 1 } }, WholeBox(whole));
  BitMask outside = mask.Cropped(box);
  outside.Complement();
  const ImageGeometry& geometry = outside.GetGeometry();
  const Eigen::Vector3d center = geometry.ToIndex(seed.Center);
  double least = std::numeric_limits<double>::infinity();
  outside.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const double i = std::max<double>(begin, std::min(center[0], end - 1.0));
      const Eigen::Vector3d away = Eigen::Vector3d(i, j, k) - center;
      least = std::min(least, away.cwiseProduct(geometry.Spacing).squaredNorm());
    });
  return { seed.Center,
    std::isfinite(least) ? std::max(seed.Radius, std::sqrt(least)) : seed.Radius };
}

} // namespace FlipFree

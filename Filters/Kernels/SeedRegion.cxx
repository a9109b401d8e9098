#include "SeedRegion.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

Extent ReachableExtent(const ImageGeometry& geometry, const Eigen::Vector3d& center, double reach)
{
  const Eigen::Vector3d index = geometry.ToIndex(center);
  Extent extent{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double margin = reach / geometry.Spacing[axis];
    const double last = geometry.Dimensions[axis] - 1.0;
    extent[2 * axis] =
      static_cast<int>(std::max(0.0, std::min(last, std::floor(index[axis] - margin))));
    extent[2 * axis + 1] =
      static_cast<int>(std::max(0.0, std::min(last, std::ceil(index[axis] + margin))));
  }
  return extent;
}

ImageGeometry CropGeometry(const ImageGeometry& geometry, const Extent& extent)
{
  ImageGeometry result = geometry;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.Dimensions[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
  result.Origin = geometry.ToPhysical(Eigen::Vector3d(extent[0], extent[2], extent[4]));
  return result;
}

std::vector<std::size_t> VoxelsInSphere(const ImageGeometry& geometry, const SeedSphere& seed)
{
  std::vector<std::size_t> voxels;
  const Extent box = ReachableExtent(geometry, seed.Center, seed.Radius);
  for (int k = box[4]; k <= box[5]; ++k)
  {
    for (int j = box[2]; j <= box[3]; ++j)
    {
      for (int i = box[0]; i <= box[1]; ++i)
      {
        if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - seed.Center).norm() <= seed.Radius)
        {
          voxels.push_back(geometry.Offset(i, j, k));
        }
      }
    }
  }
  return voxels;
}

double NoiseDeviation(const ImageView<float>& image, const SeedSphere& seed)
{
  const std::vector<std::size_t> voxels = VoxelsInSphere(image.Geometry, seed);
  const auto& size = image.Geometry.Dimensions;
  const double finest = image.Geometry.Spacing.minCoeff();
  std::vector<float> differences;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t last = size[axis] - 1;
    for (std::size_t voxel : voxels)
    {
      const std::size_t next = voxel + stride;
      if (image.Geometry.Spacing[axis] <= 1.01 * finest && voxel / stride % size[axis] != last &&
        std::binary_search(voxels.begin(), voxels.end(), next))
      {
        differences.push_back(std::abs(image.Data[next] - image.Data[voxel]));
      }
    }
    stride *= size[axis];
  }
  if (differences.empty())
  {
    return 0;
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return 1.4826 * *middle / std::sqrt(2.0);
}

} // namespace FlipFree

#include "Image/SeedRegion.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

Extent ReachableExtent(const ImageGeometry& geometry, const Eigen::Vector3d& center, double reach)
{
  const Eigen::Vector3d index = geometry.ToIndex(center);
  const Eigen::Vector3d margin = geometry.IndexReach(reach);
  Extent extent{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = geometry.Dimensions[axis] - 1.0;
    extent[2 * axis] =
      static_cast<int>(std::max(0.0, std::min(last, std::floor(index[axis] - margin[axis]))));
    extent[2 * axis + 1] =
      static_cast<int>(std::max(0.0, std::min(last, std::ceil(index[axis] + margin[axis]))));
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

ImageGeometry CropGeometry(const ImageGeometry& geometry, const VoxelBox& box)
{
  return CropGeometry(geometry,
    Extent{ { box.Begin[0], box.End[0] - 1, box.Begin[1], box.End[1] - 1, box.Begin[2],
      box.End[2] - 1 } });
}

bool ContainsSphere(const ImageGeometry& geometry, const SeedSphere& seed)
{
  const Eigen::Vector3d index = geometry.ToIndex(seed.Center);
  const Eigen::Vector3d margin = geometry.IndexReach(seed.Radius);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] - margin[axis] < -0.5 ||
      index[axis] + margin[axis] > geometry.Dimensions[axis] - 0.5)
    {
      return false;
    }
  }
  return true;
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

namespace
{

// The median absolute difference of neighbors along an axis, both among the voxels; negative
// without any.
double MedianDifference(const ImageView<float>& image, const std::vector<std::size_t>& voxels,
  int axis)
{
  const auto& size = image.Geometry.Dimensions;
  const std::size_t stride = image.Geometry.Offset(axis == 0, axis == 1, axis == 2);
  const std::size_t last = size[axis] - 1;
  std::vector<float> differences;
  for (std::size_t voxel : voxels)
  {
    const std::size_t next = voxel + stride;
    if (voxel / stride % size[axis] != last &&
      std::binary_search(voxels.begin(), voxels.end(), next))
    {
      differences.push_back(std::abs(image.Data[next] - image.Data[voxel]));
    }
  }
  if (differences.empty())
  {
    return -1;
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

} // namespace

double NoiseStandardDeviation(const ImageView<float>& image, const SeedSphere& seed)
{
  const std::vector<std::size_t> voxels = VoxelsInSphere(image.Geometry, seed);
  const double finest = image.Geometry.Spacing.minCoeff();
  double least = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (image.Geometry.Spacing[axis] <= 1.01 * finest)
    {
      const double median = MedianDifference(image, voxels, axis);
      least = least < 0 || (median >= 0 && median < least) ? median : least;
    }
  }
  return 1.4826 * std::max(0.0, least) / std::sqrt(2.0);
}

} // namespace FlipFree

#include "Image/SeedRegion.h"

#include "Error.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace FlipFree
{

void RequireSeed(const ImageGeometry& geometry, const SeedSphere& seed, const std::string& name)
{
  const Eigen::Vector3d index = geometry.ToIndex(seed.Center);
  const auto& size = geometry.Dimensions;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(index[axis] >= -0.5 && index[axis] <= size[axis] - 0.5))
    {
      throw Error(ErrorCode::OutOfRange,
        "the seed's center " + TextOf(seed.Center) + " mm lies outside " + name +
          ", which reaches from " + TextOf(geometry.ToPhysical(Eigen::Vector3d::Zero())) + " to " +
          TextOf(geometry.ToPhysical(Eigen::Vector3d(size[0] - 1, size[1] - 1, size[2] - 1))) +
          " mm; give it in the image's physical coordinates");
    }
  }
  if (!(seed.Radius >= geometry.Spacing.minCoeff()))
  {
    std::ostringstream message;
    message << "the seed's radius of " << seed.Radius << " mm is below a voxel of " << name << " ("
            << geometry.Spacing.minCoeff() << " mm); enlarge it";
    throw Error(ErrorCode::OutOfRange, message.str());
  }
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
  const VoxelBox box = BoxAround(geometry, seed.Center, seed.Radius);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
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
  // Not zero even for an empty grid.
  const std::size_t stride =
    std::max<std::size_t>(1, image.Geometry.Offset(axis == 0, axis == 1, axis == 2));
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

std::vector<std::size_t> VoxelsAround(const ImageGeometry& geometry, const SeedSphere& seed)
{
  std::vector<std::size_t> voxels = VoxelsInSphere(geometry, seed);
  if (voxels.empty())
  {
    const VoxelBox box = BoxAround(geometry, seed.Center, 0);
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (int k = box.Begin[2]; k < box.End[2]; ++k)
    {
      for (int j = box.Begin[1]; j < box.End[1]; ++j)
      {
        for (int i = box.Begin[0]; i < box.End[0]; ++i)
        {
          const double distance =
            (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - seed.Center).norm();
          if (distance < least)
          {
            least = distance;
            nearest = geometry.Offset(i, j, k);
          }
        }
      }
    }
    voxels.push_back(nearest);
  }
  return voxels;
}

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

#include "Image/SeedRegion.h"

#include "Error.h"
#include "Image/PointCheck.h"
#include "MessageText.h"
#include "Quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{

void RequireSeed(const ImageGeometry& geometry, const SeedSphere& seed, const std::string& name)
{
  RequirePoint(geometry, seed.Center, "the seed's center " + TextOf(seed.Center) + " mm", name);
  if (!(seed.Radius >= geometry.Spacing.minCoeff()))
  {
    throw Error(ErrorCode::OutOfRange,
      "the seed's radius of " + TextOf(seed.Radius) + " mm is below a voxel of " + name + " (" +
        TextOf(geometry.Spacing.minCoeff()) + " mm); raise {SeedRadius}");
  }
  const auto& voxels = geometry.Dimensions;
  const double longest =
    geometry.Spacing.cwiseProduct(Eigen::Vector3d(voxels[0], voxels[1], voxels[2])).maxCoeff();
  if (!(2 * seed.Radius <= longest))
  {
    throw Error(ErrorCode::OutOfRange,
      "the seed sphere, with a radius of " + TextOf(seed.Radius) + " mm, is larger than " + name +
        ", which is at most " + TextOf(longest) +
        " mm long; lower {SeedRadius} so that the sphere lies within the organ");
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
      const float difference = std::abs(image.Data[next] - image.Data[voxel]);
      if (std::isfinite(difference))
      {
        differences.push_back(difference);
      }
    }
  }
  if (differences.empty())
  {
    return -1;
  }
  return TakeMedian(differences);
}

std::vector<float> ValuesOf(const ImageView<float>& image, const std::vector<std::size_t>& voxels)
{
  std::vector<float> values;
  values.reserve(voxels.size());
  for (const std::size_t voxel : voxels)
  {
    values.push_back(image.Data[voxel]);
  }
  return values;
}

// Between the tenth and the ninetieth percentile. Changes the order of the values.
double ScatterOf(std::vector<float>& values)
{
  const std::size_t tenth = values.size() / 10;
  const float high = TakePlace(values, values.size() - 1 - tenth);
  return high - TakePlace(values, tenth);
}

// The smallest between two gray values: 1 of integers. Zero where all are the same.
double StepOf(std::vector<float> sorted)
{
  std::sort(sorted.begin(), sorted.end());
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t at = 1; at < sorted.size(); ++at)
  {
    if (sorted[at] > sorted[at - 1])
    {
      least = std::min(least, sorted[at] - sorted[at - 1]);
    }
  }
  return std::isfinite(least) ? least : 0;
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

double ScatterOverInnerHalf(const ImageView<float>& image, const SeedSphere& seed)
{
  constexpr std::size_t enough = 100; // of fewer voxels, scatter is chance
  constexpr double steps = 2;         // less is a matter of rounding
  const std::vector<std::size_t> voxels =
    VoxelsInSphere(image.Geometry, { seed.Center, 0.5 * seed.Radius });
  if (voxels.size() < enough)
  {
    return 0;
  }
  std::vector<float> inner = ValuesOf(image, voxels);
  std::vector<float> all = ValuesOf(image, VoxelsInSphere(image.Geometry, seed));
  const double ofInner = std::max(ScatterOf(inner), steps * StepOf(inner));
  const double ofSphere = ScatterOf(all);
  if (ofInner > 0)
  {
    return ofSphere / ofInner;
  }
  return ofSphere > 0 ? std::numeric_limits<double>::infinity() : 1;
}

// The limit and the step hardly matter from 1.4 to 1.7 and from 0.7 to 0.8. Of spheres of 0.7 of
// the radius of the largest that fits, none of 59 in CT has more than the limit, and 7 of 55 in MR,
// which change the Dice score by 0.000 in the mean. Of spheres of 1.4 times that radius, of which
// about a fifth lies outside, 33 of 36 and 47 of 55 do, and gain 0.12 and 0.10.
SeedSphere UniformSphere(const ImageView<float>& image, const SeedSphere& seed)
{
  constexpr double limit = 1.5;
  constexpr double step = 0.8;
  SeedSphere sphere = seed;
  while (ScatterOverInnerHalf(image, sphere) > limit)
  {
    sphere.Radius *= step;
  }
  return sphere;
}

} // namespace FlipFree

#include "Vessel/VesselImage.h"

#include "Image/BitMask.h"
#include "Image/GaussianSmoothing.h"
#include "Image/ImageInterpolation.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// The nearest axes at right angles.
Eigen::Matrix3d Orthonormalized(const Eigen::Matrix3d& direction)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> decomposition(direction,
    Eigen::ComputeFullU | Eigen::ComputeFullV);
  return decomposition.matrixU() * decomposition.matrixV().transpose();
}

// The grid of cubes that covers another one.
ImageGeometry CubesOver(const ImageGeometry& geometry, double edge)
{
  ImageGeometry cubes;
  cubes.Spacing.setConstant(edge);
  cubes.Direction = Orthonormalized(geometry.Direction);
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d index((corner & 1) * (geometry.Dimensions[0] - 1.0),
      (corner >> 1 & 1) * (geometry.Dimensions[1] - 1.0),
      (corner >> 2) * (geometry.Dimensions[2] - 1.0));
    const Eigen::Array3d place = (cubes.Direction.transpose() * geometry.ToPhysical(index)).array();
    low = low.min(place);
    high = high.max(place);
  }
  cubes.Origin = cubes.Direction * low.matrix();
  for (int axis = 0; axis < 3; ++axis)
  {
    cubes.Dimensions[axis] =
      static_cast<int>(std::floor((high[axis] - low[axis]) / edge + 1e-6)) + 1;
  }
  return cubes;
}

// From both sides; a line without data stays so.
void ContinueLine(float* first, int size, std::ptrdiff_t step)
{
  int last = -1; // with data
  for (int place = 0; place < size; ++place)
  {
    if (!HasData(first[place * step]))
    {
      continue;
    }
    for (int gap = last + 1; gap < place; ++gap)
    {
      const bool isNearerToLast = last >= 0 && gap - last <= place - gap;
      first[gap * step] = first[(isNearerToLast ? last : place) * step];
    }
    last = place;
  }
  for (int gap = last + 1; gap < size && last >= 0; ++gap)
  {
    first[gap * step] = first[last * step];
  }
}

} // namespace

void SmoothInside(FloatImage& image, double deviation, const ParallelFor& parallelFor)
{
  SmoothGaussian(image.Voxels, image.Geometry, deviation, parallelFor);
  // The part of the window within the image: that along each axis, times that along the others.
  std::array<std::vector<float>, 3> inside;
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double far = 1e9; // no neighbors along other axes
    ImageGeometry line;
    line.Dimensions = { { image.Geometry.Dimensions[axis], 1, 1 } };
    line.Spacing = { image.Geometry.Spacing[axis], far, far };
    inside[axis].assign(line.Dimensions[0], 1.0F);
    SmoothGaussian(inside[axis], line, deviation, SerialFor);
  }
  parallelFor(0, image.Geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < image.Geometry.Dimensions[1]; ++j)
        {
          const float across = inside[1][j] * inside[2][k];
          float* const row = image.Voxels.data() + image.Geometry.Offset(0, j, k);
          for (int i = 0; i < image.Geometry.Dimensions[0]; ++i)
          {
            row[i] /= across * inside[0][i];
          }
        }
      }
    });
}

void ContinueData(FloatImage& image)
{
  const auto& size = image.Geometry.Dimensions;
  const std::array<std::ptrdiff_t, 3> steps = StepsOf(image.Geometry);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int second = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    for (int k = 0; k < size[third]; ++k)
    {
      for (int j = 0; j < size[second]; ++j)
      {
        ContinueLine(image.Voxels.data() + j * steps[second] + k * steps[third], size[axis],
          steps[axis]);
      }
    }
  }
}

VesselImage MakeVesselImage(FloatImage voxels, double deviation, double edge,
  const ParallelFor& parallelFor)
{
  BitMask withoutData = VoxelsWhere(
    voxels.View(), [](float value) { return !HasData(value); }, parallelFor);
  const bool isComplete = withoutData.Bounds().IsEmpty();
  if (!isComplete)
  {
    ContinueData(voxels);
  }
  SmoothInside(voxels, deviation, parallelFor);
  VesselImage image;
  image.Cubes.Geometry = CubesOver(voxels.Geometry, edge);
  const ImageGeometry& cubes = image.Cubes.Geometry;
  image.Cubes.Voxels.resize(cubes.NumberOfVoxels());
  const Eigen::Vector3d origin = voxels.Geometry.ToIndex(cubes.Origin);
  Eigen::Matrix3d steps;
  for (int axis = 0; axis < 3; ++axis)
  {
    steps.col(axis) =
      voxels.Geometry.ToIndex(cubes.ToPhysical(Eigen::Vector3d::Unit(axis))) - origin;
  }
  parallelFor(0, cubes.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < cubes.Dimensions[1]; ++j)
        {
          float* const row = image.Cubes.Voxels.data() + cubes.Offset(0, j, k);
          for (int i = 0; i < cubes.Dimensions[0]; ++i)
          {
            row[i] = static_cast<float>(
              InterpolateClamped(voxels.View(), origin + steps * Eigen::Vector3d(i, j, k)));
          }
        }
      }
    });
  for (std::size_t cube = 0; cube < image.Cubes.Voxels.size() && !isComplete; ++cube)
  {
    const auto [i, j, k] = NearestVoxel(voxels.Geometry, CenterOf(cube, cubes));
    if (withoutData(i, j, k))
    {
      image.WithoutData.push_back(cube);
    }
  }
  image.Own = std::move(voxels);
  return image;
}

} // namespace FlipFree

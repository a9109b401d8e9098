#include "Evidence/SurfaceDepth.h"

#include "Image/DistanceTransform.h"
#include "Mesh/SurfaceVoxelization.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr double MostVoxels = 128; // of a side

// With a layer of voxels around the surface.
ImageGeometry GridAround(const PointList& points, double step)
{
  const Eigen::Vector3d low = points.colwise().minCoeff();
  const Eigen::Vector3d size = points.colwise().maxCoeff().transpose() - low;
  ImageGeometry grid;
  grid.Spacing.setConstant(std::max(step, size.maxCoeff() / MostVoxels));
  grid.Origin = low - grid.Spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Dimensions[axis] = static_cast<int>(size[axis] / grid.Spacing[axis]) + 4;
  }
  return grid;
}

} // namespace

SurfaceDepths FindDepths(const PointList& points, const TriangleList& triangles,
  const Eigen::Vector3d& point, double step, const ParallelFor& parallelFor)
{
  const ImageGeometry grid = GridAround(points, step);
  std::vector<unsigned char> inside(grid.NumberOfVoxels(), 0);
  FillRuns<unsigned char>(VoxelizeSurface(points, triangles, grid, parallelFor), 1, grid,
    inside.data());
  const std::vector<float> squared = SquaredDistance(inside, grid, 0, parallelFor, NeverStop);
  // The surface runs between the last voxel inside and the first one outside.
  const auto depthOf = [&](float square)
  { return std::max(0.0, std::sqrt(double(square)) - 0.5 * grid.Spacing[0]); };
  SurfaceDepths depths;
  depths.Greatest = depthOf(*std::max_element(squared.begin(), squared.end()));
  const Eigen::Vector3d index = grid.ToIndex(point);
  const int i = static_cast<int>(std::lround(index[0]));
  const int j = static_cast<int>(std::lround(index[1]));
  const int k = static_cast<int>(std::lround(index[2]));
  if (grid.Contains(i, j, k))
  {
    depths.OfPoint = depthOf(squared[grid.Offset(i, j, k)]);
  }
  return depths;
}

} // namespace FlipFree

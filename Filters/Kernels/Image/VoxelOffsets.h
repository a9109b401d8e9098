/**
 * The number of a voxel on its grid, x fastest: back to its index, and on to its neighbors.
 */
#ifndef FlipFreeVoxelOffsets_h
#define FlipFreeVoxelOffsets_h

#include "KernelTypes.h"

#include <algorithm>

namespace FlipFree
{

/// i, j, k of the voxel with that offset.
inline std::array<int, 3> IndexOf(std::size_t voxel, const ImageGeometry& geometry)
{
  const std::size_t row = geometry.Dimensions[0];
  const std::size_t rows = geometry.Dimensions[1];
  return { { static_cast<int>(voxel % row), static_cast<int>(voxel / row % rows),
    static_cast<int>(voxel / row / rows) } };
}

/// Where the voxel's center is.
inline Eigen::Vector3d CenterOf(std::size_t voxel, const ImageGeometry& geometry)
{
  const std::array<int, 3> index = IndexOf(voxel, geometry);
  return geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
}

/// How far the next voxel is along each axis.
inline std::array<std::ptrdiff_t, 3> StepsOf(const ImageGeometry& geometry)
{
  const std::ptrdiff_t row = geometry.Dimensions[0];
  return { { 1, row, row * geometry.Dimensions[1] } };
}

/// Calls visit(offset) for the voxels on the grid that share a face with one: toward -x, +x, -y,
/// +y, -z, +z.
template <typename Visit>
void VisitNeighbors(std::size_t voxel, const ImageGeometry& geometry, const Visit& visit)
{
  const std::array<int, 3> index = IndexOf(voxel, geometry);
  const std::array<std::ptrdiff_t, 3> steps = StepsOf(geometry);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] > 0)
    {
      visit(voxel - steps[axis]);
    }
    if (index[axis] + 1 < geometry.Dimensions[axis])
    {
      visit(voxel + steps[axis]);
    }
  }
}

/// Calls visit(offset) for a voxel and those on the grid that share a face, an edge or a corner
/// with it, in ascending order.
template <typename Visit>
void VisitSurroundings(const std::array<int, 3>& index, const ImageGeometry& geometry,
  const Visit& visit)
{
  const std::array<int, 3>& size = geometry.Dimensions;
  for (int k = std::max(0, index[2] - 1); k <= std::min(size[2] - 1, index[2] + 1); ++k)
  {
    for (int j = std::max(0, index[1] - 1); j <= std::min(size[1] - 1, index[1] + 1); ++j)
    {
      for (int i = std::max(0, index[0] - 1); i <= std::min(size[0] - 1, index[0] + 1); ++i)
      {
        visit(geometry.Offset(i, j, k));
      }
    }
  }
}

} // namespace FlipFree

#endif

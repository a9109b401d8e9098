/**
 * Other grids on the lattice of one, cropped or wider, with axes in another order or direction, and
 * their voxels, each by where it lies.
 */
#ifndef GridParts_h
#define GridParts_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <array>
#include <vector>

namespace FlipFree
{

/// The box of the lattice, each axis along the given one of it, those of negative steps backwards.
inline ImageGeometry PartOf(const ImageGeometry& lattice, const VoxelBox& box,
  const std::array<int, 3>& axes, const std::array<int, 3>& steps)
{
  ImageGeometry part;
  Eigen::Vector3d first;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int along = axes[axis];
    part.Dimensions[axis] = box.Size(along);
    part.Spacing[axis] = lattice.Spacing[along];
    part.Direction.col(axis) = steps[axis] * lattice.Direction.col(along);
    first[along] = steps[axis] > 0 ? box.Begin[along] : box.End[along] - 1;
  }
  part.Origin = lattice.ToPhysical(first);
  return part;
}

/// The voxel of a grid that lies at voxel (i, j, k) of another.
inline Eigen::Vector3i CounterpartIn(const ImageGeometry& grid, const ImageGeometry& other, int i,
  int j, int k)
{
  return grid.ToIndex(other.ToPhysical(Eigen::Vector3d(i, j, k))).array().round().cast<int>();
}

/// The voxels of a grid in the places of a part of it; 0 beyond the grid.
template <typename T>
std::vector<T> VoxelsIn(const ImageGeometry& part, const std::vector<T>& voxels,
  const ImageGeometry& grid)
{
  std::vector<T> values;
  for (int k = 0; k < part.Dimensions[2]; ++k)
  {
    for (int j = 0; j < part.Dimensions[1]; ++j)
    {
      for (int i = 0; i < part.Dimensions[0]; ++i)
      {
        const Eigen::Vector3i at = CounterpartIn(grid, part, i, j, k);
        values.push_back(
          grid.Contains(at[0], at[1], at[2]) ? voxels[grid.Offset(at[0], at[1], at[2])] : T(0));
      }
    }
  }
  return values;
}

} // namespace FlipFree

#endif

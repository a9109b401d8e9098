/**
 * Where a voxel grid lies on the lattice of another one: cropped or wider, begun at the other end
 * of an axis, or with its axes in another order. Networks crop, and programs store the axes of one
 * image differently; the voxels are then the same, and none has to be resampled.
 */
#ifndef FlipFreeLatticePlacement_h
#define FlipFreeLatticePlacement_h

#include "Image/BitMask.h"
#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <array>
#include <string>

namespace FlipFree
{

struct LatticePlacement
{
  std::array<int, 3> Axes{ { 0, 1, 2 } };  ///< of the lattice, along which each axis runs
  std::array<int, 3> Steps{ { 1, 1, 1 } }; ///< of each axis: 1 the same way, -1 the other way
  std::array<int, 3> First{ { 0, 0, 0 } }; ///< where voxel (0, 0, 0) lies, perhaps below zero

  /// Where a voxel lies on the lattice.
  std::array<int, 3> IndexOf(int i, int j, int k) const
  {
    std::array<int, 3> index = this->First;
    index[this->Axes[0]] += this->Steps[0] * i;
    index[this->Axes[1]] += this->Steps[1] * j;
    index[this->Axes[2]] += this->Steps[2] * k;
    return index;
  }
  /// Where a box of voxels lies on the lattice.
  VoxelBox BoxOf(const VoxelBox& box) const;
};

/// Throws Error, saying how the two named so differ, unless they overlap and there each voxel of
/// `part` lies, up to a tenth of the least spacing, on one of `lattice`: files round differently.
LatticePlacement PlacementOn(const ImageGeometry& lattice, const ImageGeometry& part,
  const std::string& nameOfLattice, const std::string& nameOfPart);

/// Whether two grids have their voxels at the same places, in whichever order, up to a tenth of the
/// least spacing of `one`.
bool HaveSamePlaces(const ImageGeometry& one, const ImageGeometry& other);

/// The voxels of a set that lie in a box of the lattice, on the grid of that box. The box may reach
/// beyond the lattice's own grid.
BitMask PlacedIn(const VoxelBox& box, const ImageGeometry& lattice,
  const LatticePlacement& placement, const BitMask& part);

} // namespace FlipFree

#endif

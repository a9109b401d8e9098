/**
 * A mask of a part of an image, such as of something small in something large.
 */
#ifndef FlipFreeMaskPart_h
#define FlipFreeMaskPart_h

#include "Image/BitMask.h"
#include "Image/VoxelBox.h"

#include <array>

namespace FlipFree
{

struct MaskPart
{
  VoxelBox Box;   ///< in the grid of the image
  BitMask Voxels; ///< in the box; without a grid, none

  /// Whether it holds a voxel of the image.
  bool Holds(const std::array<int, 3>& voxel) const
  {
    const std::array<int, 3>& first = this->Box.Begin;
    const std::array<int, 3> in{ { voxel[0] - first[0], voxel[1] - first[1],
      voxel[2] - first[2] } };
    return this->Voxels.HasGrid() && this->Voxels.GetGeometry().Contains(in[0], in[1], in[2]) &&
      this->Voxels(in[0], in[1], in[2]);
  }
};

} // namespace FlipFree

#endif

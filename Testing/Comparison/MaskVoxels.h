/**
 * Masks and offsets of voxels, one from the other.
 */
#ifndef FlipFreeMaskVoxels_h
#define FlipFreeMaskVoxels_h

#include "Image/BitMask.h"
#include "Image/VoxelOffsets.h"

#include <array>
#include <cstddef>
#include <vector>

namespace FlipFree
{

inline void InsertVoxel(BitMask& mask, std::size_t offset)
{
  const std::array<int, 3> index = IndexOf(offset, mask.GetGeometry());
  mask.Insert(index[0], index[1], index[2]);
}

inline BitMask MaskOf(const std::vector<std::size_t>& offsets, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  for (const std::size_t offset : offsets)
  {
    InsertVoxel(mask, offset);
  }
  return mask;
}

inline std::vector<std::size_t> OffsetsOf(const BitMask& mask)
{
  std::vector<std::size_t> offsets;
  mask.ForEach([&offsets](std::size_t voxel) { offsets.push_back(voxel); });
  return offsets;
}

} // namespace FlipFree

#endif

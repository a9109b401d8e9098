/**
 * Private to the module: masks and offsets of voxels, one from the other.
 */
#ifndef FlipFreeMaskVoxels_h
#define FlipFreeMaskVoxels_h

#include "Image/BitMask.h"

#include <cstddef>
#include <vector>

namespace FlipFree
{

inline void InsertVoxel(BitMask& mask, std::size_t offset)
{
  const std::size_t row = mask.GetGeometry().Dimensions[0];
  const std::size_t rows = mask.GetGeometry().Dimensions[1];
  mask.Insert(static_cast<int>(offset % row), static_cast<int>(offset / row % rows),
    static_cast<int>(offset / row / rows));
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

/**
 * Where the labels of a label map lie.
 */
#ifndef FlipFreeLabelBoxes_h
#define FlipFreeLabelBoxes_h

#include "Image/VoxelBox.h"

#include <cmath>
#include <cstdint>
#include <map>

namespace FlipFree
{

using LabelBoxes = std::map<std::int64_t, VoxelBox>;

/// The least box that holds all voxels of a label, for each that is not 0. Returns false for an
/// image that is not a label map: with more than `most` labels, or with a voxel that is not a
/// whole number between -2e9 and 2e9.
template <typename T>
bool FindLabelBoxes(const ImageView<T>& labels, std::size_t most, LabelBoxes& boxes)
{
  const auto& size = labels.Geometry.Dimensions;
  const T* row = labels.Data;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j, row += size[0])
    {
      for (int begin = 0, end = 0; begin < size[0]; begin = end)
      {
        const T label = row[begin];
        do
        {
          ++end;
        } while (end < size[0] && row[end] == label);
        if (label == T(0))
        {
          continue;
        }
        const auto value = static_cast<double>(label);
        if (!(std::abs(value) < 2e9) || value != std::floor(value))
        {
          return false;
        }
        VoxelBox& box = boxes[static_cast<std::int64_t>(value)];
        box = box.Joined({ { { begin, j, k } }, { { end, j + 1, k + 1 } } });
        if (boxes.size() > most)
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace FlipFree

#endif

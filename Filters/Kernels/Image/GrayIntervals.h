/**
 * A set of gray values that is made of intervals, so that whether a voxel's is one of them is found
 * by comparisons, many voxels at a time, instead of being looked up. There is one comparison for
 * every border: of many intervals, beyond some ten, it is right all the same, but slower than
 * looking up.
 */
#ifndef FlipFreeGrayIntervals_h
#define FlipFreeGrayIntervals_h

#include "Image/BitMask.h"

#include <functional>

namespace FlipFree
{

class GrayIntervals
{
public:
  /// Whether the lowest values, and those that are not numbers, are in the set; and where, as
  /// values rise, this changes: `borders`, ascending, each of which counts to what is above it. Two
  /// that are equal change nothing.
  GrayIntervals(bool lowest, std::vector<float> borders);

  /// The values z for which `isIn[place(z)]`, where `place` does not fall as z rises, and is 0 for
  /// what is not a number: the very same floats, whatever rounding `place` does.
  static GrayIntervals WherePlaceIs(const std::vector<bool>& isIn,
    const std::function<std::size_t(float)>& place);

  bool operator()(float z) const
  {
    bool isIn = this->Lowest;
    for (const float border : this->Borders)
    {
      isIn = isIn != (z >= border);
    }
    return isIn;
  }

  const std::vector<float>& GetBorders() const { return this->Borders; }

  /// Inserts those of a row's first voxels whose values are in the set.
  void MarkRow(const float* voxels, int size, BitMask::Word* row) const;

private:
  bool Lowest;
  std::vector<float> Borders;
};

/// The voxels of a part of an image, a box of it, whose values are in the set.
BitMask VoxelsIn(const GrayIntervals& values, const ImageView<float>& image, const VoxelBox& box,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * A part of a mask with a margin of empty rows around it: every row of the part has neighbors as
 * far as a structuring element reaches, at offsets that depend on the size alone.
 */
#ifndef FlipFreePaddedMask_h
#define FlipFreePaddedMask_h

#include "Image/BitMask.h"

namespace FlipFree
{

class PaddedMask
{
public:
  using Word = BitMask::Word;

  /// Copies what lies within `reach` of the box; with `complement`, the voxels that are not in the
  /// mask.
  PaddedMask(const BitMask& mask, bool complement, const VoxelBox& box,
    const std::array<int, 3>& reach, const ParallelFor& parallelFor);

  /// The mask's word with which rows begin here, and how many words they have.
  int GetBeginWord() const { return this->BeginWord; }
  std::ptrdiff_t GetWordsPerRow() const { return this->WordsPerRow; }

  /// A row of the box or its margin, by its place in the mask.
  Word* Row(std::ptrdiff_t j, std::ptrdiff_t k)
  {
    return this->Words.data() + this->Offset(j - this->BeginJ, k - this->BeginK);
  }
  /// From a row to another one.
  std::ptrdiff_t Offset(std::ptrdiff_t j, std::ptrdiff_t k) const
  {
    return this->WordsPerRow * (j + this->RowsPerSlice * k);
  }

  /// Dilates every row by some voxels to both sides. Bits beyond the mask's ends do no harm: they
  /// could only grow back to where their row is set already.
  void DilateRows(int voxels, const ParallelFor& parallelFor);

private:
  void DilateRow(Word* row, int voxels) const;

  int BeginWord;
  std::ptrdiff_t WordsPerRow = 0;
  int BeginJ;
  std::ptrdiff_t RowsPerSlice;
  int BeginK;
  std::vector<Word> Words;
};

} // namespace FlipFree

#endif

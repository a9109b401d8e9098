#include "Image/PaddedMask.h"

#include <algorithm>

namespace FlipFree
{

PaddedMask::PaddedMask(const BitMask& mask, bool complement, const VoxelBox& box,
  const std::array<int, 3>& reach, const ParallelFor& parallelFor)
  : BeginWord(std::max(0, box.Begin[0] - reach[0]) / BitMask::BitsOfWord)
  , BeginJ(box.Begin[1] - reach[1])
  , RowsPerSlice(box.Size(1) + 2 * reach[1])
  , BeginK(box.Begin[2] - reach[2])
{
  const VoxelBox inside = box.Widened(reach, WholeBox(mask.GetGeometry()));
  const int lastWord = (inside.End[0] - 1) / BitMask::BitsOfWord;
  this->WordsPerRow = lastWord + 1 - this->BeginWord;
  this->Words.resize(this->Offset(0, box.Size(2) + 2 * reach[2]), 0);
  const Word last = lastWord + 1 == mask.GetWordsPerRow() ? mask.GetLastWord() : ~Word(0);
  parallelFor(inside.Begin[2], inside.End[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t k = first; k < end; ++k)
      {
        for (int j = inside.Begin[1]; j < inside.End[1]; ++j)
        {
          Word* const row = this->Row(j, k);
          const Word* const from = mask.Row(j, k) + this->BeginWord;
          for (std::ptrdiff_t word = 0; word < this->WordsPerRow; ++word)
          {
            row[word] = complement ? ~from[word] : from[word];
          }
          row[this->WordsPerRow - 1] &= last;
        }
      }
    });
}

void PaddedMask::DilateRows(int voxels, const ParallelFor& parallelFor)
{
  const std::ptrdiff_t rows = static_cast<std::ptrdiff_t>(this->Words.size()) / this->WordsPerRow;
  parallelFor(0, rows,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t row = first; row < last; ++row)
      {
        this->DilateRow(this->Words.data() + row * this->WordsPerRow, voxels);
      }
    });
}

// By doubling, less than a word at a time.
void PaddedMask::DilateRow(Word* row, int voxels) const
{
  for (int done = 0; done < voxels;)
  {
    const int step = std::min({ voxels - done, done + 1, BitMask::BitsOfWord - 1 });
    const int rest = BitMask::BitsOfWord - step;
    Word before = 0;
    Word bits = row[0];
    for (std::ptrdiff_t word = 0; word < this->WordsPerRow; ++word)
    {
      const Word behind = word + 1 < this->WordsPerRow ? row[word + 1] : 0;
      row[word] = bits | bits << step | before >> rest | bits >> step | behind << rest;
      before = bits;
      bits = behind;
    }
    done += step;
  }
}

} // namespace FlipFree

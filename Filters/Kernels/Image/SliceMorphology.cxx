#include "Image/SliceMorphology.h"

namespace FlipFree
{
namespace
{

using Word = BitMask::Word;

// The words of a mask moved by up to a voxel along each axis; zeros come in from the sides.
class MovedMask
{
public:
  explicit MovedMask(const BitMask& mask)
    : Mask(mask)
  {
  }

  Word operator()(int word, int j, int k, const std::array<int, 3>& offset) const
  {
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const int y = j + offset[1];
    const int z = k + offset[2];
    if (y < 0 || y >= size[1] || z < 0 || z >= size[2])
    {
      return 0;
    }
    const Word* const row = this->Mask.Row(y, z);
    constexpr int last = BitMask::BitsOfWord - 1;
    if (offset[0] > 0)
    {
      const Word next = word + 1 < this->Mask.GetWordsPerRow() ? row[word + 1] : 0;
      return row[word] >> 1 | next << last;
    }
    if (offset[0] < 0)
    {
      const Word before = word > 0 ? row[word - 1] : 0;
      return row[word] << 1 | before >> last;
    }
    return row[word];
  }

private:
  const BitMask& Mask;
};

} // namespace

int AxisAcrossSlices(const ImageGeometry& geometry)
{
  int axis = 2;
  for (int other = 1; other >= 0; --other)
  {
    if (geometry.Spacing[other] > 1.01 * geometry.Spacing[axis])
    {
      axis = other;
    }
  }
  return axis;
}

void AddNeighborsAlong(int axis, const BitMask& mask, BitMask& sum)
{
  const MovedMask moved(mask);
  const auto& size = mask.GetGeometry().Dimensions;
  std::array<int, 3> offset{};
  for (const int way : { -1, 1 })
  {
    offset[axis] = way;
    for (int k = 0; k < size[2]; ++k)
    {
      for (int j = 0; j < size[1]; ++j)
      {
        Word* const row = sum.Row(j, k);
        for (int word = 0; word < mask.GetWordsPerRow(); ++word)
        {
          row[word] |= moved(word, j, k, offset);
        }
      }
    }
  }
  sum.ClearPadding();
}

void MedianInSlices(BitMask& mask, const ParallelFor& parallelFor)
{
  const BitMask copy = mask;
  const MovedMask moved(copy);
  const int across = AxisAcrossSlices(mask.GetGeometry());
  const int a = across == 0 ? 1 : 0;
  const int b = across == 2 ? 1 : 2;
  const auto& size = mask.GetGeometry().Dimensions;
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          Word* const row = mask.Row(j, k);
          for (int word = 0; word < mask.GetWordsPerRow(); ++word)
          {
            // Counts of each bit, in four binary digits.
            std::array<Word, 4> digits{};
            for (int way = 0; way < 9; ++way)
            {
              std::array<int, 3> offset{};
              offset[a] = way % 3 - 1;
              offset[b] = way / 3 - 1;
              Word carry = moved(word, j, k, offset);
              for (Word& digit : digits)
              {
                const Word next = digit & carry;
                digit ^= carry;
                carry = next;
              }
            }
            // Of the nine pixels around, five are the majority.
            row[word] = digits[3] | (digits[2] & (digits[1] | digits[0]));
          }
        }
      }
    });
  mask.ClearPadding();
}

} // namespace FlipFree

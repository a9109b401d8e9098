/**
 * A set of voxels, one bit for each: an eighth of the memory and of the time that bytes would take,
 * where whole images of them are grown and merged.
 */
#ifndef FlipFreeBitMask_h
#define FlipFreeBitMask_h

#include "Image/VoxelBox.h"
#include "KernelTypes.h"

#include <bitset>
#include <vector>

namespace FlipFree
{

class BitMask
{
public:
  using Word = std::uint64_t;
  static constexpr int BitsOfWord = 64;
  /// How many of a word's bits are set.
  static std::size_t CountBits(Word word) { return std::bitset<BitsOfWord>(word).count(); }

  BitMask() = default;
  /// No voxel is in the set.
  explicit BitMask(const ImageGeometry& geometry);

  const ImageGeometry& GetGeometry() const { return this->Geometry; }

  bool operator()(int i, int j, int k) const
  {
    return (this->Row(j, k)[i / BitsOfWord] >> (i % BitsOfWord) & 1U) != 0;
  }
  void Insert(int i, int j, int k)
  {
    this->Row(j, k)[i / BitsOfWord] |= Word(1) << (i % BitsOfWord);
  }
  /// Inserts the voxels (i, j, k) with begin <= i < end.
  void InsertRun(int begin, int end, int j, int k);

  /// A row of voxels along x begins with a new word; the bits after its end are zero.
  std::ptrdiff_t GetWordsPerRow() const { return this->WordsPerRow; }
  Word* Row(std::ptrdiff_t j, std::ptrdiff_t k)
  {
    return this->Words.data() + (k * this->Geometry.Dimensions[1] + j) * this->WordsPerRow;
  }
  const Word* Row(std::ptrdiff_t j, std::ptrdiff_t k) const
  {
    return this->Words.data() + (k * this->Geometry.Dimensions[1] + j) * this->WordsPerRow;
  }
  /// All rows, one after the other.
  std::vector<Word>& GetWords() { return this->Words; }
  const std::vector<Word>& GetWords() const { return this->Words; }
  /// The bits of a row's last word that are voxels.
  Word GetLastWord() const { return this->LastWord; }

  void Complement();
  /// Sets the bits after the ends of the rows to zero.
  void CutRows();
  /// Takes out all voxels of another set, which must be on the same grid.
  void Remove(const BitMask& other);

  std::size_t Count() const;

  /// The least box that holds all voxels of the set; empty if there are none.
  VoxelBox Bounds() const;

  /// Calls visit(offset) for every voxel of the set, in the order of the voxels.
  template <typename Visit>
  void ForEach(const Visit& visit) const
  {
    const std::size_t size = this->Geometry.Dimensions[0];
    for (std::size_t row = 0; row * this->WordsPerRow < this->Words.size(); ++row)
    {
      for (std::ptrdiff_t word = 0; word < this->WordsPerRow; ++word)
      {
        Word bits = this->Words[row * this->WordsPerRow + word];
        for (std::size_t offset = row * size + word * BitsOfWord; bits != 0; ++offset, bits >>= 1U)
        {
          if ((bits & 1U) != 0)
          {
            visit(offset);
          }
        }
      }
    }
  }

  /// Calls visit(begin, end, j, k) for runs of voxels (i, j, k) of the set, begin <= i < end, in
  /// slices first <= k < last, in the order of the voxels. What goes on in the next word of a row
  /// is a run of its own.
  template <typename Visit>
  void ForEachRun(std::ptrdiff_t first, std::ptrdiff_t last, const Visit& visit) const
  {
    for (auto k = static_cast<int>(first); k < last; ++k)
    {
      for (int j = 0; j < this->Geometry.Dimensions[1]; ++j)
      {
        const Word* const row = this->Row(j, k);
        for (int word = 0; word < this->WordsPerRow; ++word)
        {
          Word bits = row[word];
          for (int i = word * BitsOfWord; bits != 0;)
          {
            const int zeros = TrailingZeros(bits);
            i += zeros;
            bits >>= zeros;
            const int ones = ~bits == 0 ? BitsOfWord : TrailingZeros(~bits);
            visit(i, i + ones, j, k);
            i += ones;
            bits = ones == BitsOfWord ? 0 : bits >> ones;
          }
        }
      }
    }
  }

  /// The same voxels of grids of the same size.
  friend bool operator==(const BitMask& a, const BitMask& b)
  {
    return a.Geometry.Dimensions == b.Geometry.Dimensions && a.Words == b.Words;
  }
  friend bool operator!=(const BitMask& a, const BitMask& b) { return !(a == b); }

private:
  // Of a word that is not zero.
  static int TrailingZeros(Word bits)
  {
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    return static_cast<int>(CountBits((bits & (0 - bits)) - 1));
#endif
  }

  ImageGeometry Geometry;
  std::ptrdiff_t WordsPerRow = 0;
  Word LastWord = 0;
  std::vector<Word> Words;
};

/// What is to become a word's bits, the first voxel's first: 0 or 1 each.
using MaskBytes = std::array<unsigned char, BitMask::BitsOfWord>;

/// Eight bytes at a time: a product moves the lowest bit of each to the top.
inline BitMask::Word WordOf(const MaskBytes& bytes)
{
  BitMask::Word word = 0;
  for (int first = 0; first < BitMask::BitsOfWord; first += 8)
  {
    BitMask::Word part = 0;
    for (int byte = 0; byte < 8; ++byte)
    {
      part |= BitMask::Word(bytes[first + byte]) << (8 * byte);
    }
    word |= part * 0x0102040810204080U >> 56U << first;
  }
  return word;
}

/// The voxels of an image for whose value `holds` is true.
template <typename T, typename Predicate>
BitMask VoxelsWhere(const ImageView<T>& image, const Predicate& holds,
  const ParallelFor& parallelFor)
{
  BitMask mask(image.Geometry);
  const auto& size = image.Geometry.Dimensions;
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      MaskBytes bytes;
      for (std::ptrdiff_t k = first; k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          const T* voxels = image.Data + image.Geometry.Offset(0, j, static_cast<int>(k));
          BitMask::Word* row = mask.Row(j, k);
          int rest = size[0];
          for (; rest >= BitMask::BitsOfWord; rest -= BitMask::BitsOfWord)
          {
            // A loop of constant length, for the sake of vectors.
            for (int bit = 0; bit < BitMask::BitsOfWord; ++bit)
            {
              bytes[bit] = holds(voxels[bit]) ? 1 : 0;
            }
            *row++ = WordOf(bytes);
            voxels += BitMask::BitsOfWord;
          }
          if (rest > 0)
          {
            bytes.fill(0);
            for (int bit = 0; bit < rest; ++bit)
            {
              bytes[bit] = holds(voxels[bit]) ? 1 : 0;
            }
            *row = WordOf(bytes);
          }
        }
      }
    });
  return mask;
}

} // namespace FlipFree

#endif

/**
 * A set of voxels, one bit each: an eighth of the memory and of the time of bytes where whole
 * images are dilated and merged.
 */
#ifndef FlipFreeBitMask_h
#define FlipFreeBitMask_h

#include "Image/VoxelBox.h"
#include "Image/VoxelOffsets.h"
#include "KernelTypes.h"

#include <algorithm>
#include <array>
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
  /// Takes the words of a set on a grid of the same size.
  BitMask(const ImageGeometry& geometry, std::vector<Word> words);

  const ImageGeometry& GetGeometry() const { return this->Geometry; }
  /// Not one without voxels, such as that of the default constructor.
  bool HasGrid() const { return !this->Words.empty(); }

  bool operator()(int i, int j, int k) const
  {
    return (this->Row(j, k)[i / BitsOfWord] >> (i % BitsOfWord) & 1U) != 0;
  }
  /// Of a voxel by its offset (VoxelOffsets.h).
  bool operator()(std::size_t voxel) const
  {
    const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
    return (*this)(index[0], index[1], index[2]);
  }
  void Insert(int i, int j, int k)
  {
    this->Row(j, k)[i / BitsOfWord] |= Word(1) << (i % BitsOfWord);
  }
  /// Inserts a voxel by its offset.
  void Insert(std::size_t voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
    this->Insert(index[0], index[1], index[2]);
  }
  /// Inserts the voxels (i, j, k) with begin <= i < end.
  void InsertRun(int begin, int end, int j, int k);
  /// Inserts runs such as those of SurfaceVoxelization.h; the mask begins at the voxel `first` of
  /// their grid.
  template <typename Runs>
  void InsertRuns(const Runs& runs, const std::array<int, 3>& first = { { 0, 0, 0 } })
  {
    for (const auto& run : runs)
    {
      this->InsertRun(run.Begin - first[0], run.End - first[0], run.J - first[1], run.K - first[2]);
    }
  }
  /// Removes the voxels (i, j, k) with begin <= i < end.
  void RemoveRun(int begin, int end, int j, int k);
  void SetRun(bool inside, int begin, int end, int j, int k)
  {
    inside ? this->InsertRun(begin, end, j, k) : this->RemoveRun(begin, end, j, k);
  }

  /// Each row of voxels along x begins with a new word; the bits after its end are zero.
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
  /// Clears the padding bits, those after the ends of the rows.
  void ClearPadding();
  /// Removes all voxels of another set, which must be on the same grid.
  void Remove(const BitMask& other);
  /// Keeps only the voxels of another set, which must be on the same grid.
  void Intersect(const BitMask& other);
  /// Inserts all voxels of another set, which must be on the same grid.
  void Unite(const BitMask& other);
  /// Inserts all voxels of a set on the grid of the part that begins at the voxel `first`.
  void Insert(const BitMask& part, const std::array<int, 3>& first);

  /// The voxels in a box, on the grid of that part; without a grid, none.
  BitMask Cropped(const VoxelBox& box) const;

  std::size_t Count() const;
  /// How many of the voxels (i, j, k) with begin <= i < end are in the set.
  std::size_t CountRun(int begin, int end, int j, int k) const;

  /// The smallest box that holds all voxels of the set; empty if there are none.
  VoxelBox Bounds() const;

  /// Calls visit(begin, end, j, k) for runs of voxels (i, j, k) of the set, begin <= i < end, in
  /// the slices first <= k < last, in the order of the voxels. Runs end with the words of a row.
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

  /// Calls visit(offset) for every voxel of the set, in the order of the voxels.
  template <typename Visit>
  void ForEach(const Visit& visit) const
  {
    this->ForEachRun(0, this->Geometry.Dimensions[2],
      [&](int begin, int end, int j, int k)
      {
        const std::size_t row = this->Geometry.Offset(0, j, k);
        for (int i = begin; i < end; ++i)
        {
          visit(row + i);
        }
      });
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

/// Which voxels of a word are in a set: 0 or 1 each.
using MaskBytes = std::array<unsigned char, BitMask::BitsOfWord>;

/// Eight bytes at a time: a product moves the lowest bit of each into the highest byte.
inline BitMask::Word WordOf(const MaskBytes& bytes)
{
  BitMask::Word word = 0;
  for (int first = 0; first < BitMask::BitsOfWord; first += 8)
  {
    BitMask::Word eight = 0;
    for (int byte = 0; byte < 8; ++byte)
    {
      eight |= BitMask::Word(bytes[first + byte]) << (8 * byte);
    }
    word |= eight * 0x0102040810204080U >> 56U << first;
  }
  return word;
}

/// A mask of the image's part in a box. `mark(voxels, count, inside)` says for some voxels of a
/// row, at most a word's, which of them are in the set.
template <typename T, typename Mark>
BitMask MaskOfBox(const ImageView<T>& image, const VoxelBox& box, const Mark& mark,
  const ParallelFor& parallelFor)
{
  BitMask mask(CropGeometry(image.Geometry, box));
  parallelFor(0, box.Size(2),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      MaskBytes inside;
      for (auto k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < box.Size(1); ++j)
        {
          const T* voxels = &image(box.Begin[0], box.Begin[1] + j, box.Begin[2] + k);
          BitMask::Word* word = mask.Row(j, k);
          int rest = box.Size(0);
          // A constant count, so that the compiler vectorizes.
          for (; rest >= BitMask::BitsOfWord; rest -= BitMask::BitsOfWord)
          {
            mark(voxels, BitMask::BitsOfWord, inside.data());
            *word++ = WordOf(inside);
            voxels += BitMask::BitsOfWord;
          }
          if (rest > 0)
          {
            inside.fill(0);
            mark(voxels, rest, inside.data());
            *word = WordOf(inside);
          }
        }
      }
    });
  return mask;
}

/// The voxels whose values satisfy `holds`.
template <typename T, typename Predicate>
BitMask VoxelsWhere(const ImageView<T>& image, const Predicate& holds,
  const ParallelFor& parallelFor)
{
  return MaskOfBox(
    image, WholeBox(image.Geometry),
    [&holds](const T* voxels, int count, unsigned char* inside)
    {
      for (int voxel = 0; voxel < count; ++voxel)
      {
        inside[voxel] = holds(voxels[voxel]) ? 1 : 0;
      }
    },
    parallelFor);
}

/// The voxels that are in one of two sets on the same grid, but not in both.
BitMask DifferenceOf(const BitMask& one, const BitMask& other);

} // namespace FlipFree

#endif

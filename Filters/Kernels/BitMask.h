/**
 * A set of voxels, one bit for each: an eighth of the memory and of the time that bytes would take,
 * where whole images of them are grown and merged.
 */
#ifndef FlipFreeBitMask_h
#define FlipFreeBitMask_h

#include "KernelTypes.h"
#include "VoxelBox.h"

#include <vector>

namespace FlipFree
{

class BitMask
{
public:
  using Word = std::uint64_t;
  static constexpr int BitsOfWord = 64;

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

  /// The same voxels of grids of the same size.
  friend bool operator==(const BitMask& a, const BitMask& b)
  {
    return a.Geometry.Dimensions == b.Geometry.Dimensions && a.Words == b.Words;
  }
  friend bool operator!=(const BitMask& a, const BitMask& b) { return !(a == b); }

private:
  ImageGeometry Geometry;
  std::ptrdiff_t WordsPerRow = 0;
  Word LastWord = 0;
  std::vector<Word> Words;
};

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
      for (std::ptrdiff_t k = first; k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          const T* const voxels = image.Data + image.Geometry.Offset(0, j, static_cast<int>(k));
          BitMask::Word* const row = mask.Row(j, k);
          for (int i = 0; i < size[0]; ++i)
          {
            row[i / BitMask::BitsOfWord] |= BitMask::Word(holds(voxels[i]) ? 1 : 0)
              << (i % BitMask::BitsOfWord);
          }
        }
      }
    });
  return mask;
}

} // namespace FlipFree

#endif

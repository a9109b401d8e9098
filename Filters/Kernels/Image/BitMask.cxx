#include "Image/BitMask.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace FlipFree
{
namespace
{

// Calls visit(word, bits) for the words of a row that hold voxels begin <= i < end.
template <typename Visit>
void VisitWords(int begin, int end, const Visit& visit)
{
  if (begin >= end)
  {
    return;
  }
  const int first = begin / BitMask::BitsOfWord;
  const int last = (end - 1) / BitMask::BitsOfWord;
  const BitMask::Word fromBegin = ~BitMask::Word(0) << (begin % BitMask::BitsOfWord);
  const BitMask::Word toEnd =
    ~BitMask::Word(0) >> (BitMask::BitsOfWord - 1 - (end - 1) % BitMask::BitsOfWord);
  for (int word = first; word <= last; ++word)
  {
    visit(word,
      (word == first ? fromBegin : ~BitMask::Word(0)) & (word == last ? toEnd : ~BitMask::Word(0)));
  }
}

} // namespace

BitMask::BitMask(const ImageGeometry& geometry, std::vector<Word> words)
  : Geometry(geometry)
  , WordsPerRow((static_cast<std::ptrdiff_t>(geometry.Dimensions[0]) + BitsOfWord - 1) / BitsOfWord)
  , LastWord(~Word(0) >> ((BitsOfWord - geometry.Dimensions[0] % BitsOfWord) % BitsOfWord))
  , Words(std::move(words))
{
}

BitMask::BitMask(const ImageGeometry& geometry)
  : BitMask(geometry, {})
{
  this->Words.resize(this->WordsPerRow * geometry.Dimensions[1] * geometry.Dimensions[2], 0);
}

void BitMask::InsertRun(int begin, int end, int j, int k)
{
  VisitWords(begin, end, [row = this->Row(j, k)](int word, Word bits) { row[word] |= bits; });
}

void BitMask::RemoveRun(int begin, int end, int j, int k)
{
  VisitWords(begin, end, [row = this->Row(j, k)](int word, Word bits) { row[word] &= ~bits; });
}

void BitMask::Complement()
{
  for (Word& word : this->Words)
  {
    word = ~word;
  }
  this->ClearPadding();
}

void BitMask::ClearPadding()
{
  for (std::size_t row = 0; row < this->Words.size(); row += this->WordsPerRow)
  {
    this->Words[row + this->WordsPerRow - 1] &= this->LastWord;
  }
}

void BitMask::Remove(const BitMask& other)
{
  for (std::size_t word = 0; word < this->Words.size(); ++word)
  {
    this->Words[word] &= ~other.Words[word];
  }
}

void BitMask::Intersect(const BitMask& other)
{
  std::transform(this->Words.begin(), this->Words.end(), other.Words.begin(), this->Words.begin(),
    std::bit_and<>());
}

void BitMask::Unite(const BitMask& other)
{
  std::transform(this->Words.begin(), this->Words.end(), other.Words.begin(), this->Words.begin(),
    std::bit_or<>());
}

void BitMask::Insert(const BitMask& part, const std::array<int, 3>& first)
{
  part.ForEachRun(0, part.Geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    { this->InsertRun(first[0] + begin, first[0] + end, first[1] + j, first[2] + k); });
}

BitMask BitMask::Cropped(const VoxelBox& box) const
{
  if (!this->HasGrid())
  {
    return {};
  }
  BitMask part(CropGeometry(this->Geometry, box));
  this->ForEachRun(box.Begin[2], box.End[2],
    [&](int begin, int end, int j, int k)
    {
      const int left = std::max(begin, box.Begin[0]);
      const int right = std::min(end, box.End[0]);
      if (left < right && j >= box.Begin[1] && j < box.End[1])
      {
        part.InsertRun(left - box.Begin[0], right - box.Begin[0], j - box.Begin[1],
          k - box.Begin[2]);
      }
    });
  return part;
}

std::size_t BitMask::Count() const
{
  std::size_t count = 0;
  for (Word word : this->Words)
  {
    count += CountBits(word);
  }
  return count;
}

std::size_t BitMask::CountRun(int begin, int end, int j, int k) const
{
  std::size_t count = 0;
  VisitWords(begin, end,
    [&count, row = this->Row(j, k)](int word, Word bits) { count += CountBits(row[word] & bits); });
  return count;
}

VoxelBox BitMask::Bounds() const
{
  const std::array<int, 3>& size = this->Geometry.Dimensions;
  VoxelBox box{ size, { { 0, 0, 0 } } };
  std::vector<Word> along(this->WordsPerRow, 0); // all rows, one upon the other
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const Word* const row = this->Row(j, k);
      Word any = 0;
      for (std::ptrdiff_t word = 0; word < this->WordsPerRow; ++word)
      {
        any |= row[word];
        along[word] |= row[word];
      }
      if (any != 0)
      {
        box.Begin = { { size[0], std::min(box.Begin[1], j), std::min(box.Begin[2], k) } };
        box.End = { { 0, std::max(box.End[1], j + 1), k + 1 } };
      }
    }
  }
  for (int i = 0; i < size[0]; ++i)
  {
    if ((along[i / BitsOfWord] >> (i % BitsOfWord) & 1U) != 0)
    {
      box.Begin[0] = std::min(box.Begin[0], i);
      box.End[0] = i + 1;
    }
  }
  return box;
}

BitMask DifferenceOf(const BitMask& one, const BitMask& other)
{
  BitMask difference = one;
  std::vector<BitMask::Word>& words = difference.GetWords();
  std::transform(words.begin(), words.end(), other.GetWords().begin(), words.begin(),
    std::bit_xor<>());
  return difference;
}

} // namespace FlipFree

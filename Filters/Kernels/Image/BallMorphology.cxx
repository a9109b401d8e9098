#include "Image/BallMorphology.h"

#include "Image/DistanceTransform.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace FlipFree
{
namespace
{

// A ball of more rows is left to the distance transform, whose time does not depend on the radius,
// and is about that of so many rows.
constexpr double MaximumRows = 1000;
// A voxel whose center is on the ball's surface belongs to it, whatever the rounding.
constexpr double Slack = 1 + 1e-6;

// One row of voxels of the ball: its place relative to the center's row.
struct BallRow
{
  int J = 0;
  int K = 0;
};

// The rows by their half width in voxels. Empty if there are too many.
std::map<int, std::vector<BallRow>> RowsOfBall(double radius, const ImageGeometry& geometry)
{
  const Eigen::Vector3d& spacing = geometry.Spacing;
  const double maximumWidth = geometry.Dimensions[0]; // more would not matter
  std::map<int, std::vector<BallRow>> rows;
  const double square = radius * radius * Slack;
  const double slices = 2 * std::floor(std::sqrt(square) / spacing[2]) + 1;
  if (slices > MaximumRows)
  {
    return rows;
  }
  double count = 0;
  const int depth = static_cast<int>(slices) / 2;
  for (int k = -depth; k <= depth; ++k)
  {
    const double slice = square - k * k * spacing[2] * spacing[2];
    const double halfHeight = std::floor(std::sqrt(std::max(0.0, slice)) / spacing[1]);
    count += 2 * halfHeight + 1;
    if (count > MaximumRows)
    {
      return {};
    }
    const int height = static_cast<int>(halfHeight);
    for (int j = -height; j <= height; ++j)
    {
      const double width = slice - j * j * spacing[1] * spacing[1];
      const double halfWidth = std::sqrt(std::max(0.0, width)) / spacing[0];
      // What reaches from one end of the grid beyond the other would find nothing.
      if (std::abs(j) < geometry.Dimensions[1] && std::abs(k) < geometry.Dimensions[2])
      {
        rows[static_cast<int>(std::min(halfWidth, maximumWidth))].push_back({ j, k });
      }
    }
  }
  return rows;
}

using Word = BitMask::Word;

// Rows of words that are read as one vector, where there are enough.
constexpr std::ptrdiff_t Block = 4;

// The rows of a part of a mask, and empty ones around them, so that a row has neighbors as far as
// the ball reaches, and they are where the mask's size alone says.
class Surroundings
{
public:
  // Of what can reach into the box.
  Surroundings(const BitMask& mask, bool holes, const VoxelBox& box,
    const std::map<int, std::vector<BallRow>>& ball, const ParallelFor& parallelFor)
    : BeginJ(box.Begin[1])
    , BeginK(box.Begin[2])
    , EndK(box.End[2])
  {
    const auto& size = mask.GetGeometry().Dimensions;
    for (const auto& rows : ball)
    {
      for (const BallRow& row : rows.second)
      {
        this->BeginJ = std::min(this->BeginJ, box.Begin[1] + row.J);
        this->BeginK = std::min(this->BeginK, box.Begin[2] + row.K);
        this->EndK = std::max(this->EndK, box.End[2] + row.K);
      }
    }
    const int width = ball.rbegin()->first;
    this->BeginWord = std::max(0, box.Begin[0] - width) / BitMask::BitsOfWord;
    const int lastWord = (std::min(size[0], box.End[0] + width) - 1) / BitMask::BitsOfWord;
    this->WordsOfRow = lastWord + 1 - this->BeginWord;
    this->RowsOfSlice = box.End[1] + (box.Begin[1] - this->BeginJ) - this->BeginJ;
    this->Words.resize(this->WordsOfRow * this->RowsOfSlice * (this->EndK - this->BeginK), 0);
    const Word last = lastWord + 1 == mask.GetWordsPerRow() ? mask.GetLastWord() : ~Word(0);
    parallelFor(std::max(0, this->BeginK), std::min(size[2], this->EndK),
      [&](std::ptrdiff_t first, std::ptrdiff_t end)
      {
        const std::ptrdiff_t endJ =
          std::min<std::ptrdiff_t>(size[1], this->BeginJ + this->RowsOfSlice);
        for (std::ptrdiff_t k = first; k < end; ++k)
        {
          for (std::ptrdiff_t j = std::max(0, this->BeginJ); j < endJ; ++j)
          {
            Word* const row = this->Row(j, k);
            const Word* const from = mask.Row(j, k) + this->BeginWord;
            for (std::ptrdiff_t word = 0; word < this->WordsOfRow; ++word)
            {
              row[word] = holes ? ~from[word] : from[word];
            }
            row[this->WordsOfRow - 1] &= last;
          }
        }
      });
  }

  int GetBeginWord() const { return this->BeginWord; }
  std::ptrdiff_t GetWordsOfRow() const { return this->WordsOfRow; }

  Word* Row(std::ptrdiff_t j, std::ptrdiff_t k)
  {
    return this->Words.data() +
      this->Offset({ static_cast<int>(j - this->BeginJ), static_cast<int>(k - this->BeginK) });
  }
  // From a row to another.
  std::ptrdiff_t Offset(const BallRow& row) const
  {
    return this->WordsOfRow * (row.J + this->RowsOfSlice * row.K);
  }

  // Grows every row by some voxels to both sides. What grows beyond the mask does no harm: it would
  // come back to where its row has been already.
  void Grow(int width, const ParallelFor& parallelFor)
  {
    const std::ptrdiff_t rows = static_cast<std::ptrdiff_t>(this->Words.size()) / this->WordsOfRow;
    parallelFor(0, rows,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t row = first; row < last; ++row)
        {
          this->GrowRow(this->Words.data() + row * this->WordsOfRow, width);
        }
      });
  }

private:
  // By doubling, less than a word at a time.
  void GrowRow(Word* row, int width) const
  {
    for (int done = 0; done < width;)
    {
      const int step = std::min({ width - done, done + 1, BitMask::BitsOfWord - 1 });
      const int rest = BitMask::BitsOfWord - step;
      Word before = 0;
      Word bits = row[0];
      for (std::ptrdiff_t word = 0; word < this->WordsOfRow; ++word)
      {
        const Word behind = word + 1 < this->WordsOfRow ? row[word + 1] : 0;
        row[word] = bits | bits << step | before >> rest | bits >> step | behind << rest;
        before = bits;
        bits = behind;
      }
      done += step;
    }
  }

  int BeginWord = 0;
  std::ptrdiff_t WordsOfRow = 0;
  int BeginJ;
  std::ptrdiff_t RowsOfSlice = 0;
  int BeginK;
  int EndK;
  std::vector<Word> Words;
};

// Adds words of several rows, of a number that the compiler knows.
template <std::ptrdiff_t size>
void MergeWords(const Word* center, const std::vector<std::ptrdiff_t>& rows, Word* to)
{
  std::array<Word, size> sum;
  std::copy_n(to, size, sum.begin());
  for (const std::ptrdiff_t row : rows)
  {
    const Word* const from = center + row;
    for (std::ptrdiff_t word = 0; word < size; ++word)
    {
      sum[word] |= from[word];
    }
  }
  std::copy_n(sum.begin(), size, to);
}

void MergeRows(const Word* center, const std::vector<std::ptrdiff_t>& rows, std::ptrdiff_t size,
  Word* to)
{
  std::ptrdiff_t word = 0;
  for (; word + Block <= size; word += Block)
  {
    MergeWords<Block>(center + word, rows, to + word);
  }
  for (; word < size; ++word)
  {
    MergeWords<1>(center + word, rows, to + word);
  }
}

// All within the ball of the mask, or of its holes, as far as it lies in the box. False if the
// monitor stopped it.
bool GrowByRows(const BitMask& mask, bool holes, const VoxelBox& box,
  const std::map<int, std::vector<BallRow>>& ball, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& grown)
{
  const double passes = 2.0 * static_cast<double>(ball.size());
  double pass = 0;
  if (!monitor(pass++ / passes))
  {
    return false;
  }
  Surroundings source(mask, holes, box, ball, parallelFor);
  grown = BitMask(mask.GetGeometry());
  int grownBy = 0;
  for (const auto& [width, rows] : ball)
  {
    if (pass > 1 && !monitor(pass++ / passes))
    {
      return false;
    }
    source.Grow(width - grownBy, parallelFor);
    grownBy = width;
    if (!monitor(pass++ / passes))
    {
      return false;
    }
    std::vector<std::ptrdiff_t> offsets;
    std::transform(rows.begin(), rows.end(), std::back_inserter(offsets),
      [&source](const BallRow& row) { return source.Offset(row); });
    parallelFor(box.Begin[2], box.End[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t k = first; k < last; ++k)
        {
          for (std::ptrdiff_t j = box.Begin[1]; j < box.End[1]; ++j)
          {
            MergeRows(source.Row(j, k), offsets, source.GetWordsOfRow(),
              grown.Row(j, k) + source.GetBeginWord());
          }
        }
      });
  }
  return true;
}

// A mask that the monitor has stopped has neither voxels nor a grid.
bool Stop(BitMask& mask)
{
  mask = BitMask();
  return false;
}

bool DilateByDistance(BitMask& mask, double radius, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  std::vector<unsigned char> bytes(geometry.NumberOfVoxels(), 0);
  mask.ForEach([&bytes](std::size_t voxel) { bytes[voxel] = 1; });
  const std::vector<float> distance = SquaredDistance(bytes, geometry, 1, parallelFor, monitor);
  if (distance.empty() || !monitor(0.9))
  {
    return Stop(mask);
  }
  const float limit = static_cast<float>(radius * radius * Slack);
  mask = VoxelsWhere(
    ImageView<float>{ distance.data(), geometry },
    [limit](float square) { return square <= limit; }, parallelFor);
  return true;
}

} // namespace

std::array<int, 3> BallReach(double radius, const ImageGeometry& geometry)
{
  std::array<int, 3> voxels{};
  for (int axis = 0; axis < 3; ++axis)
  {
    voxels[axis] = static_cast<int>(
      std::min<double>(geometry.Dimensions[axis], radius * Slack / geometry.Spacing[axis]));
  }
  return voxels;
}

bool Dilate(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const ImageGeometry geometry = mask.GetGeometry();
  if (geometry.NumberOfVoxels() == 0)
  {
    return true;
  }
  const auto ball = RowsOfBall(radius, geometry);
  if (ball.empty())
  {
    return DilateByDistance(mask, radius, parallelFor, monitor);
  }
  VoxelBox box = mask.Bounds();
  if (box.IsEmpty())
  {
    return monitor(0) || Stop(mask);
  }
  box = box.Widened(BallReach(radius, geometry), { { { 0, 0, 0 } }, geometry.Dimensions });
  BitMask grown;
  if (!GrowByRows(mask, false, box, ball, parallelFor, monitor, grown))
  {
    return Stop(mask);
  }
  mask = std::move(grown);
  mask.CutRows();
  return true;
}

bool Erode(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const ImageGeometry geometry = mask.GetGeometry();
  const auto ball = RowsOfBall(radius, geometry);
  if (geometry.NumberOfVoxels() == 0 || ball.empty())
  {
    mask.Complement();
    if (!Dilate(mask, radius, parallelFor, monitor))
    {
      return false;
    }
    mask.Complement();
    return true;
  }
  const VoxelBox box = mask.Bounds();
  if (box.IsEmpty())
  {
    return monitor(0) || Stop(mask);
  }
  BitMask grown;
  if (!GrowByRows(mask, true, box, ball, parallelFor, monitor, grown))
  {
    return Stop(mask);
  }
  mask.Remove(grown);
  return true;
}

} // namespace FlipFree

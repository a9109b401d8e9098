#include "BallMorphology.h"

#include "DistanceTransform.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace FlipFree
{
namespace
{

// A ball of more rows is left to the distance transform, whose time does not depend on the radius,
// and is about that of so many rows.
constexpr double MostRows = 1000;
// A voxel whose centre is on the ball's surface belongs to it, whatever the rounding.
constexpr double Slack = 1 + 1e-6;

// One row of voxels of the ball: its place relative to the centre's row.
struct BallRow
{
  int J = 0;
  int K = 0;
};

// The rows by their half width in voxels. Empty if there are too many.
std::map<int, std::vector<BallRow>> RowsOfBall(double radius, const ImageGeometry& geometry)
{
  const Eigen::Vector3d& spacing = geometry.Spacing;
  const double greatestWidth = geometry.Dimensions[0]; // more would not matter
  std::map<int, std::vector<BallRow>> rows;
  const double square = radius * radius * Slack;
  const double slices = 2 * std::floor(std::sqrt(square) / spacing[2]) + 1;
  if (slices > MostRows)
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
    if (count > MostRows)
    {
      return {};
    }
    const int height = static_cast<int>(halfHeight);
    for (int j = -height; j <= height; ++j)
    {
      const double width = slice - j * j * spacing[1] * spacing[1];
      const double halfWidth = std::sqrt(std::max(0.0, width)) / spacing[0];
      rows[static_cast<int>(std::min(halfWidth, greatestWidth))].push_back({ j, k });
    }
  }
  return rows;
}

// Sets the bits of a row that are `step` places before or behind one that is set.
void SpreadRow(const BitMask::Word* from, std::ptrdiff_t size, int step, BitMask::Word* to)
{
  const std::ptrdiff_t words = step / BitMask::BitsOfWord;
  const int bits = step % BitMask::BitsOfWord;
  const int rest = BitMask::BitsOfWord - 1 - bits; // shifted in two steps, since bits may be zero
  for (std::ptrdiff_t word = words; word < size; ++word)
  {
    to[word] |= from[word - words] << bits;
    to[word - words] |= from[word] >> bits;
  }
  for (std::ptrdiff_t word = words + 1; word < size; ++word)
  {
    to[word] |= from[word - words - 1] >> rest >> 1;
    to[word - words - 1] |= from[word] << rest << 1;
  }
}

// Grows a row by `width` voxels to both sides, by doubling.
void GrowRow(BitMask::Word* row, std::ptrdiff_t size, int width, BitMask::Word last,
  std::vector<BitMask::Word>& scratch)
{
  for (int done = 0; done < width;)
  {
    const int step = std::min(width - done, done + 1);
    scratch.assign(row, row + size);
    SpreadRow(scratch.data(), size, step, row);
    done += step;
  }
  row[size - 1] &= last;
}

// A function of its own, so that the compiler knows that nothing else changes, and vectorises.
void MergeRow(const BitMask::Word* from, std::ptrdiff_t size, BitMask::Word* __restrict to)
{
  for (std::ptrdiff_t word = 0; word < size; ++word)
  {
    to[word] |= from[word];
  }
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
    mask = BitMask();
    return false;
  }
  const float limit = static_cast<float>(radius * radius * Slack);
  mask = VoxelsWhere(
    ImageView<float>{ distance.data(), geometry },
    [limit](float square) { return square <= limit; }, parallelFor);
  return true;
}

} // namespace

bool Dilate(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const ImageGeometry geometry = mask.GetGeometry();
  if (geometry.NumberOfVoxels() == 0)
  {
    return true;
  }
  const auto rowsOfWidth = RowsOfBall(radius, geometry);
  if (rowsOfWidth.empty())
  {
    return DilateByDistance(mask, radius, parallelFor, monitor);
  }
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t words = mask.GetWordsPerRow();
  BitMask source = std::move(mask);
  mask = BitMask();
  BitMask grown(geometry);
  std::vector<char> occupied(size[1] * static_cast<std::size_t>(size[2])); // per row of the source
  int grownBy = 0;
  const double passes = 2.0 * static_cast<double>(rowsOfWidth.size());
  double pass = 0;
  for (const auto& [width, rows] : rowsOfWidth)
  {
    if (!monitor(pass++ / passes))
    {
      return false;
    }
    parallelFor(0, static_cast<std::ptrdiff_t>(occupied.size()),
      [&, more = width - grownBy](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::vector<BitMask::Word> scratch;
        for (std::ptrdiff_t row = first; row < last; ++row)
        {
          BitMask::Word* const begin = source.GetWords().data() + row * words;
          occupied[row] =
            std::any_of(begin, begin + words, [](BitMask::Word word) { return word != 0; });
          if (occupied[row])
          {
            GrowRow(begin, words, more, source.GetLastWord(), scratch);
          }
        }
      });
    grownBy = width;
    if (!monitor(pass++ / passes))
    {
      return false;
    }
    parallelFor(0, size[2],
      [&, list = &rows](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t k = first; k < last; ++k)
        {
          for (std::ptrdiff_t j = 0; j < size[1]; ++j)
          {
            BitMask::Word* const target = grown.Row(j, k);
            for (const BallRow& part : *list)
            {
              const std::ptrdiff_t fromJ = j + part.J;
              const std::ptrdiff_t fromK = k + part.K;
              if (fromJ >= 0 && fromJ < size[1] && fromK >= 0 && fromK < size[2] &&
                occupied[fromK * size[1] + fromJ])
              {
                MergeRow(source.Row(fromJ, fromK), words, target);
              }
            }
          }
        }
      });
  }
  mask = std::move(grown);
  return true;
}

bool Erode(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor)
{
  mask.Complement();
  if (!Dilate(mask, radius, parallelFor, monitor))
  {
    return false;
  }
  mask.Complement();
  return true;
}

} // namespace FlipFree

#include "Image/BallMorphology.h"

#include "Image/DistanceTransform.h"
#include "Image/PaddedMask.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace FlipFree
{
namespace
{

// Balls whose box has more rows are left to the distance transform, whose time does not depend on
// the radius and is about that of this many rows.
constexpr double MaximumRows = 1300;
// A voxel whose center is on the ball's surface belongs to it, whatever the rounding.
constexpr double Slack = 1 + 1e-6;

// A row of voxels of the ball, by its place relative to the center's row.
struct BallRow
{
  int J = 0;
  int K = 0;
};

// The rows by their half width in voxels.
using Ball = std::map<int, std::vector<BallRow>>;

bool HasTooManyRows(double radius, const ImageGeometry& geometry)
{
  const Eigen::Array3d sizes = 2 * radius / geometry.Spacing.array() + 1;
  return sizes[1] * sizes[2] > MaximumRows;
}

Ball RowsOfBall(double radius, const ImageGeometry& geometry)
{
  const Eigen::Vector3d& spacing = geometry.Spacing;
  const auto& size = geometry.Dimensions;
  // Rows and voxels farther away than the grid is large reach nothing.
  const auto halfWidth = [&](double square, int axis, int limit)
  {
    const double width = std::sqrt(std::max(0.0, square)) / spacing[axis];
    return static_cast<int>(std::min<double>(width, limit));
  };
  Ball rows;
  const double square = radius * radius * Slack;
  const int depth = halfWidth(square, 2, size[2] - 1);
  for (int k = -depth; k <= depth; ++k)
  {
    const double slice = square - k * k * spacing[2] * spacing[2];
    const int height = halfWidth(slice, 1, size[1] - 1);
    for (int j = -height; j <= height; ++j)
    {
      const double row = slice - j * j * spacing[1] * spacing[1];
      rows[halfWidth(row, 0, size[0])].push_back({ j, k });
    }
  }
  return rows;
}

// In voxels along each axis.
std::array<int, 3> ReachOf(const Ball& ball)
{
  std::array<int, 3> reach{ { ball.rbegin()->first, 0, 0 } };
  for (const auto& [width, rows] : ball)
  {
    for (const BallRow& row : rows)
    {
      reach[1] = std::max(reach[1], row.J);
      reach[2] = std::max(reach[2], row.K);
    }
  }
  return reach;
}

using Word = BitMask::Word;

// Words that are merged at once where a row has enough.
constexpr std::ptrdiff_t Block = 4;

// Adds a number of words, known to the compiler, of several rows.
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

// The voxels of the box that are in the ball around a voxel of the mask, or with `complement` of
// one that is not in it. False if the monitor stopped it.
bool DilateByRows(const BitMask& mask, bool complement, const VoxelBox& box, const Ball& ball,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& grown)
{
  const double passes = 2.0 * static_cast<double>(ball.size());
  double pass = 0;
  if (!monitor(pass++ / passes))
  {
    return false;
  }
  PaddedMask source(mask, complement, box, ReachOf(ball), parallelFor);
  grown = BitMask(mask.GetGeometry());
  int grownBy = 0;
  for (const auto& [width, rows] : ball)
  {
    if (pass > 1 && !monitor(pass++ / passes))
    {
      return false;
    }
    source.DilateRows(width - grownBy, parallelFor);
    grownBy = width;
    if (!monitor(pass++ / passes))
    {
      return false;
    }
    std::vector<std::ptrdiff_t> offsets;
    for (const BallRow& row : rows)
    {
      offsets.push_back(source.Offset(row.J, row.K));
    }
    parallelFor(box.Begin[2], box.End[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t k = first; k < last; ++k)
        {
          for (std::ptrdiff_t j = box.Begin[1]; j < box.End[1]; ++j)
          {
            MergeRows(source.Row(j, k), offsets, source.GetWordsPerRow(),
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
  const ImageGeometry geometry = mask.GetGeometry();
  const std::vector<float> distance = SquaredDistance(mask, true, parallelFor, monitor);
  mask = BitMask(); // its memory is needed
  if (distance.empty() || !monitor(0.9))
  {
    return false;
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
  if (HasTooManyRows(radius, geometry))
  {
    return DilateByDistance(mask, radius, parallelFor, monitor);
  }
  const VoxelBox box = mask.Bounds();
  if (box.IsEmpty())
  {
    return monitor(0) || Stop(mask);
  }
  BitMask grown;
  if (!DilateByRows(mask, false, box.Widened(BallReach(radius, geometry), WholeBox(geometry)),
        RowsOfBall(radius, geometry), parallelFor, monitor, grown))
  {
    return Stop(mask);
  }
  mask = std::move(grown);
  mask.ClearPadding();
  return true;
}

bool Erode(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const ImageGeometry geometry = mask.GetGeometry();
  if (geometry.NumberOfVoxels() == 0)
  {
    return true;
  }
  if (HasTooManyRows(radius, geometry))
  {
    mask.Complement();
    const bool done = DilateByDistance(mask, radius, parallelFor, monitor);
    mask.Complement();
    return done;
  }
  const VoxelBox box = mask.Bounds();
  if (box.IsEmpty())
  {
    return monitor(0) || Stop(mask);
  }
  BitMask grown;
  if (!DilateByRows(mask, true, box, RowsOfBall(radius, geometry), parallelFor, monitor, grown))
  {
    return Stop(mask);
  }
  mask.Remove(grown);
  return true;
}

} // namespace FlipFree

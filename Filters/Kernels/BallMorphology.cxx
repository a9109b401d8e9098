#include "BallMorphology.h"

#include "DistanceTransform.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace FlipFree
{
namespace
{

// A ball of more rows is left to the distance transform, whose time does not depend on the radius.
constexpr double MostRows = 1250;
// A voxel whose centre is on the ball's surface belongs to it, whatever the rounding.
constexpr double Slack = 1 + 1e-6;

// One row of voxels of the ball: its place relative to the centre's row.
struct BallRow
{
  int J = 0;
  int K = 0;
};

// The rows by their half width in voxels. Empty if there are too many.
std::map<int, std::vector<BallRow>> RowsOfBall(double radius, const Eigen::Vector3d& spacing)
{
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
      rows[static_cast<int>(std::sqrt(std::max(0.0, width)) / spacing[0])].push_back({ j, k });
    }
  }
  return rows;
}

// Grows the ones of a row by `width` voxels to both sides, by doubling.
void GrowRow(unsigned char* row, int size, int width, std::vector<unsigned char>& scratch)
{
  scratch.resize(size);
  for (int done = 0; done < width;)
  {
    const int step = std::min({ width - done, done + 1, size });
    std::copy_n(row, size, scratch.begin());
    for (int i = 0; i + step < size; ++i)
    {
      row[i] |= scratch[i + step];
    }
    for (int i = step; i < size; ++i)
    {
      row[i] |= scratch[i - step];
    }
    done += step;
  }
}

// A function of its own, so that the compiler knows that nothing else changes, and vectorises.
void MergeRow(const unsigned char* from, std::ptrdiff_t size, unsigned char* __restrict to)
{
  for (std::ptrdiff_t i = 0; i < size; ++i)
  {
    to[i] |= from[i];
  }
}

bool GrowByDistance(std::vector<unsigned char>& mask, const ImageGeometry& geometry, double radius,
  unsigned char value, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const std::vector<float> distance = SquaredDistance(mask, geometry, value, parallelFor, monitor);
  if (distance.empty() || !monitor(0.9))
  {
    return false;
  }
  const float limit = static_cast<float>(radius * radius * Slack);
  for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
  {
    if (distance[voxel] <= limit)
    {
      mask[voxel] = value;
    }
  }
  return true;
}

} // namespace

bool GrowValue(std::vector<unsigned char>& mask, const ImageGeometry& geometry, double radius,
  unsigned char value, const ParallelFor& parallelFor, const Monitor& monitor)
{
  const auto rowsOfWidth = RowsOfBall(radius, geometry.Spacing);
  if (mask.empty() || rowsOfWidth.empty())
  {
    return mask.empty() || GrowByDistance(mask, geometry, radius, value, parallelFor, monitor);
  }
  const auto& size = geometry.Dimensions;
  const std::ptrdiff_t row = size[0];
  const std::ptrdiff_t slice = row * size[1];
  // Ones where the value is; then where it comes.
  std::vector<unsigned char> source(mask.size());
  std::transform(mask.begin(), mask.end(), source.begin(),
    [value](unsigned char voxel) { return static_cast<unsigned char>(voxel == value); });
  std::vector<unsigned char> grown(mask.size(), 0);
  std::vector<char> occupied(size[1] * static_cast<std::size_t>(size[2])); // per row of the source
  int grownBy = 0;
  const double passes = 2.0 * static_cast<double>(rowsOfWidth.size()) + 1;
  double pass = 0;
  for (const auto& [width, rows] : rowsOfWidth)
  {
    if (!monitor(pass++ / passes))
    {
      return false;
    }
    parallelFor(0, size[2],
      [&, more = width - grownBy](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::vector<unsigned char> scratch;
        for (std::ptrdiff_t offset = first * slice; offset < last * slice; offset += row)
        {
          unsigned char* const begin = source.data() + offset;
          GrowRow(begin, size[0], more, scratch);
          occupied[offset / row] = std::memchr(begin, 1, size[0]) != nullptr;
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
            unsigned char* const target = grown.data() + k * slice + j * row;
            for (const BallRow& part : *list)
            {
              if (j + part.J >= 0 && j + part.J < size[1] && k + part.K >= 0 &&
                k + part.K < size[2])
              {
                const std::ptrdiff_t from = (k + part.K) * slice + (j + part.J) * row;
                if (occupied[from / row])
                {
                  MergeRow(source.data() + from, row, target);
                }
              }
            }
          }
        }
      });
  }
  if (!monitor(pass / passes))
  {
    return false;
  }
  for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
  {
    mask[voxel] = grown[voxel] ? value : mask[voxel];
  }
  return true;
}

} // namespace FlipFree

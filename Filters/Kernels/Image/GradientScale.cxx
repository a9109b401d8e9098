#include "Image/GradientScale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace FlipFree
{
namespace
{

struct SliceSum
{
  double Squares = 0;
  std::size_t Voxels = 0;
};

SliceSum SumOfSlice(const VoxelReader& read, const ImageGeometry& image, const VoxelBox& box,
  const SeedSphere& sphere, int k)
{
  const auto& size = image.Dimensions;
  const int begin = std::max(box.Begin[0] - 1, 0); // rows are read with a neighbor on either side
  const int end = std::min(box.End[0] + 1, size[0]);
  // The row itself, its neighbors within the slice, and those in the slices next to it.
  std::array<std::vector<float>, 5> rows;
  rows.fill(std::vector<float>(static_cast<std::size_t>(end - begin)));
  const auto squareOf = [&image](int axis, double before, double after)
  {
    const double slope = (after - before) / (2 * image.Spacing[axis]);
    return slope * slope;
  };
  SliceSum sum;
  for (int j = box.Begin[1]; j < box.End[1]; ++j)
  {
    read(begin, end, j, k, rows[0].data());
    read(begin, end, std::max(j - 1, 0), k, rows[1].data());
    read(begin, end, std::min(j + 1, size[1] - 1), k, rows[2].data());
    read(begin, end, j, std::max(k - 1, 0), rows[3].data());
    read(begin, end, j, std::min(k + 1, size[2] - 1), rows[4].data());
    for (int i = box.Begin[0]; i < box.End[0]; ++i)
    {
      if (std::isinf(sphere.Radius) ||
        (image.ToPhysical(Eigen::Vector3d(i, j, k)) - sphere.Center).squaredNorm() <=
          sphere.Radius * sphere.Radius)
      {
        const int at = i - begin;
        sum.Squares +=
          squareOf(0, rows[0][std::max(at - 1, 0)], rows[0][std::min(at + 1, end - begin - 1)]);
        sum.Squares += squareOf(1, rows[1][at], rows[2][at]);
        sum.Squares += squareOf(2, rows[3][at], rows[4][at]);
        ++sum.Voxels;
      }
    }
  }
  return sum;
}

} // namespace

bool MeasureGradientScale(const VoxelReader& read, const ImageGeometry& image, const VoxelBox& box,
  const SeedSphere& sphere, const Threading& threading, const Monitor& monitor, double& scale)
{
  std::vector<SliceSum> sums(static_cast<std::size_t>(std::max(0, box.Size(2))));
  const std::ptrdiff_t voxelsOfSlice = static_cast<std::ptrdiff_t>(box.Size(0)) * box.Size(1);
  if (!ForSlices(threading, 0, static_cast<std::ptrdiff_t>(sums.size()), voxelsOfSlice, monitor,
        [&](std::ptrdiff_t first, std::ptrdiff_t last)
        {
          for (std::ptrdiff_t slice = first; slice < last; ++slice)
          {
            sums[slice] =
              SumOfSlice(read, image, box, sphere, box.Begin[2] + static_cast<int>(slice));
          }
        }))
  {
    return false;
  }
  SliceSum whole; // in the order of the slices, whichever thread had them
  for (const SliceSum& sum : sums)
  {
    whole.Squares += sum.Squares;
    whole.Voxels += sum.Voxels;
  }
  scale = whole.Voxels > 0 ? std::sqrt(whole.Squares / static_cast<double>(whole.Voxels)) : 0;
  return true;
}

} // namespace FlipFree

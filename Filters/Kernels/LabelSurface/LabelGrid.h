/**
 * The labels of a label map as small numbers, in the box where they are: labels of any integer
 * type and any size become 1, 2, 3 ... in ascending order, and background becomes 0.
 */
#ifndef FlipFreeLabelGrid_h
#define FlipFreeLabelGrid_h

#include "Error.h"
#include "KernelTypes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace FlipFree
{

/// More are not labels but, for example, the intensities of a scan.
constexpr std::size_t MaximumLabels = 65000;

/// A box of voxels with a layer of background all around, so that what touches the border of the
/// image is closed there.
struct LabelGrid
{
  using Index = std::uint16_t; ///< holds MaximumLabels, and one number more

  std::array<int, 3> Size{ { 0, 0, 0 } };  ///< voxels along each axis, with the layers
  std::array<int, 3> First{ { 0, 0, 0 } }; ///< where the image has voxel (0, 0, 0) of the box
  std::vector<Index> Labels;               ///< of each voxel, an index into Values
  std::vector<int> Values{ 0 };            ///< the labels in the image, ascending

  std::size_t Offset(int i, int j, int k) const
  {
    return i +
      static_cast<std::size_t>(this->Size[0]) * (j + static_cast<std::size_t>(this->Size[1]) * k);
  }
  /// The label at a voxel of the box, as an index, and background beyond.
  int At(int i, int j, int k) const
  {
    return i >= 0 && j >= 0 && k >= 0 && i < this->Size[0] && j < this->Size[1] && k < this->Size[2]
      ? this->Labels[this->Offset(i, j, k)]
      : 0;
  }
};

/// What the voxels of some slices hold.
struct LabelCensus
{
  std::set<int> Values;
  std::array<int, 3> Low{ { std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
    std::numeric_limits<int>::max() } };
  std::array<int, 3> High{ { -1, -1, -1 } };
  std::size_t Invalid = std::numeric_limits<std::size_t>::max(); ///< the first that is no label

  void Merge(const LabelCensus& other);
};

/// Throws Error unless there are labels, and only such; drops those that are not wanted. `voxel`
/// is the text of the first invalid voxel's value.
void RequireLabels(LabelCensus& census, const std::vector<int>& wanted, const std::string& name,
  const std::array<int, 3>& invalidVoxel, double invalidValue);

/// The labels of an image, named by `name`. Without `wanted` labels, all: whole numbers above 0.
/// Other labels are background. Throws Error where a voxel is negative, not a whole number or
/// beyond the greatest int, if a wanted label does not occur, if there are no labels, and if there
/// are more than MaximumLabels.
template <typename T>
LabelGrid MakeLabelGrid(const ImageView<T>& image, const std::vector<int>& wanted,
  const std::string& name, const ParallelFor& parallelFor)
{
  const auto isLabel = [](T value)
  {
    const auto number = static_cast<double>(value);
    return number >= 0 && number <= std::numeric_limits<int>::max() && number == std::floor(number);
  };
  const auto isWanted = [&wanted](int value)
  { return wanted.empty() || std::find(wanted.begin(), wanted.end(), value) != wanted.end(); };
  const auto& size = image.Geometry.Dimensions;
  LabelCensus census;
  std::mutex mutex;
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      LabelCensus found;
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1] && found.Values.size() <= MaximumLabels; ++j)
        {
          const T* const row = &image(0, j, k);
          T latest = 0;
          bool isLatestWanted = false;
          for (int i = 0; i < size[0]; ++i)
          {
            const T value = row[i];
            if (value == T(0))
            {
              continue;
            }
            if (value != latest)
            {
              if (!isLabel(value))
              {
                found.Invalid = std::min(found.Invalid, image.Geometry.Offset(i, j, k));
                continue;
              }
              latest = value;
              isLatestWanted = isWanted(static_cast<int>(value));
              if (isLatestWanted)
              {
                found.Values.insert(static_cast<int>(value));
              }
            }
            if (isLatestWanted)
            {
              found.Low = { { std::min(found.Low[0], i), std::min(found.Low[1], j),
                std::min(found.Low[2], k) } };
              found.High = { { std::max(found.High[0], i), std::max(found.High[1], j),
                std::max(found.High[2], k) } };
            }
          }
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      census.Merge(found);
    });

  std::array<int, 3> invalid{ { 0, 0, 0 } };
  double invalidValue = 0;
  if (census.Invalid < image.Geometry.NumberOfVoxels())
  {
    invalidValue = static_cast<double>(image.Data[census.Invalid]);
    const std::size_t row = census.Invalid / size[0];
    invalid = { { static_cast<int>(census.Invalid % size[0]), static_cast<int>(row % size[1]),
      static_cast<int>(row / size[1]) } };
  }
  RequireLabels(census, wanted, name, invalid, invalidValue);

  LabelGrid grid;
  grid.Values.insert(grid.Values.end(), census.Values.begin(), census.Values.end());
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.First[axis] = census.Low[axis] - 1;
    grid.Size[axis] = census.High[axis] - census.Low[axis] + 3;
  }
  grid.Labels.resize(static_cast<std::size_t>(grid.Size[0]) * grid.Size[1] * grid.Size[2]);
  parallelFor(1, grid.Size[2] - 1,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      T latest = 0;
      LabelGrid::Index label = 0;
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 1; j < grid.Size[1] - 1; ++j)
        {
          const T* const row = &image(grid.First[0] + 1, grid.First[1] + j, grid.First[2] + k);
          LabelGrid::Index* const labels = &grid.Labels[grid.Offset(1, j, k)];
          for (int i = 0; i < grid.Size[0] - 2; ++i)
          {
            if (row[i] != latest)
            {
              latest = row[i];
              const auto found =
                std::lower_bound(grid.Values.begin(), grid.Values.end(), static_cast<int>(latest));
              label = found != grid.Values.end() && *found == static_cast<int>(latest)
                ? static_cast<LabelGrid::Index>(found - grid.Values.begin())
                : 0;
            }
            labels[i] = label;
          }
        }
      }
    });
  return grid;
}

} // namespace FlipFree

#endif

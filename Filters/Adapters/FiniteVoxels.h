/**
 * Private to the modules, never installed: the check that the voxels of an image are finite
 * numbers.
 */
#ifndef FlipFreeFiniteVoxels_h
#define FlipFreeFiniteVoxels_h

#include "ExecutionAdapter.h"
#include "Image/SeedRegion.h"
#include "MessageText.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace FlipFree
{

inline Extent WholeExtent(const ImageGeometry& geometry)
{
  return { { 0, geometry.Dimensions[0] - 1, 0, geometry.Dimensions[1] - 1, 0,
    geometry.Dimensions[2] - 1 } };
}

/// Throws std::invalid_argument, naming the image by `name` and the first bad voxel, unless all of
/// a part of the image are finite as a Number. Whole numbers are not looked at. Returns false if
/// the monitor, asked every few slices, stopped it.
template <typename Number, typename T>
bool RequireFiniteAs(const ImageView<T>& image, const Extent& extent, const std::string& name,
  const std::string& remedy, const Monitor& monitor)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    const std::ptrdiff_t columns = extent[1] - extent[0] + 1;
    const std::ptrdiff_t rows = extent[3] - extent[2] + 1;
    constexpr std::ptrdiff_t none = std::numeric_limits<std::ptrdiff_t>::max();
    std::atomic<std::ptrdiff_t> firstBad{ none };
    const auto look = [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t row = first * rows; row < last * rows; ++row)
      {
        const T* const voxels = &image(extent[0], extent[2] + static_cast<int>(row % rows),
          extent[4] + static_cast<int>(row / rows));
        const std::ptrdiff_t good =
          std::find_if(voxels, voxels + columns,
            [](T value) { return !std::isfinite(static_cast<Number>(value)); }) -
          voxels;
        if (good < columns)
        {
          const std::ptrdiff_t bad = row * columns + good;
          for (std::ptrdiff_t known = firstBad; bad < known;)
          {
            firstBad.compare_exchange_weak(known, bad);
          }
          return; // what follows is not the first
        }
      }
    };
    // What has been looked at holds the first bad voxel, if any.
    const bool done = SMPForSlices(
      0, extent[5] - extent[4] + 1, columns * rows,
      [&](double fraction) { return firstBad == none && monitor(fraction); }, look);
    if (firstBad != none)
    {
      const std::ptrdiff_t row = firstBad / columns;
      const std::ptrdiff_t slice = row / rows;
      const Eigen::Vector3d index(extent[0] + static_cast<double>(firstBad % columns),
        extent[2] + static_cast<double>(row % rows), extent[4] + static_cast<double>(slice));
      throw std::invalid_argument("a voxel of " + name + ", at " +
        TextOf(image.Geometry.ToPhysical(index)) + " mm, is not a finite number" +
        (std::is_same_v<Number, T> ? "; " : " in the range of float; ") + remedy);
    }
    return done;
  }
  else
  {
    return true;
  }
}

} // namespace FlipFree

#endif

/**
 * The check that the voxels of an image are finite numbers.
 */
#ifndef FlipFreeFiniteVoxels_h
#define FlipFreeFiniteVoxels_h

#include "Error.h"
#include "Image/SliceParts.h"
#include "Image/VoxelBox.h"
#include "MessageText.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace FlipFree
{

/// Throws Error, naming the image by `name` and the first bad voxel, unless all voxels of a box are
/// finite as a Number. Integers pass unseen. Returns false if the monitor, asked every few slices,
/// stopped it.
template <typename Number, typename T>
bool RequireFiniteAs(const ImageView<T>& image, const VoxelBox& box, const std::string& name,
  const std::string& remedy, const Threading& threading, const Monitor& monitor)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    const std::ptrdiff_t columns = box.Size(0);
    const std::ptrdiff_t rows = box.Size(1);
    constexpr std::ptrdiff_t none = std::numeric_limits<std::ptrdiff_t>::max();
    std::atomic<std::ptrdiff_t> firstBad{ none };
    const auto look = [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t row = first * rows; row < last * rows; ++row)
      {
        const T* const voxels = &image(box.Begin[0], box.Begin[1] + static_cast<int>(row % rows),
          box.Begin[2] + static_cast<int>(row / rows));
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
          return; // later ones do not matter
        }
      }
    };
    // The slices checked so far include the first bad voxel, if any.
    const bool done = ForSlices(
      threading, 0, box.Size(2), columns * rows,
      [&](double fraction) { return firstBad == none && monitor(fraction); }, look);
    if (firstBad != none)
    {
      const std::ptrdiff_t row = firstBad / columns;
      const std::ptrdiff_t slice = row / rows;
      const Eigen::Vector3d index(box.Begin[0] + static_cast<double>(firstBad % columns),
        box.Begin[1] + static_cast<double>(row % rows), box.Begin[2] + static_cast<double>(slice));
      throw Error(ErrorCode::NonFiniteValue,
        "a voxel of " + name + ", at " + TextOf(image.Geometry.ToPhysical(index)) +
          " mm, is not a finite number" +
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

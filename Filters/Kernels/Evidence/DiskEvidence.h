/**
 * Where a vessel's cross-section may lie in the slices of an image: disks about the places of a
 * grid, and how well each stands out from what is around it.
 */
#ifndef FlipFreeDiskEvidence_h
#define FlipFreeDiskEvidence_h

#include "Image/BitMask.h"
#include "KernelTypes.h"

#include <array>
#include <cstddef>
#include <vector>

namespace FlipFree
{

/// Disks of each radius about each place, in slices that are equally far apart. Places are counted
/// in the directions of the body, whatever those of the image, so that the result does not depend
/// on how an image is stored.
struct DiskGrid
{
  static constexpr double Step = 3;                                  ///< millimeters between places
  static constexpr std::array<double, 4> Radii{ { 8, 10, 12, 14 } }; ///< millimeters

  int Across = 2;                        ///< the axis across the slices
  std::array<int, 2> Within{ { 0, 1 } }; ///< the axes within them
  std::vector<int> Slices;               ///< voxels along the axis across, one after the other
  double Thickness = 0;                  ///< millimeters from one of them to the next
  /// The first place, in millimeters from the first voxel, and where the next ones lie: 1 or -1.
  std::array<double, 2> First{ { 0, 0 } };
  std::array<double, 2> Sign{ { 1, 1 } };
  std::array<int, 2> Count{ { 0, 0 } }; ///< of the places, along either axis

  /// Disks per slice.
  std::size_t Size() const { return Radii.size() * this->Count[0] * this->Count[1]; }

  /// In millimeters from the first voxel along one of the axes within.
  double At(int axis, double place) const
  {
    return this->First[axis] + this->Sign[axis] * place * Step;
  }
};

/// Of one slice; the first axis runs fastest, then the second one, then the radius.
struct DiskSlice
{
  /// How far the disk's median is above the gray values beyond its rim, all around: from 0, by at
  /// most 20 HU, to 1, by 60 HU and more. The darker of two values counts, 2 and 4 mm from the rim.
  std::vector<float> Contrast;
  std::vector<float> Value;   ///< the median of the gray values
  std::vector<float> Spread;  ///< of the gray values, from the 16th to the 84th percentile
  std::vector<float> Covered; ///< the part of the disk that is in the mask
};

/// `image` is CT, and the mask on its grid. A voxel that is not a number counts as fat.
std::vector<DiskSlice> MeasureDisks(const ImageView<float>& image, const BitMask& mask,
  const DiskGrid& grid, const ParallelFor& parallelFor);

/// The box that is read. There is at least one slice.
VoxelBox BoxOf(const DiskGrid& grid, const ImageGeometry& geometry);

} // namespace FlipFree

#endif

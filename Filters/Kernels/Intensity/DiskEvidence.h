/**
 * Where a vessel's cross-section may lie in the slices of an image: disks about the places of a
 * grid, and how well each stands out from what is around it.
 */
#ifndef FlipFreeDiskEvidence_h
#define FlipFreeDiskEvidence_h

#include "Image/BitMask.h"

#include <array>
#include <vector>

namespace FlipFree
{

/// Disks of each radius about each place, in slices that are equally far apart.
struct DiskGrid
{
  static constexpr double Step = 3;                                  ///< millimeters between places
  static constexpr std::array<double, 4> Radii{ { 8, 10, 12, 14 } }; ///< millimeters

  int Across = 2;                          ///< the axis across the slices
  std::array<int, 2> Within{ { 0, 1 } };   ///< the axes within them
  std::vector<int> Slices;                 ///< voxels along the axis across, ascending
  double Thickness = 0;                    ///< millimeters from one of them to the next
  std::array<double, 2> First{ { 0, 0 } }; ///< of the places, in millimeters from the first voxel
  std::array<int, 2> Count{ { 0, 0 } };    ///< of the places, along either axis

  std::size_t Size() const { return Radii.size() * this->Count[0] * this->Count[1]; }
};

/// Of one slice; the first axis runs fastest, then the second one, then the radius.
struct DiskSlice
{
  std::vector<float> Contrast; ///< the part of the rim that is brighter than what lies beyond
  std::vector<float> Value;    ///< the median of the gray values
  std::vector<float> Spread;   ///< of the gray values, from the 16th to the 84th percentile
  std::vector<float> Covered;  ///< the part of the disk that is in the mask
};

/// `image` is CT, and the mask on its grid.
std::vector<DiskSlice> MeasureDisks(const ImageView<float>& image, const BitMask& mask,
  const DiskGrid& grid, const ParallelFor& parallelFor);

/// The box that is read.
VoxelBox BoxOf(const DiskGrid& grid, const ImageGeometry& geometry);

} // namespace FlipFree

#endif

/**
 * The path of a vessel through the slices of an image: outside the organ, then along the organ's
 * border within its mask, then outside again. Of all ways to place a disk in each slice, dynamic
 * programming finds the one that stands out most and moves least from slice to slice.
 */
#ifndef FlipFreeVesselTrack_h
#define FlipFreeVesselTrack_h

#include "Evidence/DiskEvidence.h"

#include <array>
#include <vector>

namespace FlipFree
{

struct VesselTrack
{
  struct Disk
  {
    int Slice;                    ///< of the grid
    std::array<double, 2> Center; ///< in millimeters from the first voxel, along the axes
    double Radius;                ///< millimeters
  };

  std::vector<Disk> InOrgan; ///< slice after slice
  double LengthBefore = 0;   ///< of the path outside the organ, in millimeters
  double LengthBehind = 0;
};

/// Disks are compared with those that the mask covers wholly, and that tell the organ's gray value
/// and noise. Without any disk in the mask, the track is empty.
VesselTrack FindVesselTrack(const DiskGrid& grid, const std::vector<DiskSlice>& slices,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

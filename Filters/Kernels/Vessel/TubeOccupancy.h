/**
 * From the outlines of vessels in cross-sections to voxels: how far inside each voxel is.
 */
#ifndef FlipFreeTubeOccupancy_h
#define FlipFreeTubeOccupancy_h

#include "Image/SeedRegion.h"
#include "Vessel/CrossSections.h"

namespace FlipFree
{

/// In millimeters, positive inside, negative outside, -margin farther away and where no section is
/// near. A voxel belongs to the nearest section; beyond the first and the last section the vessel
/// ends, unless `open`.
void MergeTubeDepth(const VesselSections& sections, double margin, bool openStart, bool openEnd,
  const ParallelFor& parallelFor, FloatImage& depth);

} // namespace FlipFree

#endif

/**
 * Operations that treat each slice of a mask separately, since volumes are often coarser across
 * slices.
 */
#ifndef FlipFreeSliceMorphology_h
#define FlipFreeSliceMorphology_h

#include "Image/BitMask.h"

namespace FlipFree
{

/// The axis across the slices: the one of the greatest spacing, and z among equals.
int AxisAcrossSlices(const ImageGeometry& geometry);

/// Adds to `sum` the mask moved by a voxel either way along an axis. Both are on the same grid.
void AddNeighborsAlong(int axis, const BitMask& mask, BitMask& sum);

/// The median of the nine voxels around each in its slice; nothing beyond the image is in the mask.
void MedianInSlices(BitMask& mask, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The label map of surfaces that are smoother than the voxels of a label map allow.
 *
 * A label that was drawn slice by slice, or that a network found, has steps that no surface within
 * half a voxel can be smooth over. A voxel gets the label in whose surface its center is, if
 * several conditions hold. A voxel around has this label, so that the voxel is next to a wall. And
 * it is simple for both labels, the former and the new one, whichever way diagonal neighbors are
 * counted (SimpleVoxel.h): neither falls apart, closes a gap, or disappears.
 */
#ifndef FlipFreeSmoothLabels_h
#define FlipFreeSmoothLabels_h

#include "LabelSurface/LabelMeasures.h"

namespace FlipFree
{

/// `walls` are in the grid's indices, and may intersect.
LabelGrid SmoothLabels(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The label map of surfaces that are smoother than the voxels of a label map allow.
 *
 * A label that was drawn slice by slice, or that a network found, has steps that no surface within
 * half a voxel can be smooth over. A voxel gets the label in whose surface its center is, if
 * several conditions hold. A voxel around has this label, so that the voxel is next to a wall. And
 * it is simple for both labels, the former and the new one, whichever way diagonal neighbors are
 * counted (A. Rosenfeld, Three-dimensional digital topology, 1981; G. Bertrand and G. Malandain, A
 * new characterization of three-dimensional simple points, 1994): neither falls apart, closes a
 * gap, or disappears.
 */
#ifndef FlipFreeSmoothLabels_h
#define FlipFreeSmoothLabels_h

#include "LabelSurface/LabelMeasures.h"

namespace FlipFree
{

/// `walls` are in the grid's indices, and may intersect.
LabelGrid SmoothLabels(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor);

/// Whether a voxel may join or leave the voxels in a mask without a change of their topology or
/// that of the others, whichever of the two are connected across edges and corners. Bit
/// 9 (k + 1) + 3 (j + 1) + i + 1 of the mask is the neighbor at (i, j, k).
bool IsSimpleVoxel(unsigned int neighbors);

} // namespace FlipFree

#endif

/**
 * Dilation and erosion of masks by balls, measured in millimeters along the grid's axes. On a
 * sheared grid (a tilted gantry's) the angles between the axes are ignored, and the ball becomes an
 * ellipsoid sheared with the grid: where two axes meet at 70 degrees, its half axes are 0.81
 * and 1.16 of the radius.
 */
#ifndef FlipFreeBallMorphology_h
#define FlipFreeBallMorphology_h

#include "Image/BitMask.h"

namespace FlipFree
{

/// How many voxels a ball around a voxel's center reaches along each axis, at most as many as the
/// grid has. Voxels whose center is on the ball's surface belong to it, whatever the rounding.
std::array<int, 3> BallReach(double radius, const ImageGeometry& geometry);

/// Adds all voxels within `radius` millimeters of the mask. Returns false if the monitor, asked
/// before each pass over the mask, stopped it; the mask then has neither voxels nor a grid.
bool Dilate(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor);

/// Removes all voxels within `radius` millimeters of a voxel that is not in the mask. Nothing
/// beyond the image counts. Stops like Dilate().
bool Erode(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

/**
 * Dilation and erosion of masks by balls measured in millimeters along the grid's axes: balls where
 * the axes are at right angles, whichever way they point. On a sheared grid (a tilted gantry's) the
 * angle between the axes is not taken into account, and the ball becomes an ellipsoid, sheared with
 * the grid: where two axes meet at 70 degrees, its half axes are 0.81 and 1.16 of the radius.
 */
#ifndef FlipFreeBallMorphology_h
#define FlipFreeBallMorphology_h

#include "Image/BitMask.h"

namespace FlipFree
{

/// How many voxels a ball reaches along each axis from the center of one, at most as many as the
/// grid has. A voxel whose center is on the ball's surface belongs to it, whatever the rounding.
std::array<int, 3> BallReach(double radius, const ImageGeometry& geometry);

/// Adds all voxels within `radius` millimeters of the mask. Returns false if the monitor, asked
/// before each pass over the mask, stopped it; the mask then has neither voxels nor a grid.
bool Dilate(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor);

/// Takes out all voxels within `radius` millimeters of one that is not in the mask. What lies
/// beyond the image counts as neither. Stops like Dilate().
bool Erode(BitMask& mask, double radius, const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

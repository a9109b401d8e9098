/**
 * Dilation and erosion of masks by balls measured in millimetres along the grid's axes: balls where
 * the axes are at right angles, whichever way they point. On a sheared grid (a tilted gantry's) the
 * angle between the axes is not taken into account, and the ball becomes an ellipsoid, sheared with
 * the grid: where two axes meet at 70 degrees, its half axes are 0.81 and 1.16 of the radius.
 */
#ifndef FlipFreeBallMorphology_h
#define FlipFreeBallMorphology_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// Sets (value 1) or clears (value 0) all voxels within `radius` millimetres of one that is.
/// Returns false if the monitor, asked before each pass over the mask, stopped it; the mask is then
/// as it was.
bool GrowValue(std::vector<unsigned char>& mask, const ImageGeometry& geometry, double radius,
  unsigned char value, const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

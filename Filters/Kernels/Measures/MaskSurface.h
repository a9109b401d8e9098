/**
 * The surface of a mask: the boundary of its voxels as triangles.
 */
#ifndef FlipFreeMaskSurface_h
#define FlipFreeMaskSurface_h

#include "Image/BitMask.h"
#include "KernelTypes.h"

namespace FlipFree
{

struct MaskSurface
{
  PointList Points;
  TriangleList Triangles;
};

/// The closed surface half-way between the voxels inside the mask and those outside, in physical
/// millimeters, counter-clockwise seen from outside. The space beyond the image is outside. Voxels
/// that only share an edge or a corner are not joined. Iterations of windowed sinc smoothing (pass
/// band 0.1) remove the steps of the voxels. An empty mask has no surface.
MaskSurface SurfaceOf(const BitMask& mask, int smoothingIterations = 0);

} // namespace FlipFree

#endif

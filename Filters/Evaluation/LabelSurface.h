/**
 * Private to the module: the surface of a label, by VTK's flying edges.
 */
#ifndef FlipFreeLabelSurface_h
#define FlipFreeLabelSurface_h

#include "LabelAdapter.h"

namespace FlipFree
{

struct LabelSurface
{
  PointList Points;
  TriangleList Triangles;
};

/// The closed surface half-way between the voxels inside the mask and those outside, in physical
/// millimeters, counter-clockwise seen from outside. The space beyond the image is outside. The
/// mask must not be empty. Iterations of windowed sinc smoothing remove the steps of the voxels.
LabelSurface SurfaceOf(const BitMask& mask, int smoothingIterations = 0);

} // namespace FlipFree

#endif

/**
 * How close a surface comes to itself.
 */
#ifndef FlipFreeSurfaceGap_h
#define FlipFreeSurfaceGap_h

#include "KernelTypes.h"

namespace FlipFree
{

/// The least distance (mm) between two triangles that share no vertex; infinite when all do. The
/// surface must be valid (RequireValidFaces) and must not intersect itself: the distance is taken
/// between vertices and triangles and between edges, which is right for triangles that are apart.
double MeasureLeastGap(const PointList& points, const TriangleList& triangles,
  const ParallelFor& parallelFor = SerialFor);

} // namespace FlipFree

#endif

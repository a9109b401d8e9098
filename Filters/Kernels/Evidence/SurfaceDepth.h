/**
 * How deep places lie inside a closed surface: their distance from what is outside.
 */
#ifndef FlipFreeSurfaceDepth_h
#define FlipFreeSurfaceDepth_h

#include "KernelTypes.h"

namespace FlipFree
{

struct SurfaceDepths
{
  double OfPoint = 0;  ///< mm; 0 where the point is not inside
  double Greatest = 0; ///< mm; 0 where the surface is too flat for the grid
};

/// On a grid of cubes with edges of `step` millimeters, by up to about one of which depths are
/// wrong; of larger ones where the surface is longer than 128 of them. The surface is closed and
/// holds a volume.
SurfaceDepths FindDepths(const PointList& points, const TriangleList& triangles,
  const Eigen::Vector3d& point, double step, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The distances between disjoint triangles of a surface.
 */
#ifndef FlipFreeSurfaceGap_h
#define FlipFreeSurfaceGap_h

#include "Geometry/TriangleTree.h"

namespace FlipFree
{

/// The minimum distance (mm) of two triangles that share no vertex; infinite if there are none. The
/// surface must be valid (RequireValidFaces) and must not intersect itself.
double MeasureMinimumGap(const PointList& points, const TriangleList& triangles,
  const ParallelFor& parallelFor = SerialFor);

/// The pairs of triangles that share no vertex and are closer than `gap` (mm), of a surface as
/// above. `tree` was built for its triangles, at any positions.
std::vector<std::pair<int, int>> FindPairsNearerThan(double gap, const TriangleTree& tree,
  const PointList& points, const TriangleList& triangles, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

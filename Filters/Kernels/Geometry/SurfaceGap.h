/**
 * How close a surface comes to itself.
 */
#ifndef FlipFreeSurfaceGap_h
#define FlipFreeSurfaceGap_h

#include "Geometry/TriangleTree.h"

namespace FlipFree
{

/// The least distance (mm) between two triangles that share no vertex; infinite when all do. The
/// surface must be valid (RequireValidFaces) and must not intersect itself: the distance is taken
/// between vertices and triangles and between edges, which is right for triangles that are apart.
double MeasureMinimumGap(const PointList& points, const TriangleList& triangles,
  const ParallelFor& parallelFor = SerialFor);

/// The pairs of triangles that share no vertex and are nearer to each other than `gap` (mm), of a
/// surface like that above; `tree` was built for its triangles, at any positions.
std::vector<std::pair<int, int>> FindPairsNearerThan(double gap, const TriangleTree& tree,
  const PointList& points, const TriangleList& triangles, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

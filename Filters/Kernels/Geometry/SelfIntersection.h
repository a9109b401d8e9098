/**
 * Self-intersections of a triangulated surface, decided exactly: the pairs of triangles whose
 * intersection is more than the vertex or edge they share. A surface without any is embedded.
 */
#ifndef FlipFreeSelfIntersection_h
#define FlipFreeSelfIntersection_h

#include "Geometry/TriangleTree.h"

namespace FlipFree
{

/// The sorted pairs, each with the lower index first. Points must be finite. Degenerate triangles
/// are reported together with their neighbors.
std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const TriangleList& triangles);

/// The same with a tree that was built for these triangles (at any positions), perhaps threaded.
std::vector<std::pair<int, int>> FindSelfIntersections(const TriangleTree& tree,
  const PointList& points, const TriangleList& triangles, const ParallelFor& parallelFor);

/// How many pairs.
std::ptrdiff_t CountSelfIntersections(const PointList& points, const TriangleList& triangles);

} // namespace FlipFree

#endif

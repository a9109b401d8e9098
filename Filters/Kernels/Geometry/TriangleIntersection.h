/**
 * Exact intersection test of two triangles of a surface.
 */
#ifndef FlipFreeTriangleIntersection_h
#define FlipFreeTriangleIntersection_h

#include "KernelTypes.h"

namespace FlipFree
{

/// True when the two triangles (rows of `triangles`) have a common point that is not on the vertex
/// or edge they share; touching counts. A degenerate triangle intersects all triangles that share a
/// vertex with it, and all degenerate triangles whose bounding boxes touch its own.
bool TrianglesIntersect(const PointList& points, const TriangleList& triangles, int one, int two);

} // namespace FlipFree

#endif

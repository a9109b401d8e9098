/**
 * Do two triangles of a surface meet where they must not? Exact for any coordinates.
 */
#ifndef FlipFreeTriangleIntersection_h
#define FlipFreeTriangleIntersection_h

#include "KernelTypes.h"

namespace FlipFree
{

/// True when the two triangles (rows of `triangles`) have a point in common that is not on the
/// vertex or edge they share; touching counts. Triangles without area intersect everything that
/// they share a vertex or, if that is without area too, a bounding box with.
bool TrianglesIntersect(const PointList& points, const TriangleList& triangles, int one, int two);

} // namespace FlipFree

#endif

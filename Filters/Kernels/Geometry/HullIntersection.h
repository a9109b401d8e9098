/**
 * Exact intersection test of two parts of a surface.
 */
#ifndef FlipFreeHullIntersection_h
#define FlipFreeHullIntersection_h

#include "Geometry/FaceHulls.h"

namespace FlipFree
{

/// True if a triangle of three vertices of one hull has a common point with one of the other;
/// touching counts. Sets of one or two vertices are a point and a segment. The hulls have no common
/// vertex.
bool HullsMeet(const PointList& points, const Hull& one, const Hull& two);

} // namespace FlipFree

#endif

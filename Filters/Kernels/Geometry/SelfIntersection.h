/**
 * Self-intersections of a polygonal surface, decided exactly, for all ways to cut its faces into
 * triangles (FaceHulls.h). A surface without any is embedded however it is cut.
 */
#ifndef FlipFreeSelfIntersection_h
#define FlipFreeSelfIntersection_h

#include "Geometry/FaceHulls.h"

namespace FlipFree
{

/// The sorted pairs of faces, each with the lower index first, that some cuts make intersect in
/// more than the vertex or edge they share; touching counts, and so do faces that overlap
/// (FaceHulls.h). A face whose own triangles may overlap is paired with itself. Points must be
/// finite and indices valid. Degenerate triangles are reported together with their neighbors.
std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceList& faces, const ParallelFor& parallelFor = SerialFor);

/// The same with the hulls of these faces.
std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const FaceHulls& hulls, const ParallelFor& parallelFor = SerialFor);

/// How many pairs.
std::ptrdiff_t CountSelfIntersections(const PointList& points, const FaceList& faces,
  const ParallelFor& parallelFor = SerialFor);

/// Whether two disjoint hulls, or two of the given parts of adjacent faces, meet of which all
/// vertices are marked: one flag per point.
bool MarkedHullsMeet(const PointList& points, const FaceHulls& hulls,
  const std::vector<HullPair>& adjacent, const std::vector<char>& marked,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

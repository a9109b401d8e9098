/**
 * Vertex normals of a deforming surface, and vertex fields smoothed over neighbors.
 */
#ifndef FlipFreeSurfaceNormals_h
#define FlipFreeSurfaceNormals_h

#include "Mesh/ContourMesh.h"

namespace FlipFree
{

/// Outward unit normals, the area-weighted mean of the triangles around each vertex, then averaged
/// `smoothing` times with those of the four neighbors, so that search lines do not follow every
/// wrinkle. A vertex whose triangles have no area gets its neighbors' mean, or +z at the worst.
PointList VertexNormals(const ContourMesh& mesh, const Eigen::Ref<const PointList>& points,
  int smoothing);

} // namespace FlipFree

#endif

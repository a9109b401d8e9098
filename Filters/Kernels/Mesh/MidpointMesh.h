/**
 * How any closed mesh becomes one that FlipFree can deform: the midpoints of its edges, joined
 * around each face and around each vertex, form a closed mesh in which every vertex has four
 * neighbors (the medial graph).
 *
 * Around each face it lies in the face, if that is flat; at each vertex it cuts the corner off, at
 * half the length of the edges. The finer the mesh, the nearer it is to its midpoint mesh.
 */
#ifndef FlipFreeMidpointMesh_h
#define FlipFreeMidpointMesh_h

#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

struct PolygonMesh
{
  PointList Points;
  FaceList Faces;
};

/// The midpoint mesh: first a face per face, then one per vertex that a face uses. The faces must
/// be valid (RequireValidFaces). Throws Error, naming the mesh by `name` and the first bad edge or
/// vertex, unless it is a closed and consistently oriented 2-manifold.
PolygonMesh MakeMidpointMesh(const PolygonMesh& mesh, const std::string& name);

/// The same surface with each triangle of Triangulate() cut into four at the midpoints of its
/// edges.
PolygonMesh SplitTriangles(const PolygonMesh& mesh);

/// Without points that no face uses.
PolygonMesh WithoutUnusedPoints(const PolygonMesh& mesh);

} // namespace FlipFree

#endif

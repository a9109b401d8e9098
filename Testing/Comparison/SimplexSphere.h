/**
 * Simplex meshes, whose vertices have three neighbors each, as the duals of triangulated surfaces.
 */
#ifndef FlipFreeSimplexSphere_h
#define FlipFreeSimplexSphere_h

#include "KernelTypes.h"

#include <array>
#include <vector>

namespace FlipFree
{

struct SimplexMesh
{
  PointList Points;

  /// Per vertex, counter-clockwise seen from outside.
  std::vector<std::array<int, 3>> Neighbors;

  /// Each face cut into triangles around a point in its middle. That point comes first, and is the
  /// number of vertices plus that of the face.
  TriangleList Triangles;
  int Faces = 0;
};

/// The dual of a quad sphere with n x n vertices along its sides, whose quads are halved: a vertex
/// per triangle, 12 n^2 - 4 altogether, on the sphere, and a face per vertex, most of them
/// hexagons.
SimplexMesh MakeSimplexSphere(int n, const Eigen::Vector3d& center, double radius);

/// The points of the mesh's triangles when its vertices lie elsewhere: these, and then the middles
/// of the faces.
PointList SurfacePoints(const SimplexMesh& mesh, const PointList& vertices);

} // namespace FlipFree

#endif

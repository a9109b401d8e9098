/**
 * The connectivity of a closed mesh whose vertices all have four neighbors, and its contours.
 *
 * At each vertex a contour goes straight on: it leaves along the edge opposite to the one by which
 * it arrived. The contours thus follow from the faces alone. Every vertex lies on two of them (or
 * twice on one), as in section 3.1 of the paper, where they are plane curves of a sphere.
 */
#ifndef FlipFreeContourMesh_h
#define FlipFreeContourMesh_h

#include "KernelTypes.h"

#include <string>
#include <vector>

namespace FlipFree
{

/// Cuts every polygon into triangles that share its first vertex. Surfaces are measured and
/// voxelized by this triangulation.
TriangleList Triangulate(const FaceList& faces);

/// Faces of more than four corners cut in the same way, all others as they are: for whoever writes,
/// draws or cuts the surface with other software. Where a face of five corners or more is bent, the
/// ear cutting of VTK and others gives up without a word, and leaves a hole.
FaceList CutLargeFaces(const FaceList& faces);

struct ContourMesh
{
  FaceList Faces;

  /// The neighbors of each vertex, counter-clockwise seen from outside. Entries 0 and 2 belong to
  /// one contour, 1 and 3 to the other.
  std::vector<std::array<int, 4>> Neighbors;

  /// Each contour once, as the cyclic sequence of its vertices.
  std::vector<std::vector<int>> Contours;

  /// The faces, each quad cut along one fixed diagonal.
  TriangleList Triangles;

  int NumberOfPoints() const { return static_cast<int>(this->Neighbors.size()); }

  /// Euler number V - E + F of the closed mesh; 2 for a sphere.
  int EulerNumber() const;
};

/// The same of any closed mesh that stays as it is: `Neighbors` has four of each vertex, one of
/// them twice where there are three, and there are no contours. The faces must be valid, and each
/// point be used by one.
ContourMesh BuildMeshAtRest(int numberOfPoints, const FaceList& faces);

/// Builds the connectivity. Throws Error, naming the first bad vertex or face, unless the mesh is
/// closed and oriented and every vertex has exactly four neighbors.
ContourMesh BuildContourMesh(int numberOfPoints, const FaceList& faces);

} // namespace FlipFree

#endif

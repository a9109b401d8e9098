/**
 * The paper's start mesh (section 3.1, Fig. 1a, b): a cube with n x n vertices at the cell centers
 * of each side, optionally projected onto a sphere.
 */
#ifndef FlipFreeQuadSphere_h
#define FlipFreeQuadSphere_h

#include "Mesh/ContourMesh.h"

namespace FlipFree
{

enum class QuadSphereSpacing
{
  Equiangular, ///< equal angles between the planes of a contour group: even cells
  Radial,      ///< the paper's: equal steps on the cube, projected along the radius
  Cube         ///< not projected: a cube of edge length two radii
};

struct QuadSphere
{
  PointList Points;
  FaceList Faces; ///< 6 n^2 - 6 quads and 8 triangles, one where three sides meet

  /// Side of the cube (0 to 5: -x, +x, -y, +y, -z, +z) and the cell (u, v) within it, per vertex.
  std::vector<std::array<int, 3>> Cells;
};

/// n >= 1 vertices along a side's edge; 6 n^2 vertices altogether.
QuadSphere MakeQuadSphere(int n, const Eigen::Vector3d& center, double radius,
  QuadSphereSpacing spacing);

/// Per vertex 0 or 1, by turns in fields of 4 x 4 cells on each side: shows on a surface that has
/// grown from the sphere where its parts come from.
std::vector<unsigned char> CheckerboardOf(const QuadSphere& sphere);

} // namespace FlipFree

#endif

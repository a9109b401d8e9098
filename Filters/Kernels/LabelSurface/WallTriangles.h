/**
 * Walls as triangles, cut so that they do not intersect.
 *
 * Claim: if each vertex in a cell lies inside of that cell, and all others inside of the edge,
 * triangle or tetrahedron where they were made, then walls cut by CutWalls() meet only in common
 * vertices and edges, and each voxel center is on the side of its own label.
 *
 * Proof: two cells with a side in common are a convex box together, so that the line between their
 * vertices crosses that side. So the tetrahedra of two neighboring voxel centers and the vertices
 * of two neighboring cells around these have the orientation that they have where all vertices are
 * in the centers of their cells, and each side is divided by that crossing into one triangle for
 * each of its edges: as there, the tetrahedra are a subdivision of space. (Cells without a vertex,
 * or with a label, count with their center.) Walls in one tetrahedron around a cell with a label
 * are plane pieces between points on its edges and inside of its faces, which do not leave it.
 *
 * A wall of four corners, cut along a diagonal, lies in the four tetrahedra around the edge between
 * its two voxel centers if both triangles have these on either side of their planes. The diagonal
 * passes the edge on one side, and there crosses the triangle of the edge and the corner in
 * between: as the plane of the diagonal and this corner separates the two centers, the crossing is
 * between the lines from the corner to them. The other triangle meets the edge between the centers.
 * So the triangles of the edge and one corner each cut the wall into pieces, each with all its
 * corners in one tetrahedron, which is convex. If neither diagonal will do, a vertex on the edge
 * makes four triangles, one in each tetrahedron. So the edge between two neighboring centers meets
 * the walls once if their labels differ, and not at all if they do not.
 *
 * Positions are tested as single precision holds them, and CellBound keeps them inside.
 */
#ifndef FlipFreeWallTriangles_h
#define FlipFreeWallTriangles_h

#include "LabelSurface/GridFrame.h"
#include "LabelSurface/LabelMeasures.h"
#include "LabelSurface/WallRelaxation.h"

namespace FlipFree
{

/// How far vertices may be from the center of their cell along each axis, in voxels.
constexpr double CellBound = 0.49;

/// The vertices and, after them, those that cut the edge between two voxels, in the grid's indices,
/// where single precision can hold them. Without a frame, they are not rounded, and all walls are
/// cut alike, whether they intersect then or not.
SharedWalls CutWalls(const LabelWalls& walls, const LabelCells& cells,
  const Displacements& displacements, const GridFrame* frame, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The surface of a set of cells of a grid as a mesh whose vertices all have four neighbors: a
 * vertex at the center of each side that a cell does not share with another cell of the set, joined
 * to those across the four edges of that side; and a face around each corner. For a cube of n x n x
 * n cells it is the paper's cube (section 3.1), and its contours are those of slices through the
 * cells. So any shape has such a start surface: a tube that bends sharply, or the tree of a
 * vessel's branches.
 *
 * No two faces overlap (Geometry/FaceHulls.h). Proof: what the faces around the corners c and d
 * share are the sides that have both. If c and d lie across a side, it is the only one. If an edge
 * joins them, two sides of the surface meet there, neighbors around c and around d.
 */
#ifndef FlipFreeCellSurface_h
#define FlipFreeCellSurface_h

#include "Image/BitMask.h"

#include <vector>

namespace FlipFree
{

/// The part of a set that grows from one of its cells, deepest first, by cells that touch what is
/// there in a disk: it has neither holes nor handles, and its surface is a sphere. `depth` has a
/// value for each cell of the grid. Gaps between parts that may not meet are a cell wide.
BitMask GrowBall(const BitMask& cells, const std::vector<float>& depth, std::size_t start);

struct CellSurface
{
  PointList Points;
  FaceList Faces;
};

/// The surface of a set of cells that touch each other in sides, not just in edges or corners, as
/// GrowBall() makes it. Cell (i, j, k) is centered at that place of the mask's grid.
CellSurface MakeCellSurface(const BitMask& cells);

} // namespace FlipFree

#endif

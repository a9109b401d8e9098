/**
 * The cells between the voxel centers of a label map, those of eight centers whose labels differ,
 * and what the walls between the labels do in each.
 *
 * The rule: a cell is *simple* if, for each of its labels, the corners that have the label and the
 * corners that do not are both connected along the edges of the cell. Then all walls of the cell
 * meet in one vertex. In other cells, labels touch only by an edge or a corner, or the walls of one
 * label pass twice. Such a cell gets a *label of its own*, as if there were a small voxel at its
 * center: the most frequent one of its corners, and of several background, or else that of the
 * first corner. So labels that touch by an edge are joined if most voxels around are theirs, and
 * apart if not, whatever their values. Background counts as a label, so that all labels together
 * have a manifold surface as well.
 *
 * A simple cell gets a label, too, if the cell across a side has one that no corner of this side
 * has. It has to be asked again for the cells next to it; the set of cells is the least one that
 * the rule allows, in whichever order they are asked.
 *
 * Claim: with this rule, the walls that LabelWalls makes bound each label by a closed 2-manifold.
 *
 * Proof: corners and centers of the cells are the vertices of a subdivision of space into
 * tetrahedra, each of two neighboring corners and two neighboring centers. First, let all of them
 * have labels. Walls are dual to the edges between different labels, so the region of a label is a
 * regular neighborhood of the simplices whose vertices all have the label, and its boundary is a
 * 2-manifold. Now the centers of simple cells have no label, but lie on the walls. In a tetrahedron
 * the walls are then cones over the walls in the part that has labels. So only the vertices without
 * a label have to be looked at, and there, the link: the surface of the cell, and beyond its sides
 * the centers of its neighbors, those without labels on the walls. By the rule, no side has a label
 * only at two opposite corners: a path between these along edges, and the diagonal, would separate
 * the other two, which are not connected then, or do not differ from it. So a label that a corner
 * has is found in one region of the link, whose complement is one region, and so is its boundary
 * one simple curve, through the centers of sides where these are on the walls. A center with a
 * label joins the corners of the side that have it, which are next to each other, and there is one
 * (the second rule), so that the region remains one, and so does its complement. A cone over one
 * simple curve is a disk.
 */
#ifndef FlipFreeLabelCells_h
#define FlipFreeLabelCells_h

#include "LabelSurface/LabelGrid.h"
#include "LabelSurface/SparseGrid.h"

namespace FlipFree
{

/// Bit c of a mask is corner (c & 1, c >> 1 & 1, c >> 2). Whether the corners in the mask and those
/// not in it are both connected along the edges of the cube.
bool IsSimple(unsigned char corners);

struct LabelCells
{
  /// Of a cell whose walls meet at its vertex.
  static constexpr int OnWalls = -1;

  LabelCells(const LabelGrid& grid, const ParallelFor& parallelFor);

  /// Sides are numbered 2 * axis + (1 if it is the upper one).
  int Neighbor(int cell, int side) const
  {
    std::array<int, 3> place = this->Grid.PlaceOf(cell);
    place[side / 2] += side % 2 == 0 ? -1 : 1;
    return this->Grid.Find(place[0], place[1], place[2]);
  }

  SparseGrid Grid;         ///< cell (i, j, k) has the voxels (i, j, k) to (i + 1, j + 1, k + 1)
  std::vector<int> Labels; ///< of the cells' centers, or OnWalls
};

} // namespace FlipFree

#endif

/**
 * Walls of fewer triangles: edges are collapsed, one end of each onto the other, as long as that is
 * certified.
 *
 * A collapse is allowed if the walls stay what they are, and none meets another:
 *
 *   - What is connected stays so: the edge passes the link condition of 2-complexes (T. Dey,
 *     H. Edelsbrunner, S. Guha and D. Nekhayev, Topology preserving edge contraction, 1999).
 *     Vertices of the curves where three walls meet move along these alone, and their ends stay.
 *   - The tetrahedra between the triangles that move, and where they move to, meet no other
 * triangle but in common vertices and edges, nor do the new triangles each other; decided exactly
 * for the positions that files hold. So what a wall sweeps over is empty, and no wall passes
 * another.
 *   - Normals turn by less than a right angle, and no triangle becomes a needle.
 *   - Each vertex that has gone is within the tolerance of the triangles in its place, and the
 *     middles of these and of their edges are within it of the walls before.
 *   - If voxels are to stay, no voxel center is in the tetrahedra: whatever a wall sweeps over
 *     changes sides, so none does.
 *
 * The cheapest collapse is the first, by quadrics (M. Garland and P. Heckbert, Surface
 * simplification using quadric error metrics, 1997).
 */
#ifndef FlipFreeWallCollapse_h
#define FlipFreeWallCollapse_h

#include "LabelSurface/LabelMeasures.h"

namespace FlipFree
{

struct CollapseSettings
{
  double EdgeLength = 0;   ///< mm; no edge becomes longer. 0: of any length
  int Triangles = 0;       ///< no fewer than this many
  double Tolerance = 0;    ///< mm
  bool KeepVoxels = false; ///< no voxel center changes sides
};

/// Collapses edges of walls in millimeters. `indices` are their points in the grid's indices, where
/// voxel centers are whole numbers; it keeps the same rows as the walls' points. Returns false if
/// the monitor stopped it; the walls are then somewhere on the way.
bool CollapseWalls(const CollapseSettings& settings, const Monitor& monitor, SharedWalls& walls,
  PointList& indices);

/// The greatest distance, in millimeters, of the vertices before from the walls after, and of the
/// middles of edges and triangles after, whose vertices are some of those before, from the walls
/// before.
double CollapseDistance(const SharedWalls& before, const SharedWalls& after,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

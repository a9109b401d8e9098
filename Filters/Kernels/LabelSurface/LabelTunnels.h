/**
 * Tunnels through labels, closed where they are narrow.
 *
 * Each part of a label that is connected across faces of voxels is seen alone. From the box around
 * it, voxels outside of the part are taken away, those farthest from it first, as long as each
 * leaves connected what was, and opens no tunnel and no cavity. What remains beside the part is a
 * sheet of voxels across each tunnel, where it is narrow, and the part's cavities (Z. Aktouf, G.
 * Bertrand, L. Perroton: A three-dimensional holes closing algorithm, Pattern Recognition Letters
 * 23, 2002). A sheet takes the part's label if it is not too wide, consists of background,
 * touches no other part of the label, which it would join, and closes a tunnel of the label's
 * surface, too, which has fewer of them where voxels touch by an edge (LabelCells.h). So another
 * label that runs through a tunnel keeps its way. Where sheets of two parts overlap, the first part
 * in the order of its voxels has its own.
 */
#ifndef FlipFreeLabelTunnels_h
#define FlipFreeLabelTunnels_h

#include "LabelSurface/LabelGrid.h"

namespace FlipFree
{

/// Closes the tunnels through which no ball of the diameter `width` passes, to a voxel along each
/// axis; `spacing` is the voxels', both in millimeters, and the axes count as if they were at right
/// angles. Returns false, and the grid is meaningless, if the monitor stopped it.
bool CloseTunnels(LabelGrid& grid, const Eigen::Vector3d& spacing, double width,
  const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

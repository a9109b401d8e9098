/**
 * Tunnels through labels, closed where they are narrow.
 *
 * Each part of a label (LabelParts.h) is seen alone. From the box around it, voxels outside of the
 * part are taken away, those farthest from it first, as long as each leaves connected what was, and
 * opens no tunnel and no cavity. What remains beside the part is a sheet of voxels across each
 * tunnel, where it is narrow, and the part's cavities (Z. Aktouf, G. Bertrand, L. Perroton: A
 * three-dimensional holes closing algorithm, Pattern Recognition Letters 23, 2002). Sheets that are
 * not too wide and consist of background take the part's label. So another organ that runs through
 * a label keeps its way.
 *
 * The part counts as connected across faces of voxels, and what is around it across edges and
 * corners as well. On a sheared grid the angles between the axes are ignored.
 */
#ifndef FlipFreeLabelTunnels_h
#define FlipFreeLabelTunnels_h

#include "LabelSurface/LabelGrid.h"

namespace FlipFree
{

/// The grid, its labels by the same indices, with the tunnels closed through which no ball of the
/// diameter `width` passes, to a voxel; `spacing` is the voxels', both in millimeters. Returns
/// false, and the grid is meaningless, if the monitor stopped it.
bool CloseTunnels(LabelGrid& grid, const Eigen::Vector3d& spacing, double width,
  const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

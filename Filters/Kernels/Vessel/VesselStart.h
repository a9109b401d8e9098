/**
 * The start surface of any tree of vessels: the outer faces of the cells of a grid, a ball within
 * its outline.
 */
#ifndef FlipFreeVesselStart_h
#define FlipFreeVesselStart_h

#include "Deformation/StartSurface.h"
#include "Vessel/VesselTree.h"

namespace FlipFree
{

/// A coarse surface within the outline, of one piece and without handles. Its cells are finer where
/// otherwise one of them would hold both the path and a point outside. Throws Error, naming the
/// point, where it lies on the path all the same.
DeformableSurface MakeStart(const VesselTree& tree, const PointList& outside,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * The deformation of a vessel's start surface onto its outline, from coarse to fine, under the
 * guard.
 */
#ifndef FlipFreeOutlineFit_h
#define FlipFreeOutlineFit_h

#include "Vessel/VesselSegmentation.h"

namespace FlipFree
{

/// `spacing`: the image's finest, mm. The reason is Aborted where the monitor stopped it.
OrganSurface FitToOutline(const VesselTree& tree, const DeformableSurface& start,
  const ConstraintList& constraints, double spacing, const VesselSegmentationSettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

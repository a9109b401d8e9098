/**
 * The deformation of a vessel's start surface onto its outline, from coarse to fine, under the
 * guard.
 */
#ifndef FlipFreeOutlineFit_h
#define FlipFreeOutlineFit_h

#include "Vessel/VesselSegmentation.h"

namespace FlipFree
{

/// `spacing`: the image's finest, mm. Deforms the surface of the result, and adds its iterations.
StopReason FitToOutline(const VesselTree& tree, const ConstraintList& constraints, double spacing,
  const VesselSegmentationSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, OrganSurface& surface);

} // namespace FlipFree

#endif

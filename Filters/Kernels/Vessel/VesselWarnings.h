/**
 * What may be wrong with a vessel, for its user to look at: a message each, with its remedy.
 */
#ifndef FlipFreeVesselWarnings_h
#define FlipFreeVesselWarnings_h

#include "Vessel/VesselSegmentation.h"

namespace FlipFree
{

/// `points`: as the user gave them. `doubtful`: a vessel of less confidence is.
void AddWarnings(const ImageGeometry& geometry, const PointList& points, double doubtful,
  VesselSegmentation& result);

} // namespace FlipFree

#endif

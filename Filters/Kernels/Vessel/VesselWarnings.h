/**
 * What may be wrong with a vessel, for its user to look at: a message each, with its remedy.
 */
#ifndef FlipFreeVesselWarnings_h
#define FlipFreeVesselWarnings_h

#include "Vessel/VesselSegmentation.h"

namespace FlipFree
{

/// `points`: as the user gave them.
void AddWarnings(const ImageGeometry& geometry, const PointList& points,
  VesselSegmentation& result);

} // namespace FlipFree

#endif

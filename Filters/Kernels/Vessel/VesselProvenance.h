/**
 * Where a vessel's surface comes from (Deformation/Provenance.h).
 */
#ifndef FlipFreeVesselProvenance_h
#define FlipFreeVesselProvenance_h

#include "Vessel/VesselSegmentation.h"

#include <string>

namespace FlipFree
{

/// The order of the points is kept: the first begins the tree.
std::string ProvenanceOf(const PointList& points, const ConstraintList& constraints,
  const VesselSegmentationSettings& settings, const ImageGeometry& geometry);

} // namespace FlipFree

#endif

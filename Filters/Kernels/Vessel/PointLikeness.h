/**
 * Whether the points that a vessel is clicked by look like it: a click beside it, in tissue that
 * touches it, still joins the others, and nothing else tells.
 */
#ifndef FlipFreePointLikeness_h
#define FlipFreePointLikeness_h

#include "Vessel/VesselTree.h"

namespace FlipFree
{

/// Which points are unlike the vessel: the gray value around one is clearly beyond those along the
/// center of the vessel nearby, but not at the point itself.
std::vector<int> PointsUnlike(const ImageView<float>& image, const VesselTree& tree,
  const PointList& points);

} // namespace FlipFree

#endif

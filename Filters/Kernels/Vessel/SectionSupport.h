/**
 * How well an image supports a vessel's outline: along a path that has strayed into an organ, what
 * lies outside the outline is as bright as what lies inside.
 */
#ifndef FlipFreeSectionSupport_h
#define FlipFreeSectionSupport_h

#include "Vessel/CrossSections.h"

namespace FlipFree
{

/// Per section the mean contrast across the outline, of 25 gray values (HU; MR scaled to CT): over
/// its rays, the difference between inside and outside, 0 to 1, where 1 is that much or more.
Eigen::VectorXd SectionSupport(const ImageView<float>& image, const VesselSections& sections,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

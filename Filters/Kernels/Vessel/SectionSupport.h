/**
 * How well an image supports a vessel's outline: along a path that has strayed into an organ, what
 * lies outside the outline is as bright as what lies inside.
 */
#ifndef FlipFreeSectionSupport_h
#define FlipFreeSectionSupport_h

#include "Vessel/CrossSections.h"

namespace FlipFree
{

/// Per section the part of its rays across whose end the gray value changes by more than noise
/// does, 0 to 1.
Eigen::VectorXd SectionSupport(const ImageView<float>& image, const VesselSections& sections,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

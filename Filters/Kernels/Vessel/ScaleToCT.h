/**
 * Gray values in any unit, as those of MR, on about the scale of Hounsfield units, which the
 * settings of vessels are made for.
 */
#ifndef FlipFreeScaleToCT_h
#define FlipFreeScaleToCT_h

#include "Image/SeedRegion.h"

namespace FlipFree
{

/// Most of the gray values span what they do in CT then; those without data stay so, but a point's
/// voxel has data. In the image a thin vessel may be so few
/// voxels that only its points tell of its contrast.
void ScaleToCT(const PointList& points, FloatImage& image);

} // namespace FlipFree

#endif

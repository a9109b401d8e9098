/**
 * How well an image supports a mask, judged without a reference: by the contrast that nearly all of
 * the mask's boundary has, and by its compactness. It tells masks of the same organ apart; its
 * value alone means nothing.
 */
#ifndef FlipFreeBoundarySupport_h
#define FlipFreeBoundarySupport_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

/// The contrast that all but a tenth of the boundary has at least, between what lies 2 to 6 mm
/// inside and as far outside along the normal, times the cube root of the isoperimetric quotient.
/// `leastContrast` counts in place of anything lower. Zero for a mask without voxels. The mask is
/// on the grid of the image; what lies beyond the image does not count.
double BoundarySupport(const ImageView<float>& image, const BitMask& mask, double leastContrast);

/// Less than this does not count as contrast: a tenth of the standard deviation of the gray values
/// in a seed, or of half of the noise. `noise` is the standard deviation before smoothing.
double LeastContrastAround(const ImageView<float>& image, const SeedSphere& seed, double noise);

} // namespace FlipFree

#endif

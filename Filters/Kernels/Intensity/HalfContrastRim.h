/**
 * Moves the boundary of an organ's mask to where the gray value is half-way between the organ's,
 * there, and its surroundings', there: where a boundary is blurred, that is where it lies.
 */
#ifndef FlipFreeHalfContrastRim_h
#define FlipFreeHalfContrastRim_h

#include "Intensity/NeckCarving.h"

namespace FlipFree
{

/// Grows the mask, which is on the grid of the part, by its rim. Returns false if the monitor
/// stopped it; the mask is then useless.
bool GrowRim(const ImagePart& image, double noise, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& mask);

/// How far outside the mask the image is read by that many calls, in voxels.
std::array<int, 3> RimReachOf(const ImageGeometry& geometry, int calls);

} // namespace FlipFree

#endif

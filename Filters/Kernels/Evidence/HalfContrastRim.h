/**
 * Moves the boundary of an organ's mask outward to where the gray value is halfway between the
 * local gray values of the organ and of its surroundings: this is where a blurred boundary lies. In
 * CT, the organ's value is that of its outer layer of 8 mm: of a kidney's cortex, not its medulla.
 * An interval of gray values ends where the blur begins.
 */
#ifndef FlipFreeHalfContrastRim_h
#define FlipFreeHalfContrastRim_h

#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// Grows the mask, which is on the grid of the part, by its rim: at most 3 mm, and where slices are
/// thicker, two slices up and down. `noise` is the standard deviation before smoothing. A mask
/// without voxels deeper than 2 mm stays as it is. Returns false if the monitor, asked before each
/// pass over the mask, stopped it; the mask is then useless.
bool GrowRim(const ImagePart& image, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask);

/// How far outside the mask the image is read by that many calls, in voxels. Blocks, of which the
/// surroundings consist, may go on for a few millimeters; what the part does not hold of them does
/// not count.
std::array<int, 3> RimReachOf(const ImageGeometry& geometry, int calls);

} // namespace FlipFree

#endif

/**
 * Removes from a mask the parts that are attached to the organ by a neck. A minimum cut inside the
 * mask separates the seed from the cores of the parts behind necks (Y. Boykov, G. Funka-Lea: Graph
 * cuts and efficient N-D image segmentation, 2006). The cut finds the organ's end, along edges and
 * with the smallest area. Gray values alone hardly count: a leak looks like the organ.
 */
#ifndef FlipFreeNeckCarving_h
#define FlipFreeNeckCarving_h

#include "Image/BitMask.h"
#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// Adds the seed sphere to the mask, which is on the grid of the part, fills its holes, and carves
/// it. The seed's inner part is always kept. The cut is found on blocks of at most 2.5 mm.
/// `noise` is the standard deviation before smoothing. Returns false if the monitor stopped it; the
/// mask is then useless.
bool CarveNecks(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask);

} // namespace FlipFree

#endif

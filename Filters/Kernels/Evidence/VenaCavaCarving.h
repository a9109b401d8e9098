/**
 * Carves the inferior vena cava out of a liver in CT. The vein runs along the liver's border, is
 * as bright, or nearly so, and often no edge lies between the two; but it is round, and above and
 * below the liver it stands alone.
 */
#ifndef FlipFreeVenaCavaCarving_h
#define FlipFreeVenaCavaCarving_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Image/SmoothRegion.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// Removes the vein from the mask, which is on the grid of the image, if there is one. It is sought
/// in CT with slices of at most 12 mm, for any organ of 0.7 l or more, along the body's axis, left
/// of the organ's center, in what the mask holds, by the best chain of disks, one for each slice,
/// that are brighter than what is around them. It is taken for the vein where it stands alone below
/// or above the organ and holds no voxel of the seed sphere; and it stays where
/// more than half its volume would be lost with it. `make` is called before voxels of the image are
/// read. Returns false if it or the monitor stopped the work; the mask is then useless.
bool CarveVenaCava(const ImageView<float>& smooth, const ImageMaker& make, const SeedSphere& seed,
  Modality modality, const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask);

} // namespace FlipFree

#endif

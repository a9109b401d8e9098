/**
 * A mask from elsewhere (a network, an atlas, an earlier result) in place of the foreground that is
 * found in the image, and the ball in it that stands for a seed.
 */
#ifndef FlipFreeStartMask_h
#define FlipFreeStartMask_h

#include "Image/BitMask.h"
#include "Image/LabelValues.h"
#include "Image/SeedRegion.h"

#include <string>

namespace FlipFree
{

/// A label, on the grid of an image.
struct StartMask
{
  BitMask Voxels;
  double Outside = 0; ///< which fraction of the label lies outside the image
};

/// The voxels of a label; 0 stands for all nonzero voxels. Throws Error, naming the label map,
/// unless its voxels are those of the image, which is named by `nameOfImage`, up to cropping and
/// the order of axes (LatticePlacement.h), all are finite numbers, and some in the image have the
/// label.
StartMask StartMaskOf(const LabelVolume& labels, int label, const ImageGeometry& image,
  const std::string& nameOfImage);

/// The largest ball that the mask holds, up to the nearest voxel center outside it, and within
/// the image; but no smaller than a voxel. Of several, the first in the order of the voxels.
SeedSphere LargestBallIn(const BitMask& mask, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

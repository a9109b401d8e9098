/**
 * A mask from elsewhere (a network, an atlas, an earlier result) in place of the foreground that is
 * found in the image: where to start a surface that fills it, and how much of it a single connected
 * surface can fill.
 */
#ifndef FlipFreeStartMask_h
#define FlipFreeStartMask_h

#include "Image/BitMask.h"
#include "Image/LabelValues.h"
#include "Image/SeedRegion.h"
#include "Mesh/SurfaceVoxelization.h"

#include <string>
#include <vector>

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
/// the image. Of several, the first in the order of the voxels. Throws Error, naming the
/// mask by `name`, where it is nowhere thicker than two voxels.
SeedSphere LargestBallIn(const BitMask& mask, const std::string& name,
  const ParallelFor& parallelFor);

/// The part of the mask that is connected, by faces, with the voxels of the seed; its holes are
/// filled, since a surface without handles cannot have them.
BitMask PieceOf(BitMask mask, const SeedSphere& seed);

/// Which fraction of the mask's voxels is not among those of the surface, 0 to 1. No two runs
/// overlap.
double FractionMissed(const BitMask& mask, const std::vector<VoxelRun>& voxels);

} // namespace FlipFree

#endif

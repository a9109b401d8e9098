/**
 * A part of an image as floats, by the reader of its voxels.
 */
#ifndef FlipFreeBoxReading_h
#define FlipFreeBoxReading_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

/// The slices first <= k < last of a box, into voxels that lie as the whole box's do.
void ReadSlices(const VoxelReader& read, const VoxelBox& box, std::ptrdiff_t first,
  std::ptrdiff_t last, float* voxels);

/// The voxels of the image within a box.
FloatImage ReadBox(const VoxelReader& read, const ImageGeometry& geometry, const VoxelBox& box,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

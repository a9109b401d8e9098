/**
 * A part of an image as floats, by the reader of its voxels.
 */
#ifndef FlipFreeBoxReading_h
#define FlipFreeBoxReading_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

/// The voxels of the image within a box.
FloatImage ReadBox(const VoxelReader& read, const ImageGeometry& geometry, const VoxelBox& box,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * How steep an image typically is, which tells edges from noise.
 */
#ifndef FlipFreeGradientScale_h
#define FlipFreeGradientScale_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"
#include "Image/SliceParts.h"

namespace FlipFree
{

/// Root mean square of the gradient's magnitude over the voxels of `box` whose centers lie in
/// the sphere, of infinite radius for all, by central differences that see no gradient across the
/// border of the image, as ITK's do. 0 if there is no such voxel. `read` reads from the image's
/// first voxel on. Returns false if the monitor stopped it.
bool MeasureGradientScale(const VoxelReader& read, const ImageGeometry& image, const VoxelBox& box,
  const SeedSphere& sphere, const Threading& threading, const Monitor& monitor, double& scale);

} // namespace FlipFree

#endif

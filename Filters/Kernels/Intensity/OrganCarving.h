/**
 * From the inside of a surface that has found its organ, more or less, to the organ's foreground:
 * parts attached by a neck are carved away, then the boundary moves to half the local contrast;
 * both are done twice. Carving comes first, since a rim on a leak deepens the leak. Finally, in CT,
 * the fat in hollows is removed.
 */
#ifndef FlipFreeOrganCarving_h
#define FlipFreeOrganCarving_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"
#include "Mesh/SurfaceVoxelization.h"

namespace FlipFree
{

/// The part of the image that CarveOrgan() reads: the surface, the seed, and their surroundings.
VoxelBox CarvingBox(const ImageGeometry& geometry, const std::vector<VoxelRun>& inside,
  const SeedSphere& seed);

/// The foreground from the voxels inside a surface, which may be none. Only the voxels in
/// CarvingBox() need to have values. `noise` is the standard deviation before smoothing; the
/// modality is not Automatic. Returns false if the monitor, asked before each pass over the image,
/// stopped it; `foreground` is then as it was.
bool CarveOrgan(const ImageView<float>& smooth, const std::vector<VoxelRun>& inside,
  const SeedSphere& seed, double noise, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground);

/// The radius of a ball of the foreground's volume, but never less than the seed's: a seed that is
/// small in its organ says too little of how long search lines have to be.
double RadiusOf(const BitMask& foreground, const SeedSphere& seed);

} // namespace FlipFree

#endif

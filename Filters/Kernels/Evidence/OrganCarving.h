/**
 * From all that may be the organ to the organ's foreground: parts attached by a neck are cut off
 * (OrganCut.h), then the boundary moves to half the local contrast; where the first cut makes the
 * candidate smaller by 2 % or more, both are done twice. Carving comes first, since a rim on a leak
 * deepens the leak. Finally, in CT, the fat in hollows is removed.
 */
#ifndef FlipFreeOrganCarving_h
#define FlipFreeOrganCarving_h

#include "Evidence/DoubtfulPart.h"
#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

#include <vector>

namespace FlipFree
{

/// How sure a carved foreground is.
struct CarvingReport
{
  double Unanimity = 1; ///< of the opinions (OrganConsensus.h); 1 where no further one was sought
  std::vector<DoubtfulPart> Doubts;
};

/// The part of the image that CarveOrgan() reads: the candidate, the seed, and their surroundings.
VoxelBox CarvingBox(const BitMask& candidate, const SeedSphere& seed);

/// The foreground from all that may be the organ, a mask on the grid of the image, which may be
/// empty. `supported`, if not null, is what of it there is more evidence for. Only the voxels in
/// CarvingBox() need to have values. `noise` is the standard deviation before smoothing; the
/// modality is not Automatic. Doubts are appended, unless `doubts` is null. Returns false if the
/// monitor, asked before each pass over the image, stopped it; `foreground` is then as it was.
bool CarveOrgan(const ImageView<float>& smooth, const BitMask& candidate, const BitMask* supported,
  const SeedSphere& seed, double noise, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, std::vector<DoubtfulPart>* doubts);

/// The radius of a ball of the foreground's volume, but never less than the seed's: a seed that is
/// small in its organ says too little of how long search lines have to be.
double RadiusOf(const BitMask& foreground, const SeedSphere& seed);

} // namespace FlipFree

#endif

/**
 * What a minimum cut gains by keeping a block: how well the gray values around it fit the seed's.
 */
#ifndef FlipFreeUnaryTerms_h
#define FlipFreeUnaryTerms_h

#include "Image/LocalMeans.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

/// Per mm3, zero outside. `sums` are of the gray values in the mask; `ball` is the largest about
/// the seed, `deviation` that of its gray values.
std::vector<float> FindUnaryTerms(BlockSums sums, const std::vector<unsigned char>& inside,
  const ImageGeometry& blocks, const SeedSphere& ball, double deviation, bool isMR,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

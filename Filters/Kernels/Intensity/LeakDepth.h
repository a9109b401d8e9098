/**
 * What an outside point lies in: a part of the foreground that is attached by a neck, or the depth
 * of a region that looks like the seed.
 */
#ifndef FlipFreeLeakDepth_h
#define FlipFreeLeakDepth_h

#include "Image/BlockGrid.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

struct LeakDepth
{
  bool IsDeep = false;      ///< in what looks like the seed: too deep for the organ, or on top
  bool HasNeck = false;     ///< the part that the point lies in is connected by a neck
  std::vector<bool> IsCore; ///< of each block: in the depth of a part that has a neck
};

/// `inside` says of each block whether it is in the foreground. Returns false if the monitor
/// stopped it.
bool FindLeakDepth(const std::vector<unsigned char>& inside, const BlockGrid& grid,
  const Eigen::Vector3d& point, const SeedSphere& seed, bool looksLikeSeed,
  const ParallelFor& parallelFor, const Monitor& monitor, LeakDepth& result);

} // namespace FlipFree

#endif

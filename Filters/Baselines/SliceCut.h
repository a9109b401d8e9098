/**
 * Private to the module: minimum cuts slice by slice, each guided by the one before.
 */
#ifndef FlipFreeSliceCut_h
#define FlipFreeSliceCut_h

#include "BaselineTask.h"
#include "MinimumCut.h"

namespace FlipFree
{

/// Cuts the plane k through the seed's center, then those above and below it until one is empty.
/// `margin` millimeters inside the outline of the slice before, voxels with favorable odds are
/// organ; as far outside of it, all are background. Counts the slices. Returns false if the monitor
/// stopped it.
bool CutSliceBySlice(const BaselineTask& task, const std::vector<float>& logOdds,
  const BitMask& candidates, const BitMask& seeds, const MinimumCutSettings& settings,
  double margin, const ParallelFor& parallelFor, const Monitor& monitor, BitMask& organ,
  int& slices);

} // namespace FlipFree

#endif

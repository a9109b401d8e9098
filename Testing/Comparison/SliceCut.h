/**
 * Minimum cuts slice by slice, each guided by the one before.
 */
#ifndef FlipFreeSliceCut_h
#define FlipFreeSliceCut_h

#include "BaselineTask.h"
#include "VoxelCut.h"

namespace FlipFree
{

/// What is cut. Refers to the task, the odds and the masks.
struct SliceCutInputs
{
  const BaselineTask& Task;
  const std::vector<float>& LogOdds;
  const BitMask& Candidates; ///< what may be organ
  const BitMask& Seeds;      ///< what is organ for certain
  VoxelCutSettings Settings;
  double Margin; ///< in millimeters
};

struct SliceCutResult
{
  BitMask Organ;
  int Slices = 0; ///< that were cut
};

/// Cuts the plane k through the seed's center, then those above and below it until one is empty.
/// The margin inside the outline of the slice before, voxels with favorable odds are organ; as far
/// outside of it, all are background. Returns false if the monitor stopped it.
bool CutSliceBySlice(const SliceCutInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, SliceCutResult& result);

} // namespace FlipFree

#endif

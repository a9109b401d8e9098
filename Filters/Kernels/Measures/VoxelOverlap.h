/**
 * Voxel-wise overlap of two masks: Dice, Jaccard (the paper's "volume overlap"), and relative
 * volume difference.
 */
#ifndef FlipFreeVoxelOverlap_h
#define FlipFreeVoxelOverlap_h

#include "Image/BitMask.h"
#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

struct VoxelOverlap
{
  std::size_t Segmentation = 0; ///< voxels in the segmentation
  std::size_t Reference = 0;    ///< voxels in the reference
  std::size_t Intersection = 0; ///< voxels in both

  double Dice() const { return 2.0 * this->Intersection / (this->Segmentation + this->Reference); }
  double Jaccard() const
  {
    return static_cast<double>(this->Intersection) /
      (this->Segmentation + this->Reference - this->Intersection);
  }
  /// (segmentation - reference) / reference: negative where the segmentation is too small.
  double RelativeVolumeDifference() const
  {
    return (static_cast<double>(this->Segmentation) - this->Reference) / this->Reference;
  }
};

/// Compares two masks. Throws Error when their dimensions differ, their voxels do not lie in the
/// same places, or a mask is empty.
VoxelOverlap MeasureOverlap(const BitMask& segmentation, const BitMask& reference,
  const ParallelFor& parallelFor = SerialFor);

} // namespace FlipFree

#endif

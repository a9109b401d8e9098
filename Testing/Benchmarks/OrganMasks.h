/**
 * Organs as masks, and how well two agree.
 */
#ifndef OrganMasks_h
#define OrganMasks_h

#include "Image/BitMask.h"
#include "Mesh/SurfaceVoxelization.h"

#include <vector>

inline FlipFree::BitMask MaskOfRuns(const std::vector<FlipFree::VoxelRun>& runs,
  const FlipFree::ImageGeometry& geometry)
{
  FlipFree::BitMask mask(geometry);
  mask.InsertRuns(runs);
  return mask;
}

inline double DiceOf(const FlipFree::BitMask& a, const FlipFree::BitMask& b)
{
  FlipFree::BitMask both = a;
  both.Intersect(b);
  return 2.0 * static_cast<double>(both.Count()) / static_cast<double>(a.Count() + b.Count());
}

#endif

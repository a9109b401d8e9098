/**
 * The cheapest boundary between an organ and its background on a voxel grid, by a minimum s-t cut
 * (Boykov and Jolly, Interactive graph cuts, 2001), with Boost.Graph's maximum flow of Boykov and
 * Kolmogorov (An experimental comparison of min-cut/max-flow algorithms for energy minimization in
 * vision, 2004).
 */
#ifndef FlipFreeVoxelCut_h
#define FlipFreeVoxelCut_h

#include "Image/BitMask.h"

#include <vector>

namespace FlipFree
{

struct VoxelCutSettings
{
  /// Weight of the boundary, in millimeters: what a boundary of one square millimeter costs in flat
  /// parts of the image, in log odds over one cubic millimeter.
  double Smoothness = 2;

  /// Difference of neighboring gray values at which a boundary costs exp(-1/2) of that.
  double EdgeContrast = 10;
};

/// Minimizes, over all sets of voxels between `seeds` and `candidates`, the sum of
///  - minus the log odds of the voxels in the set, times the voxel's volume, and
///  - Smoothness times the area of the faces between the set and the rest, times
///    exp(-(difference of the gray values)^2 / (2 EdgeContrast^2)).
/// The border of the grid costs nothing. Memory is about 80 bytes per candidate. Returns false
/// if the monitor stopped it; `organ` is then as it was.
bool FindVoxelCut(const ImageView<float>& image, const std::vector<float>& logOdds,
  const BitMask& candidates, const BitMask& seeds, const VoxelCutSettings& settings,
  const Monitor& monitor, BitMask& organ);

} // namespace FlipFree

#endif

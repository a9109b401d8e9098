/**
 * The minimum cut of a network of voxels, each joined to its six neighbors, a source and a sink, by
 * two search trees that are mended rather than grown anew (Y. Boykov, V. Kolmogorov: An
 * experimental comparison of min-cut/max-flow algorithms for energy minimization in vision, 2004).
 */
#ifndef FlipFreeMinimumCut_h
#define FlipFreeMinimumCut_h

#include "KernelTypes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace FlipFree
{

/// Capacities are integers, so that every machine finds the same cut.
struct CutNetwork
{
  static constexpr int NoNeighbor = -1;
  /// No sum of other capacities reaches it.
  static constexpr std::int32_t Infinite = 1 << 29;

  /// Per node: towards -x, +x, -y, +y, -z, +z.
  std::vector<std::array<std::int32_t, 6>> Neighbors;
  std::vector<std::array<std::int32_t, 6>> Capacities;
  /// Capacity from the source less that to the sink; what both have in common is always cut.
  std::vector<std::int32_t> Terminals;

  std::size_t Size() const { return this->Neighbors.size(); }
};

/// For each node, 1 if it is on the source's side: of all minimum cuts, the one nearest to the
/// source. Uses up the capacities. Empty if the monitor, asked now and then, stopped it.
std::vector<unsigned char> SourceSide(CutNetwork& network, const Monitor& monitor);

} // namespace FlipFree

#endif

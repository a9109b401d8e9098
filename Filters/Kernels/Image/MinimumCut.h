/**
 * The minimum cut of a network of voxels, each joined to its six neighbors, a source and a sink, by
 * two search trees that are repaired rather than grown again (Y. Boykov, V. Kolmogorov: An
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

/// Capacities are integers, so that every machine finds the same cut. All of a node lies in one
/// line of the cache, since the search goes from node to node in no order of theirs.
struct alignas(64) CutNode
{
  static constexpr std::int32_t NoNeighbor = -1;
  /// No sum of other capacities reaches it.
  static constexpr std::int32_t Infinite = 1 << 29;

  /// Towards -x, +x, -y, +y, -z, +z.
  std::array<std::int32_t, 6> Neighbors{ { NoNeighbor, NoNeighbor, NoNeighbor, NoNeighbor,
    NoNeighbor, NoNeighbor } };
  std::array<std::int32_t, 6> Capacities{};
  /// Capacity from the source less that to the sink; what both have in common is always cut.
  std::int32_t Terminal = 0;

  /// The search's own.
  std::int32_t Time = 0;     ///< when the distance was known to be right
  std::int32_t Distance = 0; ///< to the terminal, in nodes
  std::uint8_t Tree = 0;
  std::uint8_t Parent = 0;
  bool IsActive = false;
};
static_assert(sizeof(CutNode) == 64);

using CutNetwork = std::vector<CutNode>;

/// For each node, 1 if it is on the source's side: of all minimum cuts, the one nearest to the
/// source. Uses up the network. Empty if the monitor, asked now and then, stopped it.
std::vector<unsigned char> SourceSide(CutNetwork&& network, const ParallelFor& parallelFor,
  const Monitor& monitor);

} // namespace FlipFree

#endif

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
#include <utility>
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

/// A minimum cut that is kept: where terminals change, only the flow that they change is found anew
/// (P. Kohli, P. Torr: Dynamic graph cuts for efficient inference in Markov random fields, 2007).
class MinimumCut
{
public:
  explicit MinimumCut(CutNetwork network)
    : Nodes(std::move(network))
  {
  }

  /// Adds to the capacity from the source; negative, to that to the sink. What is taken away is
  /// given to the other side, which changes all costs by the same amount. All that is added to a
  /// node must fit into its capacity: Infinite not more than three times.
  void AddToTerminal(int node, std::int32_t capacity);

  /// Returns false if the monitor, asked now and then, stopped it; the sides are then unknown, and
  /// it can be executed again.
  bool Execute(const ParallelFor& parallelFor, const Monitor& monitor);

  /// Of all minimum cuts, the one nearest to the source.
  bool IsOnSourceSide(int node) const;

  /// What the cut costs, all capacities that were ever added counted; compare it with that of other
  /// cuts of the same network.
  std::int64_t GetCost() const { return this->Cost; }

  int NumberOfNodes() const { return static_cast<int>(this->Nodes.size()); }

private:
  CutNetwork Nodes; ///< what of the capacities is left by the flow
  std::int64_t Cost = 0;
};

} // namespace FlipFree

#endif

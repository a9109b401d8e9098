#include "Evidence/RegionCut.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{

double RegionBlockSize(double radius)
{
  return std::max(1.2, std::min(2.5, radius / 8));
}

BlockGrid RegionGrid(const BitMask& mask, double radius)
{
  constexpr double step = 1.25;
  const std::size_t voxels = mask.Count();
  double size = RegionBlockSize(radius);
  BlockGrid grid(mask.GetGeometry(), size);
  while (voxels > MostBlocks * grid.VoxelsPerBlock())
  {
    size *= step;
    grid = BlockGrid(mask.GetGeometry(), size);
  }
  return grid;
}

BlockLinks RegionLinks(double smoothness, double radius, double spread)
{
  return { smoothness * std::max(5.0, std::min(40.0, radius)), 3 * spread };
}

void RegionCut::Fix(const std::vector<std::size_t>& blocks, bool isInside)
{
  for (const std::size_t block : blocks)
  {
    this->Cut.AddToTerminal(this->Nodes[block], isInside ? CutNode::Infinite : -CutNode::Infinite);
  }
}

void RegionCut::Add(const RegionProposal& proposal)
{
  if (proposal.Blocks.empty())
  {
    return;
  }
  const double share = proposal.Weight / (this->Unit * static_cast<double>(proposal.Blocks.size()));
  constexpr std::int32_t greatest = CutNode::Infinite / 4;
  const auto capacity = static_cast<std::int32_t>(std::lround(std::min<double>(share, greatest)));
  for (const std::size_t block : proposal.Blocks)
  {
    this->Cut.AddToTerminal(this->Nodes[block], proposal.IsInside ? capacity : -capacity);
  }
}

double RegionCut::MarginOf(const std::vector<std::size_t>& blocks, const ParallelFor& parallelFor,
  const Monitor& monitor) const
{
  RegionCut other = *this;
  const bool isInside = !blocks.empty() && this->IsInside(blocks.front());
  other.Fix(blocks, !isInside);
  return other.Execute(parallelFor, monitor)
    ? static_cast<double>(other.Cut.GetCost() - this->Cut.GetCost()) * this->Unit
    : -1;
}

} // namespace FlipFree

#include "Image/BlockNetwork.h"

#include "Image/LocalMeans.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace FlipFree
{
namespace
{

// Of the image in which edges attract the cut, in millimeters.
constexpr double EdgeSmoothing = 1;
// The greatest capacity between neighbors; capacities are rounded to a whole number.
constexpr double GreatestCapacity = 1 << 20;
// Differences of more than this many contrasts, squared, do not matter.
constexpr double GreatestJump = 24;

// With the weight 0 where a block has no data, otherwise 1.
BlockSums BlockMeans(const ImagePart& image, const BlockGrid& grid, const ParallelFor& parallelFor)
{
  const auto& blocks = grid.Blocks.Dimensions;
  const auto& size = grid.Voxels.Dimensions;
  const std::array<int, 3>& factor = grid.Factor;
  const std::size_t count = grid.Blocks.NumberOfVoxels();
  BlockSums means{ std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F) };
  parallelFor(0, blocks[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      std::vector<int> blockOf(size[0]);
      for (int i = 0; i < size[0]; ++i)
      {
        blockOf[i] = i / factor[0];
      }
      std::vector<float> counts(blocks[0]);
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < blocks[1]; ++j)
        {
          float* const sums = means.Values.data() + grid.Blocks.Offset(0, j, k);
          float* const weights = means.Weights.data() + grid.Blocks.Offset(0, j, k);
          std::fill(counts.begin(), counts.end(), 0.0F);
          for (int z = k * factor[2]; z < std::min(size[2], (k + 1) * factor[2]); ++z)
          {
            for (int y = j * factor[1]; y < std::min(size[1], (j + 1) * factor[1]); ++y)
            {
              const float* const row = image.Row(y, z);
              for (int i = 0; i < size[0]; ++i)
              {
                const bool hasData = HasData(row[i]);
                sums[blockOf[i]] += hasData ? row[i] : 0;
                counts[blockOf[i]] += hasData ? 1 : 0;
              }
            }
          }
          for (int i = 0; i < blocks[0]; ++i)
          {
            weights[i] = std::min(counts[i], 1.0F);
            sums[i] /= std::max(counts[i], 1.0F);
          }
        }
      }
    });
  return means;
}

// Links the blocks that are nodes with each other and with the terminals.
class BlockLinker
{
public:
  using BlockValue = std::function<double(std::size_t block)>;

  BlockLinker(const ImageGeometry& blocks, const BlockNodes& nodes,
    const std::vector<float>& smooth, const BlockLinks& links)
    : Blocks(blocks)
    , Nodes(nodes)
    , Smooth(smooth)
    , Links(links)
    , Volume(blocks.VoxelVolume())
    , Area{ { this->Volume / blocks.Spacing[0], this->Volume / blocks.Spacing[1],
        this->Volume / blocks.Spacing[2] } }
    , Unit(CapacityUnit(blocks, links))
    , Step(StepsOf(blocks))
  {
  }

  CutNetwork Link(const BlockValue& unary, const BlockValue& side,
    const ParallelFor& parallelFor) const
  {
    CutNetwork network(this->Nodes.NumberOfNodes());
    const auto& size = this->Blocks.Dimensions;
    parallelFor(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::size_t block = this->Blocks.Offset(0, 0, static_cast<int>(first));
        for (int k = static_cast<int>(first); k < last; ++k)
        {
          for (int j = 0; j < size[1]; ++j)
          {
            for (int i = 0; i < size[0]; ++i, ++block)
            {
              if (this->Nodes.IsNode(block))
              {
                const double terminal = this->LinkNeighbors(block, { { i, j, k } },
                  unary(block) * this->Volume / this->Unit, side, network);
                network[this->Nodes[block]].Terminal = RoundedTerminal(terminal);
              }
            }
          }
        }
      });
    return network;
  }

private:
  static std::int32_t RoundedTerminal(double terminal)
  {
    constexpr std::int32_t greatest = CutNode::Infinite / 4;
    return static_cast<std::int32_t>(
      std::lround(std::max<double>(-greatest, std::min<double>(greatest, terminal))));
  }

  double CapacityOf(std::size_t block, std::size_t other, int axis) const
  {
    const double jump = (this->Smooth[block] - this->Smooth[other]) / this->Links.EdgeContrast;
    // Also where there is no data.
    const double square = jump * jump < GreatestJump ? jump * jump : GreatestJump;
    return this->Links.PerArea * this->Area[axis] / this->Unit * std::exp(-0.5 * square);
  }

  // Returns the terminal's capacity with what neighbors that are no nodes add to it.
  double LinkNeighbors(std::size_t block, const std::array<int, 3>& index, double terminal,
    const BlockValue& side, CutNetwork& network) const
  {
    CutNode& own = network[this->Nodes[block]];
    for (int way = 0; way < 6; ++way)
    {
      const int axis = way / 2;
      const bool up = way % 2 == 1;
      if (up ? index[axis] + 1 >= this->Blocks.Dimensions[axis] : index[axis] == 0)
      {
        continue;
      }
      const std::size_t other = block + (up ? this->Step[axis] : -this->Step[axis]);
      const int neighbor = this->Nodes[other];
      if (neighbor < 0)
      {
        terminal += side(other) * this->CapacityOf(block, other, axis);
        continue;
      }
      own.Neighbors[way] = neighbor;
      // The same in both directions: the lower block's turn.
      if (up)
      {
        const auto capacity =
          static_cast<std::int32_t>(std::lround(this->CapacityOf(block, other, axis)));
        own.Capacities[way] = capacity;
        network[neighbor].Capacities[way - 1] = capacity;
      }
    }
    return terminal;
  }

  const ImageGeometry& Blocks;
  const BlockNodes& Nodes;
  const std::vector<float>& Smooth;
  const BlockLinks& Links;
  const double Volume;
  const std::array<double, 3> Area; // of a block's faces, by axis
  const double Unit;                // of capacities
  const std::array<std::ptrdiff_t, 3> Step;
};

} // namespace

std::vector<float> SmoothBlockMeans(const ImagePart& image, const BlockGrid& grid,
  const ParallelFor& parallelFor)
{
  BlockSums means = BlockMeans(image, grid, parallelFor);
  std::vector<std::size_t> without;
  for (std::size_t block = 0; block < means.Weights.size(); ++block)
  {
    if (means.Weights[block] == 0)
    {
      without.push_back(block);
    }
  }
  std::vector<float> smooth =
    LocalMeans(std::move(means), grid.Blocks, EdgeSmoothing, 0, 0, parallelFor);
  for (const std::size_t block : without)
  {
    smooth[block] = std::numeric_limits<float>::quiet_NaN();
  }
  return smooth;
}

double CapacityUnit(const ImageGeometry& blocks, const BlockLinks& links)
{
  return links.PerArea * blocks.VoxelVolume() / blocks.Spacing.minCoeff() / GreatestCapacity;
}

CutNetwork MakeBlockNetwork(const ImageGeometry& blocks, const BlockNodes& nodes,
  const std::vector<float>& smooth, const BlockLinks& links,
  const std::function<double(std::size_t block)>& unary,
  const std::function<double(std::size_t block)>& side, const ParallelFor& parallelFor)
{
  return BlockLinker(blocks, nodes, smooth, links).Link(unary, side, parallelFor);
}

} // namespace FlipFree

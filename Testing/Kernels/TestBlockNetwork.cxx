#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BlockNetwork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

using namespace FlipFree;

namespace
{

// Random gray values on a grid, some blocks of which are nodes.
struct Example
{
  Example(const ImageGeometry& blocks, std::mt19937& random)
    : Blocks(blocks)
  {
    std::normal_distribution<float> normal(0, 1);
    const std::vector<unsigned char> mask = RandomMask(blocks, 0.7, random);
    this->Nodes = BlockNodes(mask.size(), [&](std::size_t block) { return mask[block] != 0; });
    std::generate_n(std::back_inserter(this->Smooth), mask.size(), [&] { return normal(random); });
  }

  double Side(std::size_t block) const { return this->Smooth[block] > 0 ? 1 : -1; }

  CutNetwork Make(const ParallelFor& parallelFor) const
  {
    return MakeBlockNetwork(
      this->Blocks, this->Nodes, this->Smooth, { 2, 1.5 },
      [this](std::size_t block) { return 0.1 * this->Smooth[block]; },
      [this](std::size_t block) { return this->Side(block); }, parallelFor);
  }

  // Per mm2, from the formula.
  double CostOf(std::size_t block, std::size_t other) const
  {
    const double jump = (this->Smooth[block] - this->Smooth[other]) / 1.5;
    return 2 * std::exp(-0.5 * std::min(24.0, jump * jump));
  }

  ImageGeometry Blocks;
  BlockNodes Nodes;
  std::vector<float> Smooth;
};

} // namespace

TEST(BlockNetwork, LinksCostWhatTheirFacesDo)
{
  std::mt19937 random(4);
  for (const ImageGeometry& blocks : ExampleGrids())
  {
    const Example example(blocks, random);
    const CutNetwork network = example.Make(ScatteredFor);
    const double volume = blocks.Spacing.prod();
    // Of a capacity: the greatest face without an edge is 2^20.
    const double unit = 2 * volume / blocks.Spacing.minCoeff() / (1 << 20);
    ForEachVoxel(blocks,
      [&](int i, int j, int k)
      {
        const std::size_t block = blocks.Offset(i, j, k);
        const int node = example.Nodes[block];
        if (node < 0)
        {
          return;
        }
        double terminal = 0.1 * example.Smooth[block] * volume;
        for (int way = 0; way < 6; ++way)
        {
          std::array<int, 3> at{ { i, j, k } };
          at[way / 2] += way % 2 == 1 ? 1 : -1;
          const bool exists = blocks.Contains(at[0], at[1], at[2]);
          const std::size_t other = exists ? blocks.Offset(at[0], at[1], at[2]) : block;
          const int neighbor = exists ? example.Nodes[other] : CutNode::NoNeighbor;
          const double cost =
            exists ? example.CostOf(block, other) * volume / blocks.Spacing[way / 2] : 0;
          ASSERT_EQ(network[node].Neighbors[way], neighbor);
          ASSERT_NEAR(network[node].Capacities[way], neighbor < 0 ? 0 : cost / unit, 1);
          terminal += neighbor < 0 ? example.Side(other) * cost : 0;
        }
        ASSERT_NEAR(network[node].Terminal, terminal / unit, 1 + 1e-6 * std::abs(terminal) / unit);
      });
  }
}

TEST(BlockNetwork, TheSameHoweverCut)
{
  std::mt19937 random(5);
  for (const ImageGeometry& blocks : ExampleGrids())
  {
    const Example example(blocks, random);
    const CutNetwork one = example.Make(SerialFor);
    const CutNetwork other = example.Make(ScatteredFor);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t node = 0; node < one.size(); ++node)
    {
      EXPECT_EQ(one[node].Neighbors, other[node].Neighbors);
      EXPECT_EQ(one[node].Capacities, other[node].Capacities);
      EXPECT_EQ(one[node].Terminal, other[node].Terminal);
    }
  }
}

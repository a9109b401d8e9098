#include "Image/BlockNodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace FlipFree;

TEST(BlockNodes, AreNumberedInTheirOrder)
{
  std::mt19937 random(7);
  EXPECT_EQ(BlockNodes().NumberOfBlocks(), 0U);
  for (const std::size_t blocks : { 0U, 1U, 63U, 64U, 65U, 1000U })
  {
    std::vector<bool> isNode(blocks);
    std::generate(isNode.begin(), isNode.end(), [&] { return random() % 3 == 0; });
    const BlockNodes nodes(blocks, [&](std::size_t block) { return isNode[block]; });
    int next = 0;
    for (std::size_t block = 0; block < blocks; ++block)
    {
      EXPECT_EQ(nodes.IsNode(block), isNode[block]);
      EXPECT_EQ(nodes[block], isNode[block] ? next++ : CutNode::NoNeighbor);
    }
    EXPECT_EQ(nodes.NumberOfNodes(), next);
    EXPECT_EQ(nodes.NumberOfBlocks(), blocks);
  }
}

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BlockGrid.h"

#include <gtest/gtest.h>

using namespace FlipFree;

TEST(BlockGrid, CountsEveryVoxelInItsBlock)
{
  std::mt19937 random(6);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const std::vector<unsigned char> mask = RandomMask(geometry, 0.6, random);
    const BlockGrid grid(geometry, 3);
    std::vector<std::size_t> expected(grid.Blocks.NumberOfVoxels(), 0);
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        expected[grid.Blocks.Offset(i / grid.Factor[0], j / grid.Factor[1], k / grid.Factor[2])] +=
          mask[geometry.Offset(i, j, k)];
      });
    EXPECT_EQ(grid.CountVoxels(BitsOf(mask, geometry), ScatteredFor), expected);
  }
}

TEST(BlockGrid, FindsTheBlocksOfAMaskAndTheirVoxels)
{
  std::mt19937 random(7);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const BitMask mask = BitsOf(RandomMask(geometry, 0.1, random), geometry);
    const BlockGrid grid(geometry, 3);
    const std::vector<std::size_t> counts = grid.CountVoxels(mask, ScatteredFor);
    for (const std::size_t least : { std::size_t(1), grid.HalfOfBlock() })
    {
      const BitMask blocks = grid.BlocksWith(least, mask, ScatteredFor);
      const BitMask voxels = grid.VoxelsOf(blocks, ScatteredFor);
      ForEachVoxel(geometry,
        [&](int i, int j, int k)
        {
          const std::size_t block =
            grid.Blocks.Offset(i / grid.Factor[0], j / grid.Factor[1], k / grid.Factor[2]);
          EXPECT_EQ(voxels(i, j, k), counts[block] >= least);
          EXPECT_EQ(blocks(block), counts[block] >= least);
        });
    }
  }
}

TEST(BlockGrid, FindsTheBlockOfAPointAndItsCenter)
{
  const BlockGrid grid(Grid({ { 21, 13, 9 } }, { 1, 1.5, 4 }), 4);
  for (std::size_t block = 0; block < grid.Blocks.NumberOfVoxels(); ++block)
  {
    EXPECT_EQ(grid.BlockAt(grid.CenterOf(block) - Eigen::Vector3d(0.4, 0.4, 0.4)), block);
  }
  EXPECT_EQ(grid.BlockAt({ -9, -9, -9 }), 0);
}

// Between the centers of the blocks; beyond them, the outermost count.
TEST(BlockGrid, InterpolatesALinearFunctionExactly)
{
  const BlockGrid grid(Grid({ { 21, 13, 9 } }, { 1, 1.5, 4 }), 4);
  EXPECT_EQ(grid.Factor, (std::array<int, 3>{ { 4, 2, 1 } }));
  const auto value = [](const Eigen::Vector3d& point)
  { return 3 + point.dot(Eigen::Vector3d(0.5, -0.25, 0.125)); };
  std::vector<float> blocks;
  ForEachVoxel(grid.Blocks,
    [&](int i, int j, int k) {
      blocks.push_back(static_cast<float>(value(grid.Blocks.ToPhysical(Eigen::Vector3d(i, j, k)))));
    });
  BlockRow row(grid);
  std::array<float, 17> values{};
  for (int k = 0; k < 9; ++k)
  {
    for (int j = 1; j < 11; ++j)
    {
      row.Read(blocks, 2, 19, j, k, values.data());
      for (int i = 2; i < 19; ++i)
      {
        EXPECT_NEAR(values[i - 2], value(grid.Voxels.ToPhysical(Eigen::Vector3d(i, j, k))), 1e-4);
      }
    }
  }
}

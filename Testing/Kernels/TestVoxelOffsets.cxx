#include "ExampleMasks.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

using namespace FlipFree;

TEST(VoxelOffsets, LeadToTheVoxelsIndexAndNeighbors)
{
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        const std::size_t voxel = geometry.Offset(i, j, k);
        ASSERT_EQ(IndexOf(voxel, geometry), (std::array<int, 3>{ { i, j, k } }));
        std::vector<std::size_t> expected;
        for (int way = 0; way < 6; ++way)
        {
          std::array<int, 3> at{ { i, j, k } };
          at[way / 2] += way % 2 == 1 ? 1 : -1;
          if (geometry.Contains(at[0], at[1], at[2]))
          {
            expected.push_back(geometry.Offset(at[0], at[1], at[2]));
          }
        }
        std::vector<std::size_t> neighbors;
        VisitNeighbors(voxel, geometry,
          [&](std::size_t neighbor) { neighbors.push_back(neighbor); });
        ASSERT_EQ(neighbors, expected);
      });
  }
}

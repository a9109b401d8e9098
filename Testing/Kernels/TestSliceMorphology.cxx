#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/SliceMorphology.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

template <typename Visit>
void ForEachNeighborInSlice(int across, const Visit& visit)
{
  for (int a = -1; a <= 1; ++a)
  {
    for (int b = -1; b <= 1; ++b)
    {
      std::array<int, 3> offset{};
      offset[across == 0 ? 1 : 0] = a;
      offset[across == 2 ? 1 : 2] = b;
      visit(offset);
    }
  }
}

} // namespace

TEST(SliceMorphology, AxisAcrossSlices)
{
  EXPECT_EQ(AxisAcrossSlices(Grid({ { 2, 2, 2 } }, { 1, 1, 1 })), 2);
  EXPECT_EQ(AxisAcrossSlices(Grid({ { 2, 2, 2 } }, { 1, 1, 3 })), 2);
  EXPECT_EQ(AxisAcrossSlices(Grid({ { 2, 2, 2 } }, { 4, 1, 3 })), 0);
  EXPECT_EQ(AxisAcrossSlices(Grid({ { 2, 2, 2 } }, { 1, 5, 1 })), 1);
}

TEST(SliceMorphology, MedianAgainstCounting)
{
  std::mt19937 random(6);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const std::vector<unsigned char> mask = RandomMask(geometry, 0.6, random);
    const int across = AxisAcrossSlices(geometry);
    std::vector<unsigned char> expected;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        int count = 0;
        ForEachNeighborInSlice(across,
          [&](const std::array<int, 3>& o)
          {
            count += geometry.Contains(i + o[0], j + o[1], k + o[2]) &&
              mask[geometry.Offset(i + o[0], j + o[1], k + o[2])];
          });
        expected.push_back(count >= 5);
      });
    BitMask bits = BitsOf(mask, geometry);
    MedianInSlices(bits, ScatteredFor);
    ASSERT_EQ(BytesOf(bits), expected);
  }
}

TEST(SliceMorphology, NeighborsAlong)
{
  std::mt19937 random(6);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<unsigned char> mask = RandomMask(geometry, 0.2, random);
      std::vector<unsigned char> expected = mask;
      ForEachVoxel(geometry,
        [&](int i, int j, int k)
        {
          for (const int way : { -1, 1 })
          {
            std::array<int, 3> at{ { i, j, k } };
            at[axis] += way;
            if (geometry.Contains(at[0], at[1], at[2]) &&
              mask[geometry.Offset(at[0], at[1], at[2])])
            {
              expected[geometry.Offset(i, j, k)] = 1;
            }
          }
        });
      BitMask sum = BitsOf(mask, geometry);
      AddNeighborsAlong(axis, BitsOf(mask, geometry), sum);
      ASSERT_EQ(BytesOf(sum), expected);
    }
  }
}

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BallMorphology.h"
#include "Image/DistanceTransform.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

bool Grow(BitMask& mask, double radius, unsigned char value, const ParallelFor& parallelFor)
{
  return value ? Dilate(mask, radius, parallelFor, NeverStop)
               : Erode(mask, radius, parallelFor, NeverStop);
}

} // namespace

TEST(BallMorphology, GrowsAndShrinksByABallInMillimeters)
{
  std::mt19937 random(2);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (double radius : { 0.0, 0.65, 1.0, 2.0, 3.3, 30.0 })
    {
      for (unsigned char value : { 0, 1 })
      {
        const std::vector<unsigned char> mask = RandomMask(geometry, value ? 0.03 : 0.97, random);
        BitMask grown = BitsOf(mask, geometry);
        ASSERT_TRUE(Grow(grown, radius, value, SerialFor));
        BitMask threaded = BitsOf(mask, geometry);
        ASSERT_TRUE(Grow(threaded, radius, value, ScatteredFor));
        ASSERT_EQ(threaded, grown);
        ForEachVoxel(geometry,
          [&](int i, int j, int k)
          {
            // A ball that ends exactly at a voxel's center holds it.
            const double square =
              SquareToNearest(mask, geometry, value, { i + 0.0, j + 0.0, k + 0.0 });
            const bool within = std::sqrt(square) <= radius + 1e-6;
            ASSERT_EQ(grown(i, j, k) == (value != 0),
              within || mask[geometry.Offset(i, j, k)] == value);
          });
      }
    }
  }
}

TEST(BallMorphology, ReachesAsFarAsABallGrows)
{
  for (const ImageGeometry& small : ExampleGrids())
  {
    for (const double radius : { 0.0, 0.65, 1.0, 2.0, 3.3 })
    {
      ImageGeometry geometry = small;
      const std::array<int, 3> reach =
        BallReach(radius, Grid({ { 999, 999, 999 } }, small.Spacing));
      for (int axis = 0; axis < 3; ++axis)
      {
        geometry.Dimensions[axis] = 2 * reach[axis] + 3;
        EXPECT_EQ(BallReach(radius, geometry)[axis], reach[axis]);
        EXPECT_LE(BallReach(1e30, small)[axis], small.Dimensions[axis]);
      }
      BitMask ball(geometry);
      ball.Insert(reach[0] + 1, reach[1] + 1, reach[2] + 1);
      ASSERT_TRUE(Dilate(ball, radius, SerialFor, NeverStop));
      EXPECT_EQ(ball.Bounds(),
        (VoxelBox{ { { 1, 1, 1 } },
          { { 2 * reach[0] + 2, 2 * reach[1] + 2, 2 * reach[2] + 2 } } }));
    }
  }
}

TEST(BallMorphology, UniformMasksStay)
{
  const ImageGeometry geometry = Grid({ { 6, 5, 4 } }, { 1, 2, 3 });
  for (unsigned char value : { 0, 1 })
  {
    for (double radius : { 2.0, 1e4 }) // by rows, and by distance
    {
      const BitMask uniform =
        BitsOf(std::vector<unsigned char>(geometry.NumberOfVoxels(), 1 - value), geometry);
      BitMask grown = uniform;
      EXPECT_TRUE(Grow(grown, radius, value, SerialFor));
      EXPECT_EQ(grown, uniform);
    }
  }
}

TEST(BallMorphology, LargeBallsByDistanceAreTheSame)
{
  // Voxels so thin that the ball has more rows than are done one by one.
  const ImageGeometry geometry = Grid({ { 3, 6000, 2 } }, { 1, 0.01, 1 });
  std::vector<unsigned char> mask(geometry.NumberOfVoxels(), 0);
  mask[geometry.Offset(1, 3000, 0)] = 1;
  const double radius = 25.505;
  BitMask grown = BitsOf(mask, geometry);
  ASSERT_TRUE(Dilate(grown, radius, SerialFor, NeverStop));
  for (int j = 0; j < 6000; ++j)
  {
    const double y = 0.01 * (j - 3000);
    ASSERT_EQ(grown(1, j, 0), y * y <= radius * radius) << j;
    ASSERT_EQ(grown(0, j, 1), y * y + 2 <= radius * radius) << j;
  }
}

// Boxes of voxels with room around them, at the grid's sides too, beside the distance transform.
TEST(BallMorphology, SolidsInALargeGridAreAsByDistance)
{
  std::mt19937 random(7);
  const ImageGeometry geometry = Grid({ { 330, 31, 23 } }, { 0.7, 1.1, 1.9 });
  const auto within = [&random](int size) { return static_cast<int>(random() % size); };
  for (int repetition = 0; repetition < 12; ++repetition)
  {
    BitMask solids(geometry);
    for (int solid = 0; solid < 1 + repetition % 3; ++solid)
    {
      const std::array<int, 3> first{ { within(330), within(31), within(23) } };
      const int end = std::min(330, first[0] + 1 + within(90));
      for (int k = first[2]; k < std::min(23, first[2] + 6); ++k)
      {
        for (int j = first[1]; j < std::min(31, first[1] + 9); ++j)
        {
          solids.InsertRun(first[0], end, j, k);
        }
      }
    }
    const std::vector<unsigned char> bytes = BytesOf(solids);
    for (const double radius : { 0.3, 1.5, 2.2, 4.0, 12.0 })
    {
      for (const unsigned char value : { 0, 1 })
      {
        const std::vector<float> square =
          SquaredDistance(bytes, geometry, value, SerialFor, NeverStop);
        BitMask grown = solids;
        ASSERT_TRUE(Grow(grown, radius, value, ScatteredFor));
        const auto limit = static_cast<float>(radius * radius * (1 + 1e-6));
        const BitMask near = VoxelsWhere(
          ImageView<float>{ square.data(), geometry },
          [limit](float distance) { return distance <= limit; }, SerialFor);
        BitMask expected = near;
        if (!value)
        {
          expected.Complement();
        }
        ASSERT_EQ(grown, expected) << radius << " mm, value " << int(value);
      }
    }
  }
}

// Balls that reach over whole words of a row.
TEST(BallMorphology, WideBallsAroundSingleVoxels)
{
  for (int width : { 127, 128, 129, 300 })
  {
    const ImageGeometry geometry = Grid({ { width, 1, 1 } }, { 1, 1, 1 });
    for (int center : { 0, 1, 62, 63, 64, 65, 100, width - 1 })
    {
      for (int radius : { 30, 63, 64, 65, 90, 127, 128, 200 })
      {
        BitMask grown(geometry);
        grown.Insert(center, 0, 0);
        ASSERT_TRUE(Dilate(grown, radius, SerialFor, NeverStop));
        BitMask expected(geometry);
        expected.InsertRun(std::max(0, center - radius), std::min(width, center + radius + 1), 0,
          0);
        ASSERT_EQ(grown, expected) << center << " by " << radius << " of " << width;
        BitMask hole(geometry);
        hole.Insert(center, 0, 0);
        hole.Complement();
        ASSERT_TRUE(Erode(hole, radius, SerialFor, NeverStop));
        expected.Complement();
        ASSERT_EQ(hole, expected) << center << " by " << radius << " of " << width;
      }
    }
  }
}

TEST(BallMorphology, AStopLeavesNothing)
{
  const ImageGeometry geometry = Grid({ { 20, 20, 20 } }, { 1, 1, 1 });
  for (double radius : { 3.0, 1e4 })
  {
    BitMask mask(geometry);
    mask.Insert(3, 4, 5);
    BitMask other = mask;
    EXPECT_FALSE(Dilate(mask, radius, SerialFor, [](double) { return false; }));
    EXPECT_EQ(mask, BitMask());
    EXPECT_FALSE(Erode(other, radius, SerialFor, [](double) { return false; }));
    EXPECT_EQ(other, BitMask());
  }
}

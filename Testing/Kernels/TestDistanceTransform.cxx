#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/DistanceTransform.h"

#include <gtest/gtest.h>

#include <random>

using namespace FlipFree;

TEST(DistanceTransform, IsTheBruteForceDistance)
{
  std::mt19937 random(1);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (double part : { 0.005, 0.05, 0.5, 0.97 })
    {
      const std::vector<unsigned char> mask = RandomMask(geometry, part, random);
      for (unsigned char target : { 0, 1 })
      {
        const std::vector<float> distance =
          SquaredDistance(mask, geometry, target, SerialFor, NeverStop);
        ASSERT_EQ(distance.size(), mask.size());
        ForEachVoxel(geometry,
          [&](int i, int j, int k)
          {
            const double expected =
              SquareToNearest(mask, geometry, target, { i + 0.0, j + 0.0, k + 0.0 });
            ASSERT_NEAR(distance[geometry.Offset(i, j, k)], expected, 1e-5 * expected);
          });
        EXPECT_EQ(SquaredDistance(mask, geometry, target, ScatteredFor, NeverStop), distance);
        EXPECT_EQ(SquaredDistance(BitsOf(mask, geometry), target == 1, ScatteredFor, NeverStop),
          distance);
      }
    }
  }
}

TEST(DistanceTransform, EmptyAndFullMasks)
{
  const ImageGeometry geometry = Grid({ { 6, 5, 4 } }, { 1, 2, 3 });
  for (unsigned char value : { 0, 1 })
  {
    const std::vector<unsigned char> uniform(geometry.NumberOfVoxels(), value);
    for (float distance : SquaredDistance(uniform, geometry, value, SerialFor, NeverStop))
    {
      EXPECT_EQ(distance, 0);
    }
    const unsigned char other = 1 - value;
    for (float distance : SquaredDistance(uniform, geometry, other, SerialFor, NeverStop))
    {
      EXPECT_GT(distance, 1e18f);
    }
  }
}

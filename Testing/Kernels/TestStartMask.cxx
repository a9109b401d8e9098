// A mask from elsewhere: its largest ball against brute force.
#include "Deformation/StartMask.h"

#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace FlipFree;

namespace
{

// Over all voxels, those beyond the grid included.
double DepthOf(const BitMask& mask, int i, int j, int k)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  double least = std::numeric_limits<double>::infinity();
  for (int z = -1; z <= geometry.Dimensions[2]; ++z)
  {
    for (int y = -1; y <= geometry.Dimensions[1]; ++y)
    {
      for (int x = -1; x <= geometry.Dimensions[0]; ++x)
      {
        if (!geometry.Contains(x, y, z) || !mask(x, y, z))
        {
          const Eigen::Vector3d away(x - i, y - j, z - k);
          least = std::min(least, away.cwiseProduct(geometry.Spacing).norm());
        }
      }
    }
  }
  return least;
}

} // namespace

TEST(StartMask, LargestBallIsThatOfBruteForce)
{
  std::mt19937 random(5);
  const ImageGeometry geometry = Grid({ { 17, 13, 9 } }, { 1, 1.5, 2 });
  for (int trial = 0; trial < 5; ++trial)
  {
    BitMask mask(geometry);
    for (int box = 0; box < 4; ++box)
    {
      const VoxelBox inner{ { { 1, 1, 1 } }, { { 16, 12, 8 } } };
      ForEachVoxel(RandomBox(geometry, random).Cropped(inner),
        [&](int i, int j, int k) { mask.Insert(i, j, k); });
    }
    double deepest = 0;
    ForEachVoxel(geometry,
      [&](int i, int j, int k) { deepest = std::max(deepest, DepthOf(mask, i, j, k)); });
    const SeedSphere ball = LargestBallIn(mask, SerialFor);
    EXPECT_NEAR(ball.Radius, deepest, 1e-5);
    const Eigen::Vector3d index = geometry.ToIndex(ball.Center);
    EXPECT_NEAR(DepthOf(mask, static_cast<int>(std::lround(index[0])),
                  static_cast<int>(std::lround(index[1])), static_cast<int>(std::lround(index[2]))),
      deepest, 1e-5);
  }
}

TEST(StartMask, BallStaysWithinTheImage)
{
  const ImageGeometry geometry = Grid({ { 17, 13, 9 } }, { 1, 1.5, 2 });
  BitMask mask(geometry);
  mask.Complement();
  const SeedSphere ball = LargestBallIn(mask, SerialFor);
  EXPECT_TRUE(ContainsSphere(geometry, ball));
  EXPECT_GT(ball.Radius, 8);
  EXPECT_LE(ball.Radius, 8.5);
}

TEST(StartMask, BallInARowIsAsSmallAsAVoxel)
{
  const ImageGeometry geometry = Grid({ { 10, 10, 10 } }, { 1, 1, 2 });
  BitMask mask(geometry);
  mask.InsertRun(0, 10, 5, 0); // at the image's end, which leaves half a voxel
  const SeedSphere ball = LargestBallIn(mask, SerialFor);
  EXPECT_EQ(ball.Radius, 1);
  EXPECT_EQ(ball.Center[1], 5);
  EXPECT_EQ(ball.Center[2], 0);
}

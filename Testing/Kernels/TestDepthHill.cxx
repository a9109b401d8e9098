#include "Image/DepthHill.h"
#include "Image/DistanceTransform.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace FlipFree;

namespace
{

ImageGeometry HillGrid()
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 48, 24, 24 } };
  return geometry;
}

// Two balls of 8 and 10 mm whose centers are 24 mm apart, joined by a tube.
std::vector<float> DepthOfDumbbell(double tube)
{
  const ImageGeometry geometry = HillGrid();
  std::vector<unsigned char> inside(geometry.NumberOfVoxels());
  std::size_t voxel = 0;
  for (int k = 0; k < 24; ++k)
  {
    for (int j = 0; j < 24; ++j)
    {
      for (int i = 0; i < 48; ++i, ++voxel)
      {
        const auto within = [&](int center, double radius)
        { return std::hypot(i - center, std::hypot(j - 12, k - 12)) <= radius; };
        inside[voxel] = within(10, 8) || within(34, 10) ||
          (i > 10 && i < 34 && std::hypot(j - 12, k - 12) <= tube);
      }
    }
  }
  return SquaredDistance(inside, geometry, 0, SerialFor, NeverStop);
}

} // namespace

TEST(DepthHill, EndsAtTheNeck)
{
  const ImageGeometry geometry = HillGrid();
  const DepthHill hill = FindDepthHill(DepthOfDumbbell(3), geometry, geometry.Offset(34, 12, 12),
    geometry.Offset(10, 12, 12));
  ASSERT_FALSE(hill.Holds.empty());
  EXPECT_NEAR(std::sqrt(hill.Saddle), 3.5, 1);
  EXPECT_NEAR(std::sqrt(hill.Peak), 10.5, 1);
  EXPECT_TRUE(hill.Holds[geometry.Offset(34, 12, 12)]);
  EXPECT_TRUE(hill.Holds[geometry.Offset(34, 16, 12)]);
  EXPECT_FALSE(hill.Holds[geometry.Offset(10, 12, 12)]);
  EXPECT_FALSE(hill.Holds[geometry.Offset(34, 12, 22)]); // shallower than the neck
  // From the other side, the other ball.
  const DepthHill other = FindDepthHill(DepthOfDumbbell(3), geometry, geometry.Offset(10, 12, 12),
    geometry.Offset(34, 12, 12));
  EXPECT_NEAR(std::sqrt(other.Peak), 8.5, 1);
  EXPECT_EQ(other.Saddle, hill.Saddle);
}

TEST(DepthHill, IsNoneWithoutANeckOrAWay)
{
  const ImageGeometry geometry = HillGrid();
  // On the slope of one ball.
  EXPECT_TRUE(FindDepthHill(DepthOfDumbbell(3), geometry, geometry.Offset(34, 12, 12),
    geometry.Offset(34, 18, 12))
                .Holds.empty());
  // Apart.
  EXPECT_TRUE(FindDepthHill(DepthOfDumbbell(-1), geometry, geometry.Offset(34, 12, 12),
    geometry.Offset(10, 12, 12))
                .Holds.empty());
  // Outside.
  EXPECT_TRUE(
    FindDepthHill(DepthOfDumbbell(3), geometry, 0, geometry.Offset(10, 12, 12)).Holds.empty());
}

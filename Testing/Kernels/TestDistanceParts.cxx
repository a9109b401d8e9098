#include "ExampleMasks.h"
#include "Image/DistanceOrder.h"
#include "Image/DistanceParts.h"
#include "Image/DistanceTransform.h"

#include <gtest/gtest.h>

#include <set>

using namespace FlipFree;

namespace
{

// Two balls of radius 12 and 8 mm, joined by a neck of radius 4 mm along x.
struct Dumbbell
{
  ImageGeometry Geometry = Grid({ { 70, 30, 20 } }, { 1, 1, 1.5 });
  Eigen::Vector3d Large{ 15, 15, 14 };
  Eigen::Vector3d Small{ 50, 15, 14 };
  std::vector<float> Distance;

  Dumbbell()
  {
    std::vector<unsigned char> mask;
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d point = this->Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        const bool neck =
          point.x() > 15 && point.x() < 50 && std::hypot(point.y() - 15, point.z() - 14) < 4;
        mask.push_back(
          (point - this->Large).norm() < 12 || (point - this->Small).norm() < 8 || neck);
      });
    this->Distance = SquaredDistance(mask, this->Geometry, 0, SerialFor, NeverStop);
  }

  std::size_t VoxelAt(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d index = this->Geometry.ToIndex(point);
    return this->Geometry.Offset(static_cast<int>(std::lround(index[0])),
      static_cast<int>(std::lround(index[1])), static_cast<int>(std::lround(index[2])));
  }
};

} // namespace

TEST(DistanceParts, DivideAtANarrowNeck)
{
  const Dumbbell shape;
  const std::vector<std::size_t> seed{ shape.VoxelAt(shape.Large) };
  // The neck is half as wide as the smaller ball.
  const DistanceParts apart = FindDistanceParts(shape.Distance, shape.Geometry, seed, 0.7);
  const int large = apart.PartOf[shape.VoxelAt(shape.Large)];
  const int small = apart.PartOf[shape.VoxelAt(shape.Small)];
  ASSERT_NE(large, small);
  EXPECT_TRUE(apart.HoldsSeed[large]);
  EXPECT_FALSE(apart.HoldsSeed[small]);
  EXPECT_NEAR(std::sqrt(apart.Peaks[large]), 12, 1.5);
  EXPECT_NEAR(std::sqrt(apart.Peaks[small]), 8, 1.5);
  for (std::size_t voxel = 0; voxel < shape.Distance.size(); ++voxel)
  {
    ASSERT_EQ(apart.PartOf[voxel] == DistanceParts::Outside, shape.Distance[voxel] == 0);
  }

  const DistanceParts together = FindDistanceParts(shape.Distance, shape.Geometry, seed, 0.4);
  EXPECT_EQ(together.PartOf[shape.VoxelAt(shape.Large)],
    together.PartOf[shape.VoxelAt(shape.Small)]);
}

TEST(DistanceParts, ASeedInBothHoldsThemTogether)
{
  const Dumbbell shape;
  const DistanceParts parts = FindDistanceParts(shape.Distance, shape.Geometry,
    { shape.VoxelAt(shape.Large), shape.VoxelAt(shape.Small) }, 0.9);
  EXPECT_EQ(parts.PartOf[shape.VoxelAt(shape.Large)], parts.PartOf[shape.VoxelAt(shape.Small)]);
}

TEST(DistanceParts, AreConnectedAndHoldTheirPeaks)
{
  std::mt19937 random(2);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    const std::vector<unsigned char> mask = RandomMask(geometry, 0.8, random);
    const std::vector<float> distance = SquaredDistance(mask, geometry, 0, SerialFor, NeverStop);
    const DistanceParts parts = FindDistanceParts(distance, geometry, {}, 0.8);
    std::vector<float> peaks(parts.Peaks.size(), 0);
    for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
    {
      if (parts.PartOf[voxel] >= 0)
      {
        peaks[parts.PartOf[voxel]] = std::max(peaks[parts.PartOf[voxel]], distance[voxel]);
      }
    }
    EXPECT_EQ(peaks, parts.Peaks);
  }
}

TEST(DistanceOrder, FromTheGreatestDownThenByNumber)
{
  EXPECT_TRUE(OrderByDistance({}).empty());
  EXPECT_EQ(OrderByDistance({ 0, 2, 1e-30F, 1e20F, 2, 0, 0.5F, 2 }),
    (std::vector<int>{ 3, 1, 4, 7, 6, 2 }));
  std::mt19937 random(7);
  std::uniform_int_distribution<int> square(0, 300);
  std::vector<float> distance(5000);
  for (float& value : distance)
  {
    value = 0.1F * static_cast<float>(square(random));
  }
  std::vector<int> expected;
  for (int voxel = 0; voxel < 5000; ++voxel)
  {
    if (distance[voxel] > 0)
    {
      expected.push_back(voxel);
    }
  }
  std::stable_sort(expected.begin(), expected.end(),
    [&](int a, int b) { return distance[a] > distance[b]; });
  EXPECT_EQ(OrderByDistance(distance), expected);
}

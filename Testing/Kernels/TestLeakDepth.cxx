#include "ExampleMasks.h"
#include "Intensity/LeakDepth.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// An organ about the seed, and a ball that is connected to it by a neck of the radius given, along
// x.
struct Example
{
  explicit Example(double neck)
  {
    ForEachVoxel(this->Grid.Blocks,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d place = this->Grid.Blocks.ToPhysical(Eigen::Vector3d(i, j, k));
        const bool inNeck =
          place.x() > 16 && place.x() < 50 && std::hypot(place.y() - 16, place.z() - 16) < neck;
        this->Inside.push_back(
          (place - this->Seed.Center).norm() < 13 || (place - this->Ball).norm() < 9 || inNeck);
      });
  }

  LeakDepth Find(const Eigen::Vector3d& point, bool looksLikeSeed = true) const
  {
    LeakDepth depth;
    EXPECT_TRUE(FindLeakDepth(this->Inside, this->Grid, point, this->Seed, looksLikeSeed, SerialFor,
      NeverStop, depth));
    return depth;
  }

  static BlockGrid MakeGrid()
  {
    ImageGeometry voxels;
    voxels.Dimensions = { { 64, 32, 32 } };
    return { voxels, 1 };
  }

  BlockGrid Grid = MakeGrid();
  SeedSphere Seed{ { 16, 16, 16 }, 6 };
  Eigen::Vector3d Ball{ 50, 16, 16 };
  std::vector<unsigned char> Inside;
};

} // namespace

TEST(LeakDepth, OfAPartThatHangsOnByANeck)
{
  const Example example(4);
  const LeakDepth depth = example.Find(example.Ball);
  EXPECT_TRUE(depth.HasNeck);
  EXPECT_TRUE(depth.IsDeep);
  EXPECT_TRUE(depth.IsCore[example.Grid.BlockAt(example.Ball)]);
  EXPECT_FALSE(depth.IsCore[example.Grid.BlockAt(example.Seed.Center)]);
  EXPECT_FALSE(example.Find(example.Ball, false).IsDeep);
}

TEST(LeakDepth, NoNeckIfItIsWideOrThePointAtTheRim)
{
  const Example wide(8.5);
  EXPECT_FALSE(wide.Find(wide.Ball).HasNeck);
  const Example narrow(4);
  const LeakDepth depth = narrow.Find(narrow.Ball + Eigen::Vector3d(0, 7, 0));
  EXPECT_FALSE(depth.HasNeck);
  EXPECT_FALSE(depth.IsDeep);
}

TEST(LeakDepth, Stops)
{
  const Example example(4);
  LeakDepth depth;
  EXPECT_FALSE(FindLeakDepth(
    example.Inside, example.Grid, example.Ball, example.Seed, true, SerialFor,
    [](double) { return false; }, depth));
}

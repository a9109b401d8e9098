#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BallMorphology.h"
#include "Intensity/LeakControl.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// By repeating until nothing changes: slow, and beyond doubt.
std::vector<unsigned char> ConnectedByRepetition(const std::vector<unsigned char>& mask,
  const ImageGeometry& geometry, const std::vector<std::size_t>& sources)
{
  std::vector<unsigned char> reached(mask.size(), 0);
  for (std::size_t voxel : sources)
  {
    reached[voxel] = mask[voxel];
  }
  for (bool changed = true; changed;)
  {
    changed = false;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        const auto at = [&](int di, int dj, int dk)
        {
          return geometry.Contains(i + di, j + dj, k + dk) &&
            reached[geometry.Offset(i + di, j + dj, k + dk)];
        };
        const std::size_t voxel = geometry.Offset(i, j, k);
        if (mask[voxel] && !reached[voxel] &&
          (at(1, 0, 0) || at(-1, 0, 0) || at(0, 1, 0) || at(0, -1, 0) || at(0, 0, 1) ||
            at(0, 0, -1)))
        {
          reached[voxel] = 1;
          changed = true;
        }
      });
  }
  return reached;
}

} // namespace

TEST(LeakControl, KeepsWhatAFloodReaches)
{
  std::mt19937 random(4);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (double part : { 0.3, 0.6, 0.7, 0.9, 1.0 })
    {
      const std::vector<unsigned char> mask = RandomMask(geometry, part, random);
      std::uniform_int_distribution<std::size_t> anyVoxel(0, mask.size() - 1);
      const std::vector<std::size_t> sources{ anyVoxel(random), anyVoxel(random) };
      BitMask kept = BitsOf(mask, geometry);
      ASSERT_TRUE(KeepConnected(kept, sources, NeverStop));
      ASSERT_EQ(BytesOf(kept), ConnectedByRepetition(mask, geometry, sources));
    }
  }
}

TEST(LeakControl, AMazeIsWalkedToItsEnd)
{
  // Every second row is a wall with a gap at its one end or its other.
  const ImageGeometry geometry = Grid({ { 200, 41, 1 } }, { 1, 1, 1 });
  std::vector<unsigned char> mask(geometry.NumberOfVoxels(), 1);
  for (int j = 1; j < 41; j += 2)
  {
    for (int i = 0; i < 200; ++i)
    {
      mask[geometry.Offset(i, j, 0)] = i == (j % 4 == 1 ? 199 : 0);
    }
  }
  BitMask kept = BitsOf(mask, geometry);
  ASSERT_TRUE(KeepConnected(kept, { 0 }, NeverStop));
  EXPECT_EQ(BytesOf(kept), mask);
  EXPECT_FALSE(KeepConnected(kept, { 0 }, [](double) { return false; }));
  EXPECT_EQ(BytesOf(kept), mask);
}

TEST(LeakControl, CutsAThinBridgeAndKeepsTheSeedsSide)
{
  // Two cubes of 16 mm with a bridge of 2 mm between them.
  const ImageGeometry geometry = Grid({ { 60, 24, 24 } }, { 1, 1, 1 });
  std::vector<unsigned char> mask(geometry.NumberOfVoxels(), 0);
  std::vector<unsigned char> first = mask;
  ForEachVoxel(VoxelBox{ { { 4, 4, 4 } }, { { 56, 20, 20 } } },
    [&](int i, int j, int k)
    {
      const bool bridge = j >= 11 && j < 13 && k >= 11 && k < 13;
      const bool cube = i < 20 || i >= 40;
      mask[geometry.Offset(i, j, k)] = cube || bridge;
      first[geometry.Offset(i, j, k)] = i < 20;
    });
  BitMask kept = BitsOf(mask, geometry);
  ASSERT_TRUE(ControlLeaks(kept, { { 12, 12, 12 }, 3 }, { 0, 3 }, ScatteredFor, NeverStop));
  std::size_t lost = 0;
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const std::size_t voxel = geometry.Offset(i, j, k);
      // The ball bulges a little into the bridge's mouth.
      ASSERT_TRUE(!kept(i, j, k) || (mask[voxel] && i < 22)) << i << " " << j << " " << k;
      lost += !kept(i, j, k) && first[voxel];
    });
  EXPECT_LT(lost, 1000U); // the cube's edges and corners, which a ball does not fill

  BitMask open = BitsOf(mask, geometry);
  ASSERT_TRUE(ControlLeaks(open, { { 12, 12, 12 }, 3 }, { 0, 0 }, SerialFor, NeverStop));
  EXPECT_EQ(BytesOf(open), mask);
}

// All by itself, and once more asked what is connected to the seed.
TEST(LeakControl, IsClosingOpeningAndConnectionOneAfterTheOther)
{
  const ImageGeometry geometry = Grid({ { 140, 40, 30 } }, { 0.7, 0.9, 1.5 });
  const SeedSphere seed{ { 50, 18, 22 }, 4 };
  const std::vector<std::size_t> sources = VoxelsInSphere(geometry, seed);
  std::mt19937 random(8);
  std::size_t cut = 0;
  for (int repetition = 0; repetition < 20; ++repetition)
  {
    BitMask mask(geometry);
    for (int blob = 0; blob < 40; ++blob)
    {
      const auto place = [&](int size) { return static_cast<int>(random() % (size - 10)); };
      const std::array<int, 3> first = blob == 0
        ? std::array<int, 3>{ { 66, 14, 10 } }
        : std::array<int, 3>{ { place(140), place(40), place(30) } };
      for (int k = first[2]; k < first[2] + 9; ++k)
      {
        for (int j = first[1]; j < first[1] + 10; ++j)
        {
          mask.InsertRun(first[0], std::min(140, first[0] + (blob == 0 ? 20 : 5 + blob % 14)), j,
            k);
        }
      }
    }
    const LeakControlRadii radii{ 1.0, 3.0 };
    BitMask expected = mask;
    ASSERT_TRUE(Dilate(expected, radii.Closing, SerialFor, NeverStop));
    ASSERT_TRUE(Erode(expected, radii.Closing, SerialFor, NeverStop));
    ASSERT_TRUE(Erode(expected, radii.Opening, SerialFor, NeverStop));
    const std::size_t before = expected.Count();
    ASSERT_TRUE(KeepConnected(expected, sources, NeverStop));
    cut += before - expected.Count();
    ASSERT_GT(expected.Count(), 0U);
    ASSERT_TRUE(Dilate(expected, radii.Opening, SerialFor, NeverStop));
    ASSERT_TRUE(KeepConnected(expected, sources, NeverStop));
    ASSERT_TRUE(ControlLeaks(mask, seed, radii, ScatteredFor, NeverStop));
    ASSERT_EQ(mask, expected);
  }
  EXPECT_GT(cut, 0U);
}

TEST(LeakControl, AnOpeningThatLeavesNothingIsNotApplied)
{
  const ImageGeometry geometry = Grid({ { 40, 9, 9 } }, { 1, 1, 1 });
  BitMask rod(geometry);
  for (int row = 0; row < 9; ++row)
  {
    rod.InsertRun(2, 38, 3 + row % 3, 3 + row / 3);
  }
  BitMask kept = rod;
  ASSERT_TRUE(ControlLeaks(kept, { { 20, 4, 4 }, 1 }, { 0, 4 }, SerialFor, NeverStop));
  EXPECT_EQ(kept, rod);
}

TEST(LeakControl, ClosingFillsAHole)
{
  const ImageGeometry geometry = Grid({ { 30, 30, 30 } }, { 1, 1, 1 });
  BitMask full(geometry);
  for (int row = 0; row < 400; ++row)
  {
    full.InsertRun(5, 25, 5 + row % 20, 5 + row / 20);
  }
  BitMask hole(geometry);
  hole.InsertRun(14, 16, 15, 15);
  BitMask pierced = full;
  pierced.Remove(hole);
  ASSERT_TRUE(ControlLeaks(pierced, { { 10, 10, 10 }, 2 }, { 1.5, 0 }, SerialFor, NeverStop));
  EXPECT_EQ(pierced, full);
}

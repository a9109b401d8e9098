// Where labels lie, against brute force, and what is not a label map.
#include "Image/LabelBoxes.h"

#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace FlipFree;

TEST(LabelBoxes, AreThoseOfBruteForce)
{
  const ImageGeometry geometry = Grid({ { 17, 9, 6 } }, { 1, 1, 1 });
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial)
  {
    std::vector<short> labels(geometry.NumberOfVoxels(), 0);
    for (const short label : { short{ 2 }, short{ -3 }, short{ 300 }, short{ 2 } })
    {
      ForEachVoxel(RandomBox(geometry, random),
        [&](int i, int j, int k) { labels[geometry.Offset(i, j, k)] = label; });
    }
    LabelBoxes expected;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        if (const short label = labels[geometry.Offset(i, j, k)])
        {
          VoxelBox& box = expected[label];
          box = box.Joined({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } });
        }
      });
    LabelBoxes found;
    ASSERT_TRUE(FindLabelBoxes(ImageView<short>{ labels.data(), geometry }, 3, found));
    EXPECT_TRUE(found == expected);
  }
}

TEST(LabelBoxes, AreOfWholeNumbersAndFewOfThem)
{
  const ImageGeometry geometry = Grid({ { 4, 1, 1 } }, { 1, 1, 1 });
  const auto isLabelMap = [&](const std::vector<double>& voxels)
  {
    LabelBoxes boxes;
    return FindLabelBoxes(ImageView<double>{ voxels.data(), geometry }, 2, boxes);
  };
  EXPECT_TRUE(isLabelMap({ 0, 0, 0, 0 }));
  EXPECT_TRUE(isLabelMap({ 7, 0, -7, 7 }));
  EXPECT_FALSE(isLabelMap({ 7, 1, -7, 7 }));
  EXPECT_FALSE(isLabelMap({ 0, 0.5, 0, 0 }));
  EXPECT_FALSE(isLabelMap({ 0, 0, 0, 2e9 }));
  EXPECT_FALSE(isLabelMap({ 0, 0, std::numeric_limits<double>::quiet_NaN(), 0 }));
}

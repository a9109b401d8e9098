// The range of gray values that pictures show.
#include "Image/DisplayWindow.h"

#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

using namespace FlipFree;

namespace
{

using Window = std::array<double, 2>;

} // namespace

TEST(DisplayWindow, IsFromTheFirstToTheLastPercentile)
{
  std::vector<double> values(101);
  std::iota(values.rbegin(), values.rend(), 200);
  EXPECT_EQ(DisplayWindowOf(values), (Window{ { 201, 299 } }));
  values.front() = 1e6; // no more than the greatest
  EXPECT_EQ(DisplayWindowOf(values), (Window{ { 201, 299 } }));
}

TEST(DisplayWindow, OfACTIsTheAbdominalOne)
{
  EXPECT_EQ(DisplayWindowOf({ -1000, -1000, 40, 120, 120 }), (Window{ { -150, 250 } }));
  EXPECT_EQ(DisplayWindowOf({ -1000, -1000, 40, 40 }), (Window{ { -1000, 40 } }));
}

TEST(DisplayWindow, IsNeverEmpty)
{
  EXPECT_EQ(DisplayWindowOf(std::vector<double>()), (Window{ { 0, 1 } }));
  EXPECT_EQ(DisplayWindowOf({ 7, 7, 7 }), (Window{ { 7, 8 } }));
}

TEST(DisplayWindow, OfAnImageLooksAtFiniteVoxelsOfAny)
{
  const ImageGeometry geometry = Grid({ { 200, 200, 100 } }, { 1, 1, 1 });
  std::vector<float> voxels(geometry.NumberOfVoxels(), 5);
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    // Every fourth is looked at.
    voxels[voxel] = voxel % 4 != 0 ? 1e9F
      : voxel % 8 == 0             ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(voxel % 100);
  }
  EXPECT_EQ(DisplayWindowOf(ImageView<float>{ voxels.data(), geometry }), (Window{ { 0, 96 } }));
}

// How much a voxel resembles the middle of a bright tube.
#include "ExampleVessels.h"
#include "Vessel/Tubeness.h"
#include "Vessel/VesselImage.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

double TubenessAt(FloatImage image, int i, int j, int k)
{
  SmoothInside(image, 3, SerialFor);
  const std::vector<unsigned char> all(image.Voxels.size(), 1);
  return BrightTubeness(image, all, 3, SerialFor)[image.Geometry.Offset(i, j, k)];
}

FloatImage ImageWhere(const std::function<bool(int i, int j, int k)>& isBright)
{
  FloatImage image;
  image.Geometry = Grid({ { 40, 40, 40 } }, { 1.5, 1.5, 1.5 });
  image.Voxels.resize(image.Geometry.NumberOfVoxels());
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k)
    { image.Voxels[image.Geometry.Offset(i, j, k)] = isBright(i, j, k) ? 150.0F : 50.0F; });
  return image;
}

} // namespace

TEST(Tubeness, IsHighInATubeAlone)
{
  const FloatImage tube =
    ImageWhere([](int i, int j, int) { return std::hypot(i - 20, j - 20) < 2.9; });
  EXPECT_GT(TubenessAt(tube, 20, 20, 20), 20);
  EXPECT_EQ(TubenessAt(tube, 32, 20, 20), 0);
  const FloatImage body = ImageWhere([](int i, int, int) { return i >= 20; });
  for (const int i : { 15, 18, 20, 22, 25, 30 })
  {
    EXPECT_LT(TubenessAt(body, i, 20, 20), 1) << i;
  }
  const FloatImage dark =
    ImageWhere([](int i, int j, int) { return std::hypot(i - 20, j - 20) >= 2.9; });
  EXPECT_EQ(TubenessAt(dark, 20, 20, 20), 0);
}

TEST(Tubeness, IsSoughtWhereItIsWanted)
{
  const FloatImage tube =
    ImageWhere([](int i, int j, int) { return std::hypot(i - 20, j - 20) < 2.9; });
  const std::vector<unsigned char> none(tube.Voxels.size(), 0);
  for (const float value : BrightTubeness(tube, none, 3, SerialFor))
  {
    ASSERT_EQ(value, 0);
  }
}

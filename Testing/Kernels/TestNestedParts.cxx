// Parts behind necks, from large to small ones.
#include "Evidence/NestedParts.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace FlipFree;

namespace
{

// Two balls of 20 mm, connected by a bar.
class Dumbbell
{
public:
  explicit Dumbbell(double bar)
  {
    this->Geometry.Dimensions = { { 100, 50, 50 } };
    std::vector<unsigned char> mask(this->Geometry.NumberOfVoxels(), 0);
    for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      const double y = index[1] - 25;
      const double z = index[2] - 25;
      const bool isInBar = index[0] > 24 && index[0] < 76 && std::hypot(y, z) < bar;
      const double x = std::min(std::abs(index[0] - 24), std::abs(index[0] - 76));
      mask[voxel] = isInBar || Eigen::Vector3d(x, y, z).norm() < 20 ? 1 : 0;
    }
    this->Squared = SquaredDistance(mask, this->Geometry, 0, SerialFor, NeverStop);
  }

  NestedPart PartAt(int x, const std::vector<std::size_t>& seed,
    const std::vector<std::size_t>& others) const
  {
    return NestedParts(this->Squared, this->Geometry, seed, 0.6)
      .PartAround(this->At(x), others, 0.6);
  }

  std::size_t At(int x) const { return this->Geometry.Offset(x, 25, 25); }

  ImageGeometry Geometry;

private:
  std::vector<float> Squared;
};

bool Holds(const NestedPart& part, std::size_t voxel)
{
  return std::binary_search(part.Voxels.begin(), part.Voxels.end(), voxel);
}

} // namespace

TEST(NestedParts, NarrowNecksAlwaysDivide)
{
  const Dumbbell shape(11);
  const NestedPart part = shape.PartAt(76, {}, {});
  EXPECT_TRUE(Holds(part, shape.At(80)));
  EXPECT_FALSE(Holds(part, shape.At(24)));
  EXPECT_EQ(part.NeckRatio, 0.6);
}

TEST(NestedParts, WideNecksDivideWhereSomethingElseLiesBeyond)
{
  const Dumbbell shape(17);
  EXPECT_TRUE(Holds(shape.PartAt(76, {}, {}), shape.At(24)));
  const std::vector<std::size_t> far{ shape.At(24) };
  for (const NestedPart& part : { shape.PartAt(76, far, {}), shape.PartAt(76, {}, far) })
  {
    EXPECT_TRUE(Holds(part, shape.At(76)));
    EXPECT_FALSE(Holds(part, shape.At(24)));
    EXPECT_NEAR(part.NeckRatio, 0.9, 1e-9);
  }
}

TEST(NestedParts, ThereIsNoneUnderAShallowVoxel)
{
  EXPECT_TRUE(Dumbbell(11).PartAt(92, {}, {}).Voxels.empty());
}

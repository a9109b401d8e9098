// What points change in a foreground.
#include "Image/VoxelOffsets.h"
#include "Intensity/ForegroundCorrection.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// A bright ball of 24 mm about the middle of a dark image.
struct BallImage
{
  explicit BallImage(const Eigen::Vector3d& spacing)
  {
    this->Geometry.Spacing = spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Geometry.Dimensions[axis] = static_cast<int>(64 / spacing[axis]) + 1;
    }
    this->Geometry.Origin.setConstant(-32);
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), 0.0F);
    this->Ball(24).ForEach([this](std::size_t voxel) { this->Voxels[voxel] = 100; });
  }

  BitMask Ball(double radius) const
  {
    BitMask ball(this->Geometry);
    for (const std::size_t voxel :
      VoxelsInSphere(this->Geometry, { Eigen::Vector3d::Zero(), radius }))
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      ball.Insert(index[0], index[1], index[2]);
    }
    return ball;
  }

  BitMask Corrected(BitMask foreground, const ConstraintList& constraints) const
  {
    const SeedSphere seed{ Eigen::Vector3d::Zero(), 6 };
    EXPECT_TRUE(CorrectForeground(
      ImageView<float>{ this->Voxels.data(), this->Geometry }, [](const VoxelBox&) { return true; },
      seed, constraints, 2, Modality::CT, SerialFor, NeverStop, foreground));
    return foreground;
  }

  bool IsAt(const BitMask& mask, double x, double y, double z) const
  {
    const std::array<int, 3> voxel = NearestVoxel(this->Geometry, { x, y, z });
    return mask(voxel[0], voxel[1], voxel[2]);
  }

  ImageGeometry Geometry;
  std::vector<float> Voxels;
};

} // namespace

TEST(ForegroundCorrection, MovesTheBoundaryAroundThePoint)
{
  BallImage image({ 1, 1, 1 });
  // Below, what is missed looks different.
  image.Ball(24).ForEach(
    [&](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
      const Eigen::Vector3d at =
        image.Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
      image.Voxels[voxel] = at[1] < -3 && at.norm() > 18 ? 0.0F : 100.0F;
    });
  const BitMask inside =
    image.Corrected(image.Ball(18), { { ConstraintKind::Inside, { 23, 0, 0 }, 0 } });
  EXPECT_TRUE(image.IsAt(inside, 23, 0, 0));
  EXPECT_TRUE(image.IsAt(inside, 18, 7, 0));
  EXPECT_TRUE(image.IsAt(inside, 13.4, 13.4, 0));
  EXPECT_FALSE(image.IsAt(inside, 13.4, -13.4, 0));
  EXPECT_FALSE(image.IsAt(inside, -19, 0, 0));
  EXPECT_FALSE(image.IsAt(inside, 0, 19, 0));

  const BitMask outside =
    image.Corrected(image.Ball(28), { { ConstraintKind::Outside, { 25, 0, 0 }, 0 } });
  EXPECT_FALSE(image.IsAt(outside, 25, 0, 0));
  EXPECT_FALSE(image.IsAt(outside, 25.5, 8, 0));
  EXPECT_TRUE(image.IsAt(outside, 21, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, -27, 0, 0));
}

// The ball that is certain around a point is not as large as thick slices are thick.
TEST(ForegroundCorrection, TakesLittleWhereSlicesAreThick)
{
  const BallImage image({ 1, 1, 8 });
  const BitMask outside =
    image.Corrected(image.Ball(24), { { ConstraintKind::Outside, { 23, 0, 0 }, 0 } });
  EXPECT_FALSE(image.IsAt(outside, 23, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, 20, 4, 0));
  EXPECT_TRUE(image.IsAt(outside, 17, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, 20, -4, 0));
}

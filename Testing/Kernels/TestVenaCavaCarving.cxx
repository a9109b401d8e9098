// The vein beside a liver: found, told from others, and carved.
#include "Evidence/VenaCavaCarving.h"
#include "ExampleSurfaces.h"
#include "ExampleVolumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

using namespace FlipFree;

namespace
{

// A liver of 1090 ml, and beside it a vein of the same gray value, in LPS coordinates.
struct Abdomen
{
  Abdomen()
  {
    this->Geometry.Dimensions = { { 110, 90, 50 } };
    this->Geometry.Spacing = { 2, 2, 4 };
  }
  Abdomen(const Abdomen&) = delete; // the shapes refer to it
  void operator=(const Abdomen&) = delete;

  ImageGeometry Geometry;
  Eigen::Vector3d Vein{ 158, 127, 0 };
  double Radius = 11;
  double Bottom = -1e3; // of the vein
  double Top = 1e3;
  SeedSphere Seed{ { 80, 90, 100 }, 25 };
  Shape Liver = [](const Eigen::Vector3d& point)
  {
    return std::abs(point.z() - 100) < 45 &&
      std::hypot((point.x() - 110) / 70, (point.y() - 90) / 55) < 1;
  };
  Shape Tube = [this](const Eigen::Vector3d& point)
  {
    return point.z() > this->Bottom && point.z() < this->Top &&
      (point - this->Vein).head<2>().norm() < this->Radius;
  };
  Shape Organ = [this](const Eigen::Vector3d& point)
  { return this->Liver(point) && !this->Tube(point); };
  // What a surface finds: a part of the vein beyond the liver, too.
  Shape Found = [this](const Eigen::Vector3d& point)
  { return this->Liver(point) || (this->Tube(point) && std::abs(point.z() - 100) < 53); };

  FloatImage Image() const
  {
    const auto bright = [this](const Eigen::Vector3d& point)
    { return this->Liver(point) || this->Tube(point); };
    return ImageOf(this->Geometry, bright, 100, -80, 1.5, 6);
  }
};

BitMask Carved(const Abdomen& abdomen, const FloatImage& image, const BitMask& mask,
  Modality modality = Modality::CT)
{
  BitMask carved = mask;
  EXPECT_TRUE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return true; }, abdomen.Seed, modality, SerialFor,
    NeverStop, carved));
  return carved;
}

void ExpectCarved(const Abdomen& abdomen)
{
  const BitMask organ = MaskOf(abdomen.Geometry, abdomen.Organ);
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  const BitMask carved = Carved(abdomen, abdomen.Image(), found);
  BitMask vein = found;
  vein.Remove(organ);
  BitMask left = vein;
  left.Intersect(carved);
  EXPECT_LT(left.Count(), 0.5 * static_cast<double>(vein.Count()));
  BitMask lost = organ;
  lost.Remove(carved);
  EXPECT_LT(lost.Count(), 0.012 * static_cast<double>(organ.Count()));
  EXPECT_GT(Dice(carved, organ), Dice(found, organ) + 0.005);
}

void ExpectUntouched(const Abdomen& abdomen)
{
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  EXPECT_EQ(Carved(abdomen, abdomen.Image(), found), found);
}

} // namespace

TEST(VenaCavaCarving, CarvesTheVeinOutOfALiver)
{
  ExpectCarved(Abdomen());
  Abdomen abdomen;
  abdomen.Radius = 9;
  ExpectCarved(abdomen);
}

// Axes in another order, and against those of the body.
TEST(VenaCavaCarving, KnowsTheBodysAxes)
{
  Abdomen abdomen;
  abdomen.Geometry = Grid({ { 50, 110, 90 } }, { 4, 2, 2 });
  abdomen.Geometry.Direction << 0, -1, 0, 0, 0, -1, -1, 0, 0;
  abdomen.Geometry.Origin = { 218, 178, 196 };
  ExpectCarved(abdomen);
}

TEST(VenaCavaCarving, IsTheSameHoweverTheWorkIsDivided)
{
  const Abdomen abdomen;
  const FloatImage image = abdomen.Image();
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  BitMask other = found;
  ASSERT_TRUE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return true; }, abdomen.Seed, Modality::CT, ScatteredFor,
    NeverStop, other));
  EXPECT_EQ(other, Carved(abdomen, image, found));
}

// Stored from left to right and from top to bottom, it is the same.
TEST(VenaCavaCarving, DoesNotDependOnHowTheImageIsStored)
{
  const Abdomen abdomen;
  const BitMask carved = Carved(abdomen, abdomen.Image(), MaskOf(abdomen.Geometry, abdomen.Found));
  Abdomen flipped;
  flipped.Geometry.Direction.diagonal() << -1, -1, -1;
  flipped.Geometry.Origin = { 218, 178, 196 };
  FloatImage image = abdomen.Image();
  std::reverse(image.Voxels.begin(), image.Voxels.end());
  image.Geometry = flipped.Geometry;
  const BitMask other = Carved(flipped, image, MaskOf(flipped.Geometry, flipped.Found));
  std::size_t different = 0;
  ForEachVoxel(abdomen.Geometry,
    [&](int i, int j, int k) { different += carved(i, j, k) != other(109 - i, 89 - j, 49 - k); });
  EXPECT_LE(different, 100U); // where a place is as near to one slice as to the next
}

TEST(VenaCavaCarving, LeavesALiverWithoutAVein)
{
  Abdomen abdomen;
  abdomen.Radius = 0;
  ExpectUntouched(abdomen);
}

TEST(VenaCavaCarving, LeavesATubeOnTheOtherSide)
{
  Abdomen abdomen;
  abdomen.Vein = { 60, 128, 0 };
  ExpectUntouched(abdomen);
}

// It has to go on below or above the liver, which ends at 55 and 145 mm.
TEST(VenaCavaCarving, LeavesATubeThatEndsWithTheLiver)
{
  const auto expect = [](double bottom, double top, bool carves)
  {
    SCOPED_TRACE(bottom);
    SCOPED_TRACE(top);
    Abdomen abdomen;
    abdomen.Bottom = bottom;
    abdomen.Top = top;
    carves ? ExpectCarved(abdomen) : ExpectUntouched(abdomen);
  };
  expect(55, 145, false);
  expect(48, 145, false);
  expect(30, 145, true);
  expect(55, 152, false);
  expect(55, 200, true);
}

// As bright as the vein and as wide, but no longer than a slice or two.
TEST(VenaCavaCarving, LeavesALoneDiskBesideTheLiver)
{
  for (const auto& [bottom, top] : { std::pair(40.0, 50.0), std::pair(147.0, 152.0) })
  {
    SCOPED_TRACE(bottom);
    Abdomen abdomen;
    abdomen.Bottom = bottom;
    abdomen.Top = top;
    ExpectUntouched(abdomen);
  }
}

TEST(VenaCavaCarving, LeavesAVeinThatHoldsTheSeed)
{
  Abdomen abdomen;
  abdomen.Seed = { { 158, 127, 100 }, 8 };
  ExpectUntouched(abdomen);
}

// Nothing would be connected with it.
TEST(VenaCavaCarving, LeavesAMaskWithoutTheSeed)
{
  Abdomen abdomen;
  abdomen.Seed = { { 20, 20, 20 }, 8 };
  ExpectUntouched(abdomen);
}

// A lobe that hangs on to the rest by the vein alone is not lost with it.
TEST(VenaCavaCarving, KeepsALobeBehindTheVein)
{
  Abdomen abdomen;
  const Shape liver = abdomen.Liver;
  abdomen.Liver = [liver](const Eigen::Vector3d& point)
  {
    const bool isGap = point.x() > 155 && point.x() < 163 && std::abs(point.y() - 127) > 6;
    return liver(point) && !isGap;
  };
  ExpectUntouched(abdomen);
}

TEST(VenaCavaCarving, LeavesMR)
{
  const Abdomen abdomen;
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  EXPECT_EQ(Carved(abdomen, abdomen.Image(), found, Modality::MR), found);
}

// Of 700 ml or more.
TEST(VenaCavaCarving, IsDoneInLargeOrgans)
{
  for (const double height : { 22.0, 45.0, 170.0 })
  {
    SCOPED_TRACE(height);
    Abdomen abdomen;
    abdomen.Geometry.Dimensions[2] = 100;
    abdomen.Vein.z() = 200;
    abdomen.Seed.Center.z() = 200;
    abdomen.Liver = [height](const Eigen::Vector3d& point)
    {
      return std::abs(point.z() - 200) < height &&
        std::hypot((point.x() - 110) / 70, (point.y() - 90) / 55) < 1;
    };
    abdomen.Found = abdomen.Liver;
    height == 22 ? ExpectUntouched(abdomen) : ExpectCarved(abdomen);
  }
}

TEST(VenaCavaCarving, FollowsTheVeinThroughThickSlices)
{
  for (const double slice : { 8.0, 10.0, 12.0 })
  {
    SCOPED_TRACE(slice);
    Abdomen thick;
    thick.Geometry.Dimensions[2] = static_cast<int>(200 / slice);
    thick.Geometry.Spacing[2] = slice;
    ExpectCarved(thick);
  }
}

TEST(VenaCavaCarving, LeavesSlicesThroughWhichAVeinCannotBeFollowed)
{
  for (const double slice : { 20.0, 50.0, 300.0 })
  {
    Abdomen thick;
    thick.Geometry.Dimensions[2] = 10;
    thick.Geometry.Spacing[2] = slice;
    ExpectUntouched(thick);
  }
}

TEST(VenaCavaCarving, ReadsOnlyWhatItAskedFor)
{
  const Abdomen abdomen;
  FloatImage image = abdomen.Image();
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  const BitMask expected = Carved(abdomen, image, found);
  VoxelBox asked;
  const auto carve = [&](BitMask& mask)
  {
    return CarveVenaCava(
      image.View(),
      [&asked](const VoxelBox& box)
      {
        asked = asked.Joined(box);
        return true;
      },
      abdomen.Seed, Modality::CT, SerialFor, NeverStop, mask);
  };
  BitMask mask = found;
  ASSERT_TRUE(carve(mask));
  EXPECT_LT(asked.Size(0), abdomen.Geometry.Dimensions[0]);
  ForEachVoxel(abdomen.Geometry,
    [&](int i, int j, int k)
    {
      if (!asked.Holds({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } }))
      {
        image.Voxels[abdomen.Geometry.Offset(i, j, k)] = 1000;
      }
    });
  mask = found;
  ASSERT_TRUE(carve(mask));
  EXPECT_EQ(mask, expected);
}

TEST(VenaCavaCarving, Stops)
{
  const Abdomen abdomen;
  const FloatImage image = abdomen.Image();
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  BitMask mask = found;
  EXPECT_FALSE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return false; }, abdomen.Seed, Modality::CT, SerialFor,
    NeverStop, mask));
  for (int allowed = 0; allowed < 2; ++allowed)
  {
    int asked = 0;
    mask = found;
    EXPECT_FALSE(CarveVenaCava(
      image.View(), [](const VoxelBox&) { return true; }, abdomen.Seed, Modality::CT, SerialFor,
      [&](double) { return asked++ < allowed; }, mask));
    EXPECT_EQ(asked, allowed + 1);
  }
}

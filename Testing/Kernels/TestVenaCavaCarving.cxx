// The vein beside a liver: found, told from others, and carved.
#include "ExampleSurfaces.h"
#include "ExampleVolumes.h"
#include "Intensity/VenaCavaCarving.h"
#include "Intensity/VesselTrack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace FlipFree;

namespace
{

// A liver of 1090 ml, as tall as its surface's inside, and beside it a vein of the same gray value,
// in LPS coordinates.
struct Abdomen
{
  Abdomen() = default;
  Abdomen(const Abdomen&) = delete; // the shapes refer to it
  void operator=(const Abdomen&) = delete;

  ImageGeometry Geometry = Grid({ { 110, 90, 50 } }, { 2, 2, 4 });
  Eigen::Vector3d Vein{ 155, 124, 0 };
  double Radius = 11;
  SeedSphere Seed{ { 80, 90, 100 }, 25 };
  Shape Liver = [](const Eigen::Vector3d& point)
  {
    return std::abs(point.z() - 100) < 45 &&
      std::hypot((point.x() - 110) / 70, (point.y() - 90) / 55) < 1;
  };
  Shape Tube = [this](const Eigen::Vector3d& point)
  { return (point - this->Vein).head<2>().norm() < this->Radius; };
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
    image.View(), [](const VoxelBox&) { return true; }, {}, abdomen.Seed, modality, SerialFor,
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
  EXPECT_LT(left.Count(), 0.4 * static_cast<double>(vein.Count()));
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
    image.View(), [](const VoxelBox&) { return true; }, {}, abdomen.Seed, Modality::CT,
    ScatteredFor, NeverStop, other));
  EXPECT_EQ(other, Carved(abdomen, image, found));
}

// The inside of the surface tells of the vein, where the mask has lost it.
TEST(VenaCavaCarving, FollowsTheInsideOfTheSurface)
{
  const Abdomen abdomen;
  const FloatImage image = abdomen.Image();
  const BitMask organ = MaskOf(abdomen.Geometry, abdomen.Organ);
  std::vector<VoxelRun> inside;
  MaskOf(abdomen.Geometry, abdomen.Found)
    .ForEachRun(0, abdomen.Geometry.Dimensions[2],
      [&inside](int begin, int end, int j, int k) {
        inside.push_back({ j, k, begin, end });
      });
  BitMask mask = MaskOf(abdomen.Geometry,
    [&](const Eigen::Vector3d& point) { return abdomen.Found(point) && point.z() < 110; });
  BitMask expected = organ;
  BitMask part = mask;
  part.Remove(organ);
  ASSERT_TRUE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return true; }, inside, abdomen.Seed, Modality::CT,
    SerialFor, NeverStop, mask));
  BitMask left = part;
  left.Intersect(mask);
  EXPECT_LT(left.Count(), 0.4 * static_cast<double>(part.Count()));
}

TEST(VenaCavaCarving, LeavesALiverWithoutAVein)
{
  Abdomen abdomen;
  abdomen.Radius = 0;
  ExpectUntouched(abdomen);
}

// It would have to be somewhere else, or to go on beyond the liver.
TEST(VenaCavaCarving, LeavesOtherTubes)
{
  Abdomen abdomen;
  abdomen.Vein = { 65, 124, 0 };
  ExpectUntouched(abdomen);
  Abdomen within;
  within.Tube = [](const Eigen::Vector3d& point)
  { return std::abs(point.z() - 100) < 45 && std::hypot(point.x() - 155, point.y() - 124) < 11; };
  ExpectUntouched(within);
}

TEST(VenaCavaCarving, LeavesAVeinThatHoldsTheSeed)
{
  Abdomen abdomen;
  abdomen.Seed = { { 155, 124, 100 }, 8 };
  ExpectUntouched(abdomen);
}

TEST(VenaCavaCarving, LeavesMRAndSmallOrgans)
{
  Abdomen abdomen;
  const BitMask found = MaskOf(abdomen.Geometry, abdomen.Found);
  EXPECT_EQ(Carved(abdomen, abdomen.Image(), found, Modality::MR), found);
  abdomen.Geometry.Spacing *= 0.8;
  abdomen.Seed = { { 64, 72, 80 }, 20 };
  const BitMask small = found;
  FloatImage image = abdomen.Image();
  image.Geometry = abdomen.Geometry;
  BitMask carved(abdomen.Geometry, found.GetWords());
  ASSERT_TRUE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return true; }, {}, abdomen.Seed, Modality::CT, SerialFor,
    NeverStop, carved));
  EXPECT_EQ(carved, small);
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
      {}, abdomen.Seed, Modality::CT, SerialFor, NeverStop, mask);
  };
  BitMask mask = found;
  ASSERT_TRUE(carve(mask));
  ForEachVoxel(abdomen.Geometry,
    [&](int i, int j, int k)
    {
      if (!asked.Holds({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } }))
      {
        image.Voxels[abdomen.Geometry.Offset(i, j, k)] = std::numeric_limits<float>::quiet_NaN();
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
  BitMask mask = MaskOf(abdomen.Geometry, abdomen.Found);
  EXPECT_FALSE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return false; }, {}, abdomen.Seed, Modality::CT, SerialFor,
    NeverStop, mask));
  int asked = 0;
  EXPECT_FALSE(CarveVenaCava(
    image.View(), [](const VoxelBox&) { return true; }, {}, abdomen.Seed, Modality::CT, SerialFor,
    [&asked](double) { return asked++ < 2; }, mask));
  EXPECT_EQ(asked, 3);
}

TEST(DiskEvidence, IsThatOfDisksInASlice)
{
  const ImageGeometry geometry = Grid({ { 60, 60, 1 } }, { 1, 1, 1 });
  const Shape tube = [](const Eigen::Vector3d& point)
  { return std::hypot(point.x() - 30, point.y() - 30) < 12.5; };
  const FloatImage image = ImageOf(geometry, tube, 100, -80, 0, 0.1);
  DiskGrid grid;
  grid.Slices = { 0 };
  grid.First = { { 30, 30 } };
  grid.Count = { { 3, 1 } };
  const BitMask half =
    MaskOf(geometry, [](const Eigen::Vector3d& point) { return point.y() < 30; });
  const DiskSlice slice = MeasureDisks(image.View(), half, grid, SerialFor)[0];
  const auto at = [](int place, int radius) { return place + 3 * radius; };
  EXPECT_NEAR(slice.Value[at(0, 2)], 100, 1);
  EXPECT_LT(slice.Spread[at(0, 2)], 1);
  EXPECT_EQ(slice.Contrast[at(0, 2)], 1);    // of its own size
  EXPECT_EQ(slice.Contrast[at(0, 0)], 0);    // within
  EXPECT_GT(slice.Contrast[at(1, 1)], 0.3F); // against one side
  EXPECT_LT(slice.Contrast[at(1, 1)], 0.8F);
  EXPECT_GT(slice.Spread[at(2, 3)], 100); // of tube and fat
  EXPECT_NEAR(slice.Covered[at(0, 2)], 8.0 / 19, 0.06);
}

TEST(VesselTrack, IsNoneWithoutDisksInTheMask)
{
  DiskGrid grid;
  grid.Slices = { 0, 1, 2 };
  grid.Thickness = 5;
  grid.Count = { { 4, 4 } };
  const std::vector<float> none(grid.Size(), 0.0F);
  const std::vector<float> clear(grid.Size(), 1.0F);
  const DiskSlice slice{ clear, none, none, none };
  EXPECT_TRUE(FindVesselTrack(grid, { slice, slice, slice }, 0, SerialFor).InOrgan.empty());
}

// The one disk of each slice that stands out, one place further each time.
TEST(VesselTrack, FollowsWhatStandsOut)
{
  DiskGrid grid;
  grid.Thickness = 5;
  grid.First = { { 10, 20 } };
  grid.Count = { { 12, 5 } };
  std::vector<DiskSlice> slices;
  for (int slice = 0; slice < 12; ++slice)
  {
    const bool isIn = slice >= 4 && slice < 9;
    const std::vector<float> values(grid.Size(), 50.0F);
    DiskSlice disks{ std::vector<float>(grid.Size(), 0.1F), values,
      std::vector<float>(grid.Size(), 0.0F), std::vector<float>(grid.Size(), isIn ? 1.0F : 0.0F) };
    disks.Contrast[slice + 12 * (2 + 5 * 1)] = isIn ? 0.6F : 1.0F;
    slices.push_back(disks);
    grid.Slices.push_back(slice);
  }
  const VesselTrack track = FindVesselTrack(grid, slices, 50, SerialFor);
  ASSERT_EQ(track.InOrgan.size(), 5U);
  for (int disk = 0; disk < 5; ++disk)
  {
    EXPECT_EQ(track.InOrgan[disk].Slice, 4 + disk);
    EXPECT_EQ(track.InOrgan[disk].Center, (std::array<double, 2>{ { 22.0 + 3 * disk, 26 } }));
    EXPECT_EQ(track.InOrgan[disk].Radius, 10);
  }
  EXPECT_EQ(track.LengthBefore, 20);
  EXPECT_EQ(track.LengthBehind, 15);
}

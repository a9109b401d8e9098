// Paths through slices of disks that are made by hand.
#include "Evidence/VesselTrack.h"

#include "Image/SeedRegion.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

constexpr int Columns = 14;
constexpr int Rows = 5;

// Slices of which some in the middle are in the organ, of gray value 50; no disk stands out.
struct Scene
{
  DiskGrid Grid;
  std::vector<DiskSlice> Slices;
  int Begin;
  int End;

  explicit Scene(int count = 12, int begin = 4, int end = 8)
    : Begin(begin)
    , End(end)
  {
    this->Grid.Thickness = 5;
    this->Grid.First = { { 10, 20 } };
    this->Grid.Count = { { Columns, Rows } };
    for (int slice = 0; slice < count; ++slice)
    {
      const auto all = [this](float value) { return std::vector<float>(this->Grid.Size(), value); };
      this->Slices.push_back({ all(0), all(50), all(0), all(this->IsIn(slice) ? 1 : 0) });
      this->Grid.Slices.push_back(100 - 2 * slice);
    }
  }

  bool IsIn(int slice) const { return slice >= this->Begin && slice < this->End; }

  static std::size_t Disk(int first, int second, int radius)
  {
    return first + Columns * (second + Rows * radius);
  }

  // Makes a disk stand out, as a vein does that is seen on one side within the organ.
  void Mark(int slice, int first, int second, int radius)
  {
    this->Slices[slice].Contrast[Disk(first, second, radius)] = this->IsIn(slice) ? 0.6F : 1;
  }

  VesselTrack Track() const { return FindVesselTrack(this->Grid, this->Slices, SerialFor); }
};

} // namespace

TEST(VesselTrack, IsNoneWithoutDisksInTheMask)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, 5, 2, 1);
    scene.Slices[slice].Covered.assign(scene.Grid.Size(), 0);
  }
  EXPECT_TRUE(scene.Track().InOrgan.empty());
}

TEST(VesselTrack, FollowsWhatStandsOut)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, slice, 2, 1);
  }
  const VesselTrack track = scene.Track();
  ASSERT_EQ(track.InOrgan.size(), 4U);
  for (int disk = 0; disk < 4; ++disk)
  {
    EXPECT_EQ(track.InOrgan[disk].Slice, 4 + disk);
    EXPECT_EQ(track.InOrgan[disk].Center, (std::array<double, 2>{ { 22.0 + 3 * disk, 26 } }));
    EXPECT_EQ(track.InOrgan[disk].Radius, 10);
  }
  EXPECT_EQ(track.LengthBefore, 20);
  EXPECT_EQ(track.LengthBehind, 20);
}

// Within 5 mm, it moves by 6 mm at most.
TEST(VesselTrack, DoesNotJump)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, slice < 6 ? 1 : 12, 2, 1);
  }
  const VesselTrack track = scene.Track();
  ASSERT_EQ(track.InOrgan.size(), 2U);
  EXPECT_EQ(track.LengthBefore + track.LengthBehind, 20);
}

// By how thick slices were written.
TEST(VesselTrack, ToleratesRoundedSpacings)
{
  for (const double thickness : { 5.0, 4.9999995 })
  {
    Scene scene;
    scene.Grid.Thickness = thickness;
    for (int slice = 0; slice < 12; ++slice)
    {
      scene.Mark(slice, slice < 6 ? 3 : 5, 2, 1);
    }
    EXPECT_EQ(scene.Track().InOrgan.size(), 4U) << thickness;
  }
}

// A bowel beside the organ is darker, calcified plaque brighter.
TEST(VesselTrack, LeavesOtherTissue)
{
  for (const float value : { -15.0F, 255.0F })
  {
    Scene scene;
    for (int slice = 0; slice < 12; ++slice)
    {
      scene.Mark(slice, 5, 2, 1);
      scene.Slices[slice].Value[Scene::Disk(5, 2, 1)] = value;
    }
    EXPECT_TRUE(scene.Track().InOrgan.empty()) << value;
  }
}

TEST(VesselTrack, LeavesDisksOfSeveralTissues)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, 5, 2, 1);
    scene.Slices[slice].Spread[Scene::Disk(5, 2, 1)] = 60;
  }
  EXPECT_LT(scene.Track().InOrgan.size(), 4U);
}

// An aorta that the mask touches once is clearer, and longer outside.
TEST(VesselTrack, PrefersWhatRunsAlongTheOrgan)
{
  Scene scene(24, 9, 15);
  for (int slice = 0; slice < 24; ++slice)
  {
    const std::size_t aorta = Scene::Disk(11, 2, 1);
    scene.Slices[slice].Contrast[aorta] = 1;
    scene.Slices[slice].Covered[aorta] = slice == 12 ? 1 : 0;
    if (slice >= 5 && slice < 19)
    {
      scene.Slices[slice].Contrast[Scene::Disk(2, 2, 1)] = scene.IsIn(slice) ? 0.9F : 1;
    }
  }
  const VesselTrack track = scene.Track();
  ASSERT_EQ(track.InOrgan.size(), 6U);
  EXPECT_EQ(track.InOrgan[0].Center[0], 16);
}

// Disks of several radii touch the one side that is seen.
TEST(VesselTrack, TakesTheUsualRadiusWhereSeveralFit)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, 5, 2, 0);
    scene.Mark(slice, 5, 2, 1);
    scene.Mark(slice, 5, 2, 3);
  }
  EXPECT_EQ(scene.Track().InOrgan.front().Radius, 10);
}

// Of two ways that stand out alike, the one that moves less, and the one as bright as before.
TEST(VesselTrack, KeepsItsPlaceAndItsGrayValue)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, 5, 2, 1);
    if (scene.IsIn(slice))
    {
      scene.Mark(slice, 6, 2, 1);
      scene.Mark(slice, 5, 3, 1);
    }
  }
  for (const auto& disk : scene.Track().InOrgan)
  {
    EXPECT_EQ(disk.Center, (std::array<double, 2>{ { 25, 26 } }));
  }
  for (int slice = 4; slice < 8; ++slice)
  {
    scene.Slices[slice].Value[Scene::Disk(5, 2, 1)] = 120;
  }
  for (const auto& disk : scene.Track().InOrgan)
  {
    EXPECT_NE(disk.Center, (std::array<double, 2>{ { 25, 26 } }));
  }
}

TEST(VesselTrack, IsTheSameHoweverTheWorkIsDivided)
{
  Scene scene;
  for (int slice = 0; slice < 12; ++slice)
  {
    scene.Mark(slice, slice, 2, 1);
  }
  const VesselTrack track = FindVesselTrack(scene.Grid, scene.Slices,
    [](std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
    {
      for (; end > begin; --end)
      {
        body(end - 1, end);
      }
    });
  EXPECT_EQ(track.LengthBefore, scene.Track().LengthBefore);
  EXPECT_EQ(track.LengthBehind, scene.Track().LengthBehind);
}

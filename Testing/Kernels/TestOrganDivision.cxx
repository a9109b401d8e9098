// Which of two organs gets the voxels that both claim.
#include "ExampleMasks.h"
#include "Intensity/OrganDivision.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

// Two boxes side by side along x, with a dark layer of one voxel between them at x = 20.
class TwoBoxes
{
public:
  TwoBoxes()
  {
    this->Image.Geometry = Grid({ { 40, 20, 20 } }, { 1, 1, 1 });
    ForEachVoxel(this->Image.Geometry,
      [&](int i, int, int) { this->Image.Voxels.push_back(i == 20 ? 40.0F : 100.0F); });
  }

  // The voxels with begin <= i < end, in a region that begins at the voxel `first` of the volume.
  OrganClaim Claim(int begin, int end, const Eigen::Vector3d& seed, int first = 0) const
  {
    OrganClaim claim;
    claim.Mask = BitMask(this->Image.Geometry);
    for (int k = 4; k < 16; ++k)
    {
      for (int j = 4; j < 16; ++j)
      {
        claim.Mask.InsertRun(begin, end, j, k);
      }
    }
    claim.Mask = claim.Mask.Cropped({ { { first, 0, 0 } }, { { 40, 20, 20 } } });
    claim.First = { { first, 0, 0 } };
    this->Parts.push_back({ claim.Mask.GetGeometry(), {} });
    ForEachVoxel(claim.Mask.GetGeometry(),
      [&](int i, int j, int k)
      { this->Parts.back().Voxels.push_back(this->Image.View()(i + first, j, k)); });
    claim.Smooth = this->Parts.back().View();
    claim.Seed = { seed, 3 };
    claim.Noise = 4;
    return claim;
  }

  FloatImage Image;

private:
  mutable std::vector<FloatImage> Parts = Reserved();
  static std::vector<FloatImage> Reserved()
  {
    std::vector<FloatImage> parts;
    parts.reserve(16);
    return parts;
  }
};

int Ends(const OrganClaim& claim, bool low)
{
  const VoxelBox bounds = claim.Mask.Bounds();
  return (low ? bounds.Begin[0] : bounds.End[0]) + claim.First[0];
}

} // namespace

// The left one has leaked far into the right one, all of whose voxels but the last are claimed
// twice.
TEST(OrganDivision, FollowsTheLayerBetween)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 35, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(20, 38, { 29, 10, 10 }, 15);
  ASSERT_TRUE(DivideClaims(left, right, Modality::CT, SerialFor, NeverStop));
  EXPECT_NEAR(Ends(left, false), 20, 1);
  EXPECT_EQ(Ends(right, true), Ends(left, false));
  EXPECT_EQ(left.Mask.Count() + right.Mask.Count(), 36u * 12 * 12);
  // The other way round alike.
  OrganClaim again = boxes.Claim(2, 35, { 10, 10, 10 });
  OrganClaim other = boxes.Claim(20, 38, { 29, 10, 10 }, 15);
  ASSERT_TRUE(DivideClaims(other, again, Modality::CT, SerialFor, NeverStop));
  EXPECT_NEAR(Ends(again, false), Ends(left, false), 1);
}

TEST(OrganDivision, LeavesAloneWhatIsClaimedOnce)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 20, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(20, 38, { 29, 10, 10 });
  const BitMask before = left.Mask;
  ASSERT_TRUE(DivideClaims(left, right, Modality::CT, SerialFor, NeverStop));
  EXPECT_EQ(left.Mask, before);
}

// Inside points are kept, and what a cut leaves without connection to the seed goes.
TEST(OrganDivision, KeepsPointsAndWholePieces)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 38, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(14, 30, { 25, 10, 10 });
  left.Constraints.push_back({ ConstraintKind::Inside, { 17, 10, 10 }, 0 });
  ASSERT_TRUE(DivideClaims(left, right, Modality::CT, SerialFor, NeverStop));
  EXPECT_TRUE(left.Mask(17, 10, 10));
  EXPECT_FALSE(left.Mask(33, 10, 10)); // beyond the right one
  EXPECT_TRUE(right.Mask(25, 10, 10));
  BitMask both = left.Mask;
  both.Intersect(right.Mask);
  EXPECT_EQ(both.Count(), 0u);
}

TEST(OrganDivision, CanBeStopped)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 35, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(20, 38, { 29, 10, 10 });
  EXPECT_FALSE(DivideClaims(left, right, Modality::CT, SerialFor, [](double) { return false; }));
}

// Which of two organs gets the voxels that both claim.
#include "Evidence/OrganDivision.h"
#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

bool Divide(OrganClaim& one, OrganClaim& two, const Monitor& monitor = NeverStop)
{
  std::vector<OrganClaim> claims{ one, two };
  const bool done = DivideClaims(claims, Modality::CT, SerialFor, monitor);
  one = claims[0];
  two = claims[1];
  return done;
}

// A cube of voxels around a center.
void SetCube(BitMask& mask, int center, int half, bool inside)
{
  for (int k = 10 - half; k <= 10 + half; ++k)
  {
    for (int j = 10 - half; j <= 10 + half; ++j)
    {
      mask.SetRun(inside, center - half, center + half + 1, j, k);
    }
  }
}

std::size_t CountCommon(const BitMask& one, const BitMask& two)
{
  BitMask both = one;
  both.Intersect(two);
  return both.Count();
}

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
  ASSERT_TRUE(Divide(left, right));
  EXPECT_NEAR(Ends(left, false), 20, 1);
  EXPECT_EQ(Ends(right, true), Ends(left, false));
  EXPECT_EQ(left.Mask.Count() + right.Mask.Count(), 36u * 12 * 12);
  // The other way round alike.
  OrganClaim again = boxes.Claim(2, 35, { 10, 10, 10 });
  OrganClaim other = boxes.Claim(20, 38, { 29, 10, 10 }, 15);
  ASSERT_TRUE(Divide(other, again));
  EXPECT_NEAR(Ends(again, false), Ends(left, false), 1);
}

TEST(OrganDivision, LeavesAloneWhatIsClaimedOnce)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 20, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(20, 38, { 29, 10, 10 });
  const BitMask before = left.Mask;
  ASSERT_TRUE(Divide(left, right));
  EXPECT_EQ(left.Mask, before);
}

// Inside points are kept, and what a cut leaves without connection to the seed goes.
TEST(OrganDivision, KeepsPointsAndWholePieces)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 38, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(14, 30, { 25, 10, 10 });
  left.Constraints.push_back({ ConstraintKind::Inside, { 17, 10, 10 }, 0 });
  ASSERT_TRUE(Divide(left, right));
  EXPECT_TRUE(left.Mask(17, 10, 10));
  EXPECT_FALSE(left.Mask(33, 10, 10)); // beyond the right one
  EXPECT_TRUE(right.Mask(25, 10, 10));
  EXPECT_EQ(CountCommon(left.Mask, right.Mask), 0u);
}

// What one organ gets within another stays its own while the other is divided from a third, and so
// does what is fixed. A hole within the inner organ is left to it.
TEST(OrganDivision, LeavesInnerOrgansAndFixedSurfacesTheirHoles)
{
  const TwoBoxes boxes;
  for (const bool isFixed : { false, true })
  {
    std::vector<OrganClaim> claims;
    claims.push_back(boxes.Claim(2, 30, { 16, 10, 10 }));
    BitMask inner(boxes.Image.Geometry);
    SetCube(inner, 7, 3, true);
    if (isFixed)
    {
      claims[0].Fixed = inner;
    }
    else
    {
      claims.push_back(boxes.Claim(2, 30, { 7, 10, 13 }));
      claims.back().Mask = inner;
      SetCube(claims.back().Mask, 7, 1, false);
      claims.back().Seed = { { 7, 10, 12 }, 1.2 };
      claims.back().Constraints.push_back({ ConstraintKind::Seed, { 7, 10, 10 }, 5.5 });
    }
    claims.push_back(boxes.Claim(20, 38, { 33, 10, 10 }));
    ASSERT_TRUE(DivideClaims(claims, Modality::CT, SerialFor, NeverStop));
    EXPECT_LT(claims.front().Mask.Count(), 28u * 12 * 12 - 343);
    for (std::size_t one = 0; one < claims.size(); ++one)
    {
      for (std::size_t two = 0; two < one; ++two)
      {
        EXPECT_EQ(CountCommon(claims[one].Mask, claims[two].Mask), 0u) << one << " " << two;
      }
      if (isFixed)
      {
        EXPECT_EQ(CountCommon(claims[one].Mask, inner), 0u) << one;
      }
    }
    if (!isFixed)
    {
      EXPECT_FALSE(claims[0].Mask(7, 10, 10));
    }
  }
}

TEST(OrganDivision, CanBeStopped)
{
  const TwoBoxes boxes;
  OrganClaim left = boxes.Claim(2, 35, { 10, 10, 10 });
  OrganClaim right = boxes.Claim(20, 38, { 29, 10, 10 });
  EXPECT_FALSE(Divide(left, right, [](double) { return false; }));
}

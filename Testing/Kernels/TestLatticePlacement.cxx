// Grids on the lattice of another: cropped, wider, with axes turned around or swapped; and what is
// none.
#include "Image/LatticePlacement.h"

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "GridParts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

ImageGeometry Lattice()
{
  ImageGeometry geometry = Grid({ { 20, 30, 40 } }, { 1, 2, 3 });
  geometry.Origin = { -5, 6, 7 };
  geometry.Direction = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized());
  return geometry;
}

std::string DifferenceOf(const ImageGeometry& part)
{
  return ErrorOf([&part] { PlacementOn(Lattice(), part, "the image", "it"); });
}

} // namespace

// Each voxel by brute force: by where it lies.
TEST(LatticePlacement, PutsEachVoxelWhereItLies)
{
  std::mt19937 random(4);
  const ImageGeometry lattice = Lattice();
  const VoxelBox boxes[] = { WholeBox(lattice), { { { 3, 4, 5 } }, { { 10, 20, 30 } } },
    { { { -4, 20, -1 } }, { { 9, 45, 41 } } } };
  std::array<int, 3> axes{ { 0, 1, 2 } };
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      const std::array<int, 3> steps{ { (signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -1 : 1,
        (signs & 4) != 0 ? -1 : 1 } };
      for (const VoxelBox& box : boxes)
      {
        ImageGeometry part = PartOf(lattice, box, axes, steps);
        part.Origin.array() += 0.03; // rounded
        part.Spacing *= 1 + 1e-5;
        const LatticePlacement placement = PlacementOn(lattice, part, "the image", "it");
        EXPECT_EQ(placement.Axes, axes);
        EXPECT_EQ(placement.Steps, steps);
        EXPECT_TRUE(placement.BoxOf(WholeBox(part)) == box);
        EXPECT_EQ(HaveSamePlaces(lattice, part), box == WholeBox(lattice));
        const std::vector<unsigned char> bytes = RandomMask(part, 0.5, random);
        const BitMask mask = BitsOf(bytes, part);
        const BitMask placed = PlacedIn(WholeBox(lattice), lattice, placement, mask);
        EXPECT_EQ(BytesOf(placed), VoxelsIn(lattice, bytes, part));
        EXPECT_EQ(placed.GetGeometry().Origin, lattice.Origin);
        // Nothing is lost on a grid that holds both, and its voxels are at the same places.
        const VoxelBox both = box.Joined(WholeBox(lattice));
        const BitMask whole = PlacedIn(both, lattice, placement, mask);
        EXPECT_EQ(whole.Count(), mask.Count());
        EXPECT_LT((whole.GetGeometry().ToPhysical(
                     -Eigen::Vector3d(both.Begin[0], both.Begin[1], both.Begin[2])) -
                    lattice.Origin)
                    .norm(),
          1e-12);
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

TEST(LatticePlacement, SaysHowOtherGridsDiffer)
{
  const ImageGeometry lattice = Lattice();
  ImageGeometry part = lattice;
  part.Origin += part.Direction * Eigen::Vector3d(0.09, 0, 0); // of a least spacing of 1
  EXPECT_EQ(DifferenceOf(part), "");
  part.Origin = lattice.ToPhysical({ 0.5, 0, 0.25 });
  EXPECT_EQ(DifferenceOf(part).find("the voxels of it and of the image differ by a shift of "), 0U);
  EXPECT_NE(DifferenceOf(part).find(", 0, 0.25) voxels; resample one onto the grid of the other"),
    std::string::npos)
    << DifferenceOf(part);
  part = PartOf(lattice, WholeBox(lattice), { { 2, 0, 1 } }, { { 1, 1, 1 } });
  part.Spacing[0] = 3.01;
  EXPECT_EQ(DifferenceOf(part),
    "the spacings of it (1, 2, 3.01) mm and of the image (1, 2, 3) mm differ; resample one onto "
    "the "
    "grid of the other");
  part = lattice;
  part.Direction = part.Direction * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  EXPECT_EQ(DifferenceOf(part).find("the axes of it and of the image differ by an angle of 5.7"),
    0U)
    << DifferenceOf(part);
  // The same corners with fewer voxels between them.
  part = lattice;
  part.Dimensions[2] = 14;
  part.Spacing[2] = 9;
  EXPECT_EQ(DifferenceOf(part).find("the spacings of it"), 0U);
  EXPECT_FALSE(HaveSamePlaces(lattice, part));
  // A slice of another thickness.
  part = PartOf(lattice, { { { 0, 0, 7 } }, { { 20, 30, 8 } } }, { { 0, 1, 2 } }, { { 1, 1, 1 } });
  EXPECT_EQ(DifferenceOf(part), "");
  part.Spacing[2] = 6;
  EXPECT_EQ(DifferenceOf(part).find("the spacings of it"), 0U);
}

TEST(LatticePlacement, RefusesGridsThatDoNotMeet)
{
  const ImageGeometry lattice = Lattice();
  ImageGeometry part = lattice;
  for (const double voxels :
    { 20.0, -20.0, 1e8, 1e12, 1e300, std::numeric_limits<double>::quiet_NaN() })
  {
    part.Origin = lattice.ToPhysical({ voxels, 0, 0 });
    EXPECT_EQ(DifferenceOf(part),
      "the image and it do not overlap; check that both are in the same physical coordinates")
      << voxels;
    EXPECT_FALSE(HaveSamePlaces(lattice, part));
  }
  part.Origin = lattice.ToPhysical({ 19, 0, 0 });
  EXPECT_EQ(DifferenceOf(part), "");
}

TEST(LatticePlacement, FindsTheSamePlacesUpToATenthOfTheLeastSpacing)
{
  ImageGeometry other = Lattice();
  other.Origin[0] += 0.09;
  EXPECT_TRUE(HaveSamePlaces(Lattice(), other));
  other.Origin[0] += 0.02;
  EXPECT_FALSE(HaveSamePlaces(Lattice(), other));
  other = Lattice();
  other.Spacing[1] = 2.01;
  EXPECT_FALSE(HaveSamePlaces(Lattice(), other));
}

#include "Deformation/SegmentationWarnings.h"

#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <random>

using namespace FlipFree;

TEST(SegmentationWarnings, ASeedThatReachesFarOutOfTheOrganIsNamedWithWhatWasUsed)
{
  const SeedSphere seed{ Eigen::Vector3d::Constant(20), 14 };
  const SeedSphere used{ seed.Center, 11.2 };
  EXPECT_EQ(WarningOfMixedSeed(4.4, seed, used), "");
  EXPECT_EQ(WarningOfMixedSeed(4.6, seed, used),
    "The seed sphere of 14 mm seems to reach out of the organ, since its gray values scatter far "
    "more than those in its inner half; a sphere of 11.2 mm was used in its place. If the result "
    "is wrong, lower {SeedRadius} or move {SeedCenter}.");
  EXPECT_EQ(WarningOfMixedSeed(4.6, seed, seed),
    "The seed sphere of 14 mm seems to reach out of the organ, since its gray values scatter far "
    "more than those in its inner half; lower {SeedRadius} or move {SeedCenter}.");
}

// In a liver, a sphere of 2 mm finds no boundary.
TEST(SegmentationWarnings, ASurfaceWithoutBoundaryMayComeFromASmallSeed)
{
  ImageGeometry image;
  image.Dimensions = { { 40, 40, 40 } };
  const SeedSphere seed{ Eigen::Vector3d::Constant(20), 2 };
  const std::vector<std::string> warnings =
    WarningsOf(OrganSurface(), { ImplausibilityReason::NoBoundary, 0.85 }, image, seed, {});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(WithNames(warnings[0], { { "SeedCenter", "--seed" }, { "SeedRadius", "--radius" } }),
    "85 % of the surface found no boundary, so it may not be an organ's; check that the seed "
    "sphere lies within the organ and not in air, or move --seed, or raise --radius where the "
    "sphere is far too small.");
}

// The first question is the remedy, in each front end's way of giving points.
TEST(SegmentationWarnings, DoubtIsTheFirstQuestion)
{
  const OrganSegmentationSettings settings;
  const double volume = 64000;
  const DoubtfulPart left{ { 80, 40, 40.4 }, 9000, false, 1.9 };
  const DoubtfulPart taken{ { 50, -40, 40 }, 6000, true, 0.4 };
  const std::string warning = WarningOfDoubt(0.9, { left, taken }, volume, settings);
  EXPECT_EQ(WithNames(warning),
    "Is the part of 9 ml at (80, 40, 40) mm organ? AddInsidePoint 80 40 40 adds it.");
  EXPECT_EQ(WithNames(WarningOfDoubt(0.9, { taken, left }, volume, settings),
              { { "AddOutsidePoint", "--outside" } }),
    "Is the part of 6 ml at (50, -40, 40) mm organ? --outside 50 -40 40 removes it.");
  EXPECT_EQ(WarningOfDoubt(0.849, { left }, volume, settings),
    "The result is doubtful: its confidence is 0.84, below 0.85. " + warning);
  EXPECT_EQ(WarningOfDoubt(0.849, {}, volume, settings),
    "The result is doubtful: its confidence is 0.84, below 0.85; look at the contour where its "
    "confidence is low, and correct it there by points inside or outside the organ.");
}

// Large parts that are sure, and small ones, are questions for those who ask, and no warnings.
TEST(SegmentationWarnings, QuestionsThatHardlyMatterAreNone)
{
  OrganSegmentationSettings settings;
  const double volume = 64000;
  const DoubtfulPart sure{ { 80, 40, 40 }, 20000, false, 5 };
  const DoubtfulPart small{ { 50, 40, 40 }, 4000, true, 0.1 };
  const DoubtfulPart doubtful{ { 10, 40, 40 }, 6000, true, 0.1 };
  EXPECT_TRUE(WarningOfDoubt(0.9, {}, volume, settings).empty());
  EXPECT_EQ(WarningOfDoubt(0.8, { sure, small }, volume, settings),
    WarningOfDoubt(0.8, {}, volume, settings));
  EXPECT_TRUE(WarningOfDoubt(0.9, { sure, small }, volume, settings).empty());
  EXPECT_EQ(WarningOfDoubt(0.9, { sure, small, doubtful }, volume, settings),
    WarningOfDoubt(0.9, { doubtful }, volume, settings));
  settings.Feature.Carving = false;
  EXPECT_TRUE(WarningOfDoubt(0.5, {}, volume, settings).empty());
}

TEST(SegmentationWarnings, ASurfaceThatEndsWhereThereIsNoDataIsNoticed)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 40, 40, 40 } };
  BitMask noData(geometry);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  PointList points(1000, 3);
  for (Eigen::Index row = 0; row < points.rows(); ++row)
  {
    const Eigen::RowVector3d direction(normal(random), normal(random), normal(random));
    points.row(row) = Eigen::RowVector3d::Constant(20) + 12 * direction.normalized();
  }
  EXPECT_EQ(WarningOfNoData(points, BitMask()), "");
  EXPECT_EQ(WarningOfNoData(points, noData), "");
  noData.Insert(20, 20, 32); // the pole
  EXPECT_EQ(WarningOfNoData(points, noData), "");
  for (int j = 0; j < 40; ++j)
  {
    noData.SetRun(true, 0, 40, j, 29); // a slice
  }
  const std::string warning = WarningOfNoData(points, noData);
  EXPECT_NE(warning.find("% of the surface lies where the image has no data"), std::string::npos)
    << warning;
}

#include "ExampleMasks.h"
#include "Image/SeedRegion.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/Modality.h"
#include "Intensity/RobustStatistics.h"

#include <gtest/gtest.h>

#include <limits>

using namespace FlipFree;

namespace
{

// A ball of `inside` in a body of `outside`, whose outer part is `around`.
Modality Of(double around, double outside, double inside, double noise, double scale = 1)
{
  FloatImage image;
  image.Geometry = Grid({ { 150, 70, 40 } }, { 1, 1, 2 });
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k)
    {
      const double radius = std::hypot(j - 35, 2 * (k - 20));
      const double gray = i < 10 ? around : (radius < 20 ? inside : outside);
      image.Voxels.push_back(static_cast<float>(scale * (gray + normal(random))));
    });
  return ModalityOf(ReaderOf(image.View()), image.Geometry);
}

} // namespace

TEST(Modality, OfHounsfieldUnits)
{
  EXPECT_EQ(Of(-1000, 40, 110, 20), Modality::CT);
  EXPECT_EQ(Of(-100, 40, 110, 20), Modality::CT);  // fat, but no air
  EXPECT_EQ(Of(-125, -90, 275, 10), Modality::CT); // clipped
}

TEST(Modality, OfMRDoesNotDependOnTheScale)
{
  for (const double scale : { 0.01, 0.1, 1.0, 37.0, 1000.0 })
  {
    EXPECT_EQ(Of(0, 200, 500, 1e-3, scale), Modality::MR) << scale;
    // Interpolation leaves values somewhat below zero.
    EXPECT_EQ(Of(0, 200, 500, 5, scale), Modality::MR) << scale;
  }
}

// They are not Hounsfield units any more.
TEST(Modality, OfCTOnAnotherScaleIsMR)
{
  for (const double scale : { 1e-6, 1e-3, 0.01, 10.0, 100.0, 1e3, 1e9 })
  {
    EXPECT_EQ(Of(-1000, 40, 110, 20, scale), Modality::MR) << scale;
  }
  EXPECT_EQ(Of(-3024, 40, 110, 20), Modality::CT); // padding
  EXPECT_EQ(Of(-32768, 40, 110, 20), Modality::CT);
}

TEST(Modality, OfNothing)
{
  FloatImage image;
  image.Geometry = Grid({ { 3, 3, 3 } }, { 1, 1, 1 });
  image.Voxels.assign(27, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(ModalityOf(ReaderOf(image.View()), image.Geometry), Modality::MR);
}

TEST(RobustStatistics, HardlyMindOutliers)
{
  std::mt19937 random(1);
  std::normal_distribution<float> normal(7, 2);
  std::vector<float> values;
  for (int value = 0; value < 20000; ++value)
  {
    values.push_back(value % 10 ? normal(random) : 1e6F);
  }
  values.push_back(std::numeric_limits<float>::quiet_NaN());
  const RobustStatistics found = RobustStatisticsOf(values);
  EXPECT_NEAR(found.Median, 7, 0.4);
  EXPECT_NEAR(found.StandardDeviation, 2, 0.4);
  std::vector<float> none;
  EXPECT_EQ(RobustStatisticsOf(none).StandardDeviation, 0);
}

TEST(GrayValueSimilarity, ComparesByTheSpreadOfEitherModality)
{
  const RobustStatistics of{ 100, 8 };
  for (const Modality modality : { Modality::CT, Modality::MR })
  {
    const GrayValueSimilarity similarity(4, modality);
    EXPECT_EQ(similarity.SpreadOf(of), 8);
    EXPECT_EQ(similarity.LikenessOf(100, of), 1);
    EXPECT_EQ(similarity.LikenessOf(116, of), 0);
    EXPECT_EQ(similarity.LikenessOf(84, of), 0);
    EXPECT_EQ(similarity.LikenessOf(150, of), -1);
    EXPECT_EQ(GrayValueSimilarity(30, modality).SpreadOf(of), 15);
  }
  // The least: Hounsfield units, or a part of the median.
  EXPECT_EQ(GrayValueSimilarity(0, Modality::CT).SpreadOf({ 100, 0 }), 5);
  EXPECT_EQ(GrayValueSimilarity(0, Modality::MR).SpreadOf({ 100, 0 }), 3);
}

TEST(GrayValueSimilarity, ReachesToWhereTheImageChanges)
{
  FloatImage image;
  image.Geometry = Grid({ { 41, 41, 41 } }, { 1, 1, 1 });
  const Eigen::Vector3d center(20, 20, 20);
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k)
    { image.Voxels.push_back((Eigen::Vector3d(i, j, k) - center).norm() < 10 ? 100.0F : 0.0F); });
  const GrayValueSimilarity similarity(4, Modality::CT);
  const ImagePart part{ image.View(), { { 0, 0, 0 } } };
  EXPECT_NEAR(similarity.ReachOfLikeness(part, image.Geometry, center, 18), 10, 1);
  EXPECT_EQ(similarity.ReachOfLikeness(part, image.Geometry, center, 6), 6);
  EXPECT_EQ(StatisticsInBall(part, image.Geometry, { center, 8 }).Median, 100);
  // Between the voxels: the one next to the center.
  EXPECT_EQ(StatisticsInBall(part, image.Geometry, { { 20.5, 20.4, 20.4 }, 0.1 }).Median, 100);
}

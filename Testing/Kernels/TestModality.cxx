#include "ExampleMasks.h"
#include "Image/SeedRegion.h"
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

#include "ExampleMasks.h"
#include "Vessel/Polyline.h"
#include "Vessel/SectionSupport.h"
#include "Vessel/StyleChoice.h"
#include "Vessel/VesselPath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace FlipFree;

TEST(CrossSections, KeepTheirRadiusWithinABodyAsBrightAsTheVessel)
{
  // An upright tube of 4 mm; from 30 to 60 mm, all around is as bright.
  FloatImage image;
  image.Geometry = Grid({ { 60, 60, 60 } }, { 1, 1, 1.5 });
  image.Voxels.resize(image.Geometry.NumberOfVoxels());
  std::mt19937 random(3);
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k)
    {
      const bool isBright = std::hypot(i - 30, j - 30) < 4 || (k >= 20 && k <= 40);
      std::normal_distribution<double> noise(0, 5);
      image.Voxels[image.Geometry.Offset(i, j, k)] =
        static_cast<float>((isBright ? 150 : 40) + noise(random));
    });
  PointList line(48, 3);
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    line.row(place) << 30, 30, 10 + 1.5 * static_cast<double>(place);
  }
  const VesselSections sections = FitSections(image.View(), line,
    Eigen::VectorXd::Constant(line.rows(), 4), ThinVessel().Sections, SerialFor);
  const Eigen::VectorXd radii = sections.MeanRadii();
  for (Eigen::Index section = 2; section + 2 < radii.size(); ++section)
  {
    const double z = sections.Frames[section].Origin[2];
    SCOPED_TRACE(z);
    if (z < 26 || z > 64)
    {
      EXPECT_NEAR(radii[section], 4, 0.5);
    }
    else
    {
      EXPECT_GT(radii[section], 3.3);
      EXPECT_LT(radii[section], 6); // it would run away to more than 7 mm
    }
  }
}

// A branch that the image does not show anywhere: it knows only what radius the vessel has
// elsewhere.
TEST(CrossSections, BorrowTheRadiusOfTheVesselElsewhere)
{
  FloatImage image;
  image.Geometry = Grid({ { 80, 80, 40 } }, { 1, 1, 1.5 });
  image.Voxels.resize(image.Geometry.NumberOfVoxels());
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 5);
  for (float& value : image.Voxels)
  {
    value = static_cast<float>(150 + noise(random));
  }
  PointList line(24, 3);
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    line.row(place) << 40, 40, 12 + 1.5 * static_cast<double>(place);
  }
  const auto largest = [&](double lent)
  {
    CrossSectionSettings settings = ThinVessel().Sections;
    settings.LentRadius = lent;
    return FitSections(image.View(), line, Eigen::VectorXd::Constant(line.rows(), 6), settings,
      SerialFor)
      .MeanRadii()
      .maxCoeff();
  };
  EXPECT_GT(largest(0), 8);
  EXPECT_LT(largest(5), 6.5);
}

TEST(CrossSections, OfHighContrastLieAtAThirdOfIt)
{
  // An upright tube of 10 mm, blurred by 2 mm.
  FloatImage image;
  image.Geometry = Grid({ { 50, 50, 30 } }, { 1, 1, 2 });
  image.Voxels.resize(image.Geometry.NumberOfVoxels());
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k)
    {
      const double depth = 10 - std::hypot(i - 25, j - 25);
      image.Voxels[image.Geometry.Offset(i, j, k)] =
        static_cast<float>(60 + 140 * std::erf(depth / (2 * std::sqrt(2.0))));
    });
  PointList line(20, 3);
  for (Eigen::Index place = 0; place < line.rows(); ++place)
  {
    line.row(place) << 25, 25, 15 + 1.5 * static_cast<double>(place);
  }
  const VesselSections sections = FitSections(image.View(), line,
    Eigen::VectorXd::Constant(line.rows(), 9), CrossSectionSettings(), SerialFor);
  // A third of the contrast is 0.86 mm within the blurred boundary, 60 gray values are 1.6 mm.
  EXPECT_NEAR(sections.MeanRadii().mean(), 9.1, 0.3);
}

TEST(SectionSupport, AlongTheVesselIsAMeanOfThoseNearby)
{
  Eigen::VectorXd support = Eigen::VectorXd::Ones(20);
  support[0] = 0;
  const Eigen::VectorXd along = MeanAlong(support, 1.5, 6); // two sections to either side
  EXPECT_NEAR(along[0], 2.0 / 3, 1e-12);
  EXPECT_NEAR(along[2], 0.8, 1e-12);
  EXPECT_NEAR(along[3], 1, 1e-12);
}

TEST(StyleChoice, TheImageDecides)
{
  EXPECT_FALSE(MayBeWide(4, 7));
  EXPECT_TRUE(MayBeWide(6, 7));
  // Where the thin vessel is not that thin, a wide one need not be supported better.
  EXPECT_TRUE(IsWideRather({ 8, 0.89 }, { 8, 0.9 }, 7));
  EXPECT_FALSE(IsWideRather({ 8, 0.91 }, { 5, 0.9 }, 7));
  const auto needs = [](double wide, double thin, double support)
  {
    constexpr double little = 1e-9;
    EXPECT_TRUE(IsWideRather({ wide, support + little }, { thin, 0.9 }, 7)) << wide << ' ' << thin;
    EXPECT_FALSE(IsWideRather({ wide, support - little }, { thin, 0.9 }, 7)) << wide << ' ' << thin;
  };
  needs(4.9, 4.9, 0.9 + ClearlyMore);
  needs(5.95, 5.95, 0.9); // half-way
  needs(7, 7, 0.9 - ClearlyMore);
  needs(20, 20, 0.9 - ClearlyMore);
  // What is clearly wider contains the thin one.
  needs(10, 4.9, 0.9 + ClearlyMore);
  needs(10, 5.95, 0.9 - 0.5 * ClearlyMore);
  needs(10, 7, 0.9 - 2 * ClearlyMore);
}

#include "Evidence/PartQuestions.h"

#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace FlipFree;

namespace
{

constexpr double Milliliter = 1000;

ImageGeometry GridOf100()
{
  return Grid({ { 100, 100, 100 } }, { 1, 1, 1 });
}

DoubtfulPart Part(double x, double milliliters, double margin)
{
  return { { x, 50, 50 }, milliliters * Milliliter, false, margin };
}

double RadiusOfPart(const DoubtfulPart& part)
{
  return std::cbrt(part.Volume * 3 / (4 * EIGEN_PI));
}

std::vector<DoubtfulPart> Asked(const std::vector<DoubtfulPart>& doubts,
  const ConstraintList& constraints = {})
{
  return QuestionsOf(doubts, constraints, {}, GridOf100());
}

std::vector<double> PlacesOf(const std::vector<DoubtfulPart>& parts)
{
  std::vector<double> places;
  for (const DoubtfulPart& part : parts)
  {
    places.push_back(part.Place.x());
  }
  return places;
}

} // namespace

TEST(PartQuestions, AreSortedBySizeTimesDoubt)
{
  EXPECT_TRUE(Asked({}).empty());
  EXPECT_EQ(PlacesOf(Asked({ Part(10, 2, 1), Part(50, 8, 1), Part(90, 4, 1) })),
    (std::vector<double>{ 50, 90, 10 })); // by volume, where margins are equal
  EXPECT_EQ(PlacesOf(Asked({ Part(10, 4, 3), Part(50, 4, 0), Part(90, 4, 1) })),
    (std::vector<double>{ 50, 90, 10 })); // the least margin first, where volumes are equal
  // exp(margin / 1.75) = 3: 1 of 4 is to be wrong, and without a margin 1 of 2. Size counts by the
  // square root of the volume.
  const double margin = 1.75 * std::log(3.0);
  EXPECT_EQ(PlacesOf(Asked({ Part(10, 15.8, margin), Part(90, 4, 0) })),
    (std::vector<double>{ 90, 10 }));
  EXPECT_EQ(PlacesOf(Asked({ Part(10, 16.2, margin), Part(90, 4, 0) })),
    (std::vector<double>{ 10, 90 }));
}

TEST(PartQuestions, AreAtMostFive)
{
  std::vector<DoubtfulPart> doubts;
  for (int number = 0; number < 8; ++number)
  {
    doubts.push_back(Part(12 * number, 0.1 + 0.01 * number, 1));
  }
  EXPECT_EQ(PlacesOf(Asked(doubts)), (std::vector<double>{ 84, 72, 60, 48, 36 }));
}

// Of a part that two rounds found, the later round counts, even if it is the surer one.
TEST(PartQuestions, AreMergedByPlace)
{
  const DoubtfulPart early = Part(50, 8, 0.1);
  const double radius = RadiusOfPart(Part(0, 6, 0));
  const std::vector<DoubtfulPart> merged = Asked({ early, Part(50 + 0.9 * radius, 6, 3) });
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(merged[0].Volume, 6 * Milliliter);
  EXPECT_EQ(merged[0].Margin, 3);
  EXPECT_EQ(Asked({ early, Part(50 + 1.1 * radius, 6, 3) }).size(), 2U);
  // A small part beside a large one is another, whichever was found first.
  const DoubtfulPart small = Part(50 + 0.9 * radius, 0.5, 1);
  EXPECT_EQ(Asked({ early, small }).size(), 2U);
  EXPECT_EQ(Asked({ small, early }).size(), 2U);
}

TEST(PartQuestions, AreNotAskedAgain)
{
  const std::vector<DoubtfulPart> doubts{ Part(20, 8, 1), Part(80, 6, 1) };
  const double radius = RadiusOfPart(doubts[0]);
  const auto at = [](ConstraintKind kind, double x) {
    return PointConstraint{ kind, { x, 50, 50 }, 1 };
  };
  for (const ConstraintKind kind :
    { ConstraintKind::Inside, ConstraintKind::Outside, ConstraintKind::Seed })
  {
    EXPECT_EQ(PlacesOf(Asked(doubts, { at(kind, 20 + 0.99 * radius) })), std::vector<double>{ 80 });
    EXPECT_EQ(Asked(doubts, { at(kind, 20 + 1.01 * radius) }).size(), 2U);
  }
  EXPECT_EQ(Asked(doubts, { at(ConstraintKind::Boundary, 20) }).size(), 2U); // on neither side
  EXPECT_TRUE(
    Asked(doubts, { at(ConstraintKind::Inside, 20), at(ConstraintKind::Outside, 80) }).empty());
}

// What the cut decided may have changed since.
TEST(PartQuestions, SayWhatTheSurfaceIncludes)
{
  ImageGeometry geometry = Grid({ { 100, 100, 100 } }, { 2, 2, 2 });
  geometry.Origin = { -100, 0, 0 };
  const std::vector<VoxelRun> voxels{ { 25, 25, 60, 80 } }; // x from 20 to 58 mm
  const std::vector<DoubtfulPart> doubts{ { { 20.9, 50.3, 49.8 }, 9, false, 1 },
    { { 18.9, 50, 50 }, 8, true, 1 }, { { 58.2, 51.1, 50 }, 7, true, 1 } };
  const std::vector<DoubtfulPart> questions = QuestionsOf(doubts, {}, voxels, geometry);
  ASSERT_EQ(questions.size(), 3U);
  EXPECT_TRUE(questions[0].IsIncluded);
  EXPECT_EQ(questions[0].Place, Eigen::Vector3d(20, 50, 50)); // a voxel's center
  EXPECT_FALSE(questions[1].IsIncluded);
  EXPECT_FALSE(questions[2].IsIncluded);
}

TEST(PartQuestions, AreRowsOfATable)
{
  const DoubtfulPart part{ { 1, -2, 3 }, 4500, true, 0.5 };
  std::string names;
  std::vector<double> row;
  for (const TableColumn<DoubtfulPart>& column : QuestionColumns())
  {
    names += std::string(column.Name) + " ";
    row.push_back(column.Read(part));
  }
  EXPECT_EQ(names, "x y z volume_ml included margin ");
  EXPECT_EQ(row, (std::vector<double>{ 1, -2, 3, 4.5, 1, 0.5 }));
}

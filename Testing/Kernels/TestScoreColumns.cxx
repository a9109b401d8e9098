// The names of the scores, and what stands behind each.
#include "Measures/ScoreColumns.h"
#include "Measures/ScoreParameters.h"
#include "Measures/ScoreSummary.h"

#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

using namespace FlipFree;

TEST(ScoreColumns, AreInTheOrderOfTheDocumentation)
{
  std::vector<std::string> names;
  ForEachScore({}, [&names](const char* name, const auto&) { names.emplace_back(name); });
  EXPECT_EQ(names,
    (std::vector<std::string>{ "Dice", "Jaccard", "RelativeVolumeDifference", "ASD", "RMS", "HD95",
      "HD", "SegmentationVolume", "ReferenceVolume", "OverlapOf", "DistanceOf" }));
}

TEST(ScoreColumns, AreMembersOfTheirOwn)
{
  SegmentationScores scores;
  double next = 1;
  for (const ScoreColumn& column : ScoreColumns())
  {
    EXPECT_TRUE(std::isnan(scores.*column.Member)) << column.Name;
    scores.*column.Member = next++;
  }
  scores.OverlapOf = "voxels";
  scores.DistanceOf = "mesh";
  EXPECT_EQ(scores.Dice, 1);
  EXPECT_EQ(scores.ReferenceVolume, 9);
  std::string texts;
  double sum = 0;
  ForEachScore(scores,
    [&](const char*, const auto& value)
    {
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      {
        sum += value;
      }
      else
      {
        texts += value + " ";
      }
    });
  EXPECT_EQ(sum, 45);
  EXPECT_EQ(texts, "voxels mesh ");
}

TEST(ScoreColumns, HaveTheirUnits)
{
  for (const ScoreColumn& column : ScoreColumns())
  {
    const std::string name = column.Name;
    const bool isLength = name == "ASD" || name == "RMS" || name == "HD95" || name == "HD";
    const bool isVolume = name == "SegmentationVolume" || name == "ReferenceVolume";
    EXPECT_STREQ(column.Unit, isLength ? "mm" : (isVolume ? "ml" : "")) << name;
  }
}

TEST(ScoreSummary, GivesScoresWithTheirUnits)
{
  SegmentationScores scores;
  scores.Dice = 0.93456;
  scores.Jaccard = 0.87717;
  scores.RelativeVolumeDifference = -0.0123;
  scores.ASD = 0.5004;
  scores.RMS = 1.25;
  scores.HD95 = 3;
  scores.HD = 12.3456;
  scores.SegmentationVolume = 1480.456;
  scores.ReferenceVolume = 1500;
  scores.OverlapOf = "voxelized mesh";
  scores.DistanceOf = "mesh";
  EXPECT_EQ(SummaryOf(scores),
    "Dice                 0.9346\n"
    "Jaccard              0.8772\n"
    "volume               1480.46 ml, reference 1500.00 ml, difference -1.23 %\n"
    "surface distance     mean 0.500 mm, RMS 1.250 mm\n"
    "Hausdorff distance   12.346 mm, 95th percentile 3.000 mm\n"
    "measured             overlap of the voxelized mesh, distances of the mesh, weighted by "
    "area\n");
  scores.RelativeVolumeDifference = 0;
  EXPECT_NE(SummaryOf(scores).find("difference +0.00 %"), std::string::npos);
}

TEST(ScoreSummary, SaysWhetherASurfaceIsValid)
{
  const Surface sphere = Sphere(4, Eigen::Vector3d::Zero(), 10);
  EXPECT_EQ(SummaryOf(MeasureValidity(sphere.Points, FacesOf(sphere.Triangles), nullptr)),
    "surface              valid: closed, Euler number 2, self-intersections 0\n");
  const FaceList open = FacesOf(sphere.Triangles.bottomRows(sphere.Triangles.rows() - 1));
  EXPECT_EQ(SummaryOf(MeasureValidity(sphere.Points, open, nullptr)),
    "surface              not valid: 3 open edges, Euler number 1, self-intersections 0\n");
}

TEST(ScoreParameters, AreNumbers)
{
  ScoreSettings settings;
  settings.SampleSpacing = std::numeric_limits<double>::quiet_NaN();
  const LabelMask nothing{};
  const std::string expected =
    "the value of SampleSpacing is not a number (NaN); set it to a number";
  EXPECT_EQ(ErrorOf([&] { ScoreLabels(nothing, nothing, settings, SerialFor, NeverStop); }),
    expected);
  EXPECT_EQ(ErrorOf([&] { ScoreSurface({}, {}, nothing, settings, SerialFor, NeverStop); }),
    expected);
}

// The names of the scores, and what stands behind each.
#include "Measures/ScoreColumns.h"
#include "Measures/ScoreParameters.h"

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

TEST(ScoreParameters, AreNumbers)
{
  ScoreSettings settings;
  settings.SampleSpacing = std::numeric_limits<double>::quiet_NaN();
  const LabelMask nothing{};
  const std::string expected =
    "the property SampleSpacing is not a number (NaN); set it to a number";
  EXPECT_EQ(ErrorOf([&] { ScoreLabels(nothing, nothing, settings, SerialFor, NeverStop); }),
    expected);
  EXPECT_EQ(ErrorOf([&] { ScoreSurface({}, {}, nothing, settings, SerialFor, NeverStop); }),
    expected);
}

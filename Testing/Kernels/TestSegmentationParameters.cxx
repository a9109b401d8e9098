// Every parameter by its name.
#include "Deformation/SegmentationParameters.h"
#include "Measures/ScoreParameters.h"
#include "Phantom/PhantomVolume.h"
#include "Vessel/VesselParameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

using namespace FlipFree;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

template <typename Settings>
const Parameter<Settings>& Find(const ParameterTable<Settings>& table, const char* name)
{
  for (const Parameter<Settings>& parameter : table)
  {
    if (parameter.Name == name)
    {
      return parameter;
    }
  }
  throw std::out_of_range(name);
}

// Each entry stands for a field of its own, and takes what is in its range.
template <typename Settings>
void ExpectIndependentFields(const ParameterTable<Settings>& table)
{
  std::set<std::string> names;
  for (const Parameter<Settings>& parameter : table)
  {
    EXPECT_TRUE(names.insert(parameter.Name).second) << parameter.Name;
    Settings settings;
    const std::vector<double> before = parameter.Get(settings);
    ASSERT_EQ(static_cast<int>(before.size()), parameter.Count) << parameter.Name;
    std::vector<double> wanted(before.size(), before[0] == 1 ? 0 : 1);
    parameter.Set(settings, wanted);
    const std::vector<double> after = parameter.Get(settings);
    EXPECT_NE(after, before) << parameter.Name;
    for (const Parameter<Settings>& other : table)
    {
      if (other.Name != parameter.Name)
      {
        EXPECT_EQ(other.Get(settings), other.Get(Settings())) << parameter.Name << other.Name;
      }
    }
  }
}

} // namespace

TEST(ParameterTable, EntriesAreIndependentFields)
{
  ExpectIndependentFields(PhantomParameters());
  ExpectIndependentFields(ScoreParameters());
}

TEST(SegmentationParameters, AreWithinTheirRanges)
{
  EXPECT_GT(SegmentationParameters().size(), 35U);
  VolumeSegmentationSettings settings;
  const auto& levels = Find(SegmentationParameters(), "Levels");
  levels.Set(settings, { 99 });
  EXPECT_EQ(settings.Method.Schedule.Levels, 6);
  levels.Set(settings, { -1 });
  EXPECT_EQ(settings.Method.Schedule.Levels, 1);
  const auto& modality = Find(SegmentationParameters(), "Modality");
  modality.Set(settings, { 2 });
  EXPECT_EQ(settings.Method.Feature.Modality, Modality::MR);
  const auto& offset = Find(SegmentationParameters(), "StartCenterOffset");
  offset.Set(settings, { 1, 2, 3 });
  EXPECT_EQ(settings.StartCenterOffset, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(Find(SegmentationParameters(), "Guard").Type, ParameterType::Boolean);
  EXPECT_EQ(Find(SegmentationParameters(), "Reach").Type, ParameterType::Real);
}

TEST(SegmentationParameters, ThatAreNoNumbersAreNamed)
{
  for (const auto& parameter : SegmentationParameters())
  {
    if (parameter.Type != ParameterType::Real)
    {
      continue;
    }
    VolumeSegmentationSettings settings;
    EXPECT_NO_THROW(RequireNumbers(settings));
    parameter.Set(settings, std::vector<double>(parameter.Count, NaN));
    try
    {
      RequireNumbers(settings);
      ADD_FAILURE() << parameter.Name;
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_EQ(error.what(),
        "the value of " + parameter.Name + " is not a number (NaN); set it to a number");
    }
  }
}

TEST(VesselParameters, AreWithinTheirRangesAndNumbers)
{
  VesselSegmentationSettings settings;
  for (const auto& parameter : VesselParameters())
  {
    const std::vector<double> before = parameter.Get(settings);
    parameter.Set(settings, { 1e9 });
    EXPECT_LE(parameter.Get(settings).front(), 1000) << parameter.Name;
    EXPECT_NO_THROW(RequireNumbers(settings));
    if (parameter.Type == ParameterType::Real)
    {
      parameter.Set(settings, { NaN });
      EXPECT_THROW(RequireNumbers(settings), std::invalid_argument) << parameter.Name;
    }
    parameter.Set(settings, before);
  }
  Find(VesselParameters(), "WallThickness").Set(settings, { -9 });
  EXPECT_EQ(settings.Path.WallThickness, -5);
  Find(VesselParameters(), "Modality").Set(settings, { 7 });
  EXPECT_EQ(settings.Path.Modality, Modality::MR);
  Find(VesselParameters(), "LabelValue").Set(settings, { 300 });
  EXPECT_EQ(settings.LabelValue, 255);
}

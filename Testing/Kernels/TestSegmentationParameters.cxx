// Every parameter by its name.
#include "Deformation/SegmentationParameters.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "Measures/ScoreParameters.h"
#include "ParameterTable.h"
#include "Phantom/PhantomVolume.h"
#include "Vessel/VesselParameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

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

// Whoever reads the table makes a switch of a parameter without unit.
template <typename Settings>
void ExpectUnits(const ParameterTable<Settings>& table)
{
  for (const Parameter<Settings>& parameter : table)
  {
    EXPECT_EQ(std::string(parameter.Words.Unit).empty(), parameter.Type == ParameterType::Boolean)
      << parameter.Name;
  }
}

// NaN is no value of a boolean, an integer or an enumeration, and too few or many numbers are none
// of any: what is not taken changes nothing.
template <typename Settings>
void ExpectRefusals(const ParameterTable<Settings>& table)
{
  for (const Parameter<Settings>& parameter : table)
  {
    SCOPED_TRACE(parameter.Name);
    Settings settings;
    const std::vector<double> before = parameter.Get(settings);
    std::vector<double> more = before;
    more.push_back(1);
    EXPECT_FALSE(parameter.Take(settings, more));
    EXPECT_FALSE(parameter.Take(settings, {}));
    if (parameter.Type != ParameterType::Real)
    {
      EXPECT_FALSE(parameter.Take(settings, { NaN }));
    }
    EXPECT_EQ(parameter.Get(settings), before);
    EXPECT_TRUE(parameter.Take(settings, before));
  }
}

} // namespace

TEST(ParameterTable, UnitsAreThoseOfNumbers)
{
  ExpectUnits(SegmentationParameters());
  ExpectUnits(VesselParameters());
  ExpectUnits(LabelSurfaceParameters());
  ExpectUnits(ScoreParameters());
}

TEST(ParameterTable, OnlyItsNumbersAreTaken)
{
  ExpectRefusals(SegmentationParameters());
  ExpectRefusals(VesselParameters());
  ExpectRefusals(LabelSurfaceParameters());
  VolumeSegmentationSettings settings;
  EXPECT_FALSE(Find(SegmentationParameters(), "Fairing").Take(settings, { NaN }));
  EXPECT_FALSE(Find(SegmentationParameters(), "Levels").Take(settings, { 7 }));
}

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

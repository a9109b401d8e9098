// The table of options: what it says about the kernels' parameters, and values that are bound to
// it.
#include "OptionTable.h"
#include "Options.h"

#include "Deformation/SegmentationParameters.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "ParameterTable.h"
#include "Vessel/VesselParameters.h"

#include <CLI/CLI.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace Command;

/// Numbers as streams read them.
std::vector<double> NumbersIn(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (double number = 0; stream >> number;)
  {
    numbers.push_back(number);
  }
  return numbers;
}

/// Each parameter is an option of the command, once, and its default is that of the settings.
template <typename Settings>
void ExpectOptions(const std::string& command, const FlipFree::ParameterTable<Settings>& table)
{
  const std::vector<OptionEntry>& options = EntryOf(command).Options;
  for (const FlipFree::Parameter<Settings>& parameter : table)
  {
    SCOPED_TRACE(command + " " + parameter.Name);
    const std::string name = OptionsOf(parameter.Name).front();
    const auto isNamed = [&name](const OptionEntry& option)
    { return std::count(option.Names.begin(), option.Names.end(), name) > 0; };
    const bool isOption = parameter.Name != "KeepHistory"; // which is for pipelines
    ASSERT_EQ(std::count_if(options.begin(), options.end(), isNamed), isOption ? 1 : 0);
    if (!isOption)
    {
      continue;
    }
    const OptionEntry& option = *std::find_if(options.begin(), options.end(), isNamed);
    const std::vector<double> values = parameter.Get(Settings());
    if (parameter.Type == FlipFree::ParameterType::Boolean)
    {
      EXPECT_TRUE(option.Values.empty());
      EXPECT_EQ(option.Default, values.front() != 0 ? "on" : "");
    }
    else
    {
      EXPECT_EQ(static_cast<int>(option.Values.size()), parameter.Count);
      EXPECT_EQ(NumbersIn(option.Default), values);
    }
  }
}

} // namespace

TEST(Options, HaveEachParameterOnce)
{
  ExpectOptions("segment", FlipFree::SegmentationParameters());
  ExpectOptions("trace", FlipFree::VesselParameters());
  ExpectOptions("surfaces", FlipFree::LabelSurfaceParameters());
}

TEST(Options, GiveBoundValuesTheirDefaults)
{
  CLI::App program;
  CLI::App* const phantom = AddCommand(program, "phantom");
  int seed = 9;
  AddOption(*phantom, "--random-seed", seed);
  EXPECT_EQ(seed, 1);
  double noise = 9;
  AddOption(*phantom, "--noise", noise);
  EXPECT_EQ(noise, 12);
  std::string name = "mine"; // has no default
  AddOption(*phantom, "NAME", name);
  EXPECT_EQ(name, "mine");
  CLI::App* const surfaces = AddCommand(program, "surfaces");
  std::string format = "mine";
  AddOption(*surfaces, "--format", format);
  EXPECT_EQ(format, "stl");
}

TEST(Options, WhoseDefaultsAreNoValuesAreNamed)
{
  CLI::App program;
  CLI::App* const surfaces = AddCommand(program, "surfaces");
  int format = 0;
  try
  {
    AddOption(*surfaces, "--format", format);
    ADD_FAILURE();
  }
  catch (const std::logic_error& error)
  {
    EXPECT_STREQ(error.what(), "the default of --format is no value: stl");
  }
}

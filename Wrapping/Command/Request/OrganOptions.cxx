#include "OrganOptions.h"

#include "Coordinates.h"
#include "Failure.h"
#include "FileFormats.h"
#include "Options.h"
#include "SeedRadius.h"
#include "SessionRecord.h"

#include <CLI/CLI.hpp>

#include <map>

namespace Command
{
namespace
{

constexpr std::size_t ValuesOfOrgan = 5;

double NumberOf(const std::string& organ, const std::string& text)
{
  double number = 0;
  if (!CLI::detail::lexical_cast(text, number))
  {
    throw WrongUsage("--organ " + organ + ": '" + text +
      "' is not a number. Give a name, the seed's center, and its radius: NAME X Y Z MM.");
  }
  return number;
}

GivenOrgan OrganOf(const std::string* values, const PointOptions& corrections)
{
  GivenOrgan organ;
  organ.Name = values[0];
  const auto number = [&](int index) { return NumberOf(organ.Name, values[index]); };
  const std::vector<double> center{ number(1), number(2), number(3) };
  organ.Radius = number(4);
  const std::string option = "--organ " + organ.Name;
  RequireCoordinates(option, center);
  organ.Seed = corrections.InLps(center.data());
  if (!IsSeedRadius(organ.Radius))
  {
    throw WrongUsage(option + ": the radius " + SeedRadiusRule(organ.Radius) + ".");
  }
  return organ;
}

void RequireNames(const std::vector<GivenOrgan>& organs)
{
  std::map<std::string, std::string> names;
  for (const GivenOrgan& organ : organs)
  {
    if (organ.Name.empty())
    {
      throw WrongUsage("--organ: a name is empty. Give each organ one of its own.");
    }
    const auto [other, isNew] = names.emplace(organ.FileName(), organ.Name);
    if (!isNew)
    {
      throw WrongUsage("--organ: '" + other->second + "' and '" + organ.Name +
        "' would give the same file name; choose distinct names.");
    }
  }
}

} // namespace

std::string GivenOrgan::FileName() const
{
  return FileNameOf(this->Name);
}

void OrganOptions::AddOptions(CLI::App& command)
{
  this->Command = &command;
  AddOption(command, "--organ", this->Values);
  AddOption(command, "--fixed", this->Fixed);
}

std::vector<GivenOrgan> OrganOptions::Organs(const PointOptions& corrections) const
{
  // CLI11 checks only that there are five values in all.
  if (this->Values.size() % ValuesOfOrgan != 0)
  {
    throw WrongUsage("--organ: a value is missing. Give --organ NAME X Y Z MM.");
  }
  std::vector<GivenOrgan> organs;
  std::map<std::string, std::size_t> seen; // values of an option, up to here
  for (const CLI::Option* option : this->Command->parse_order())
  {
    const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
    const std::size_t count = ++seen[name];
    if (name == "organ" && count % ValuesOfOrgan == 0)
    {
      organs.push_back(OrganOf(this->Values.data() + count - ValuesOfOrgan, corrections));
    }
    else if (const auto points = corrections.PointsEndingAt(name, count); !points.empty())
    {
      if (organs.empty())
      {
        throw WrongUsage(
          "--" + name + ": the point comes before the first --organ. Give it after its own organ.");
      }
      std::vector<CorrectionPoint>& own = organs.back().Points;
      own.insert(own.end(), points.begin(), points.end());
    }
  }
  RequireNames(organs);
  for (const std::string& fixed : this->Fixed)
  {
    RequireEnding("--fixed", fixed, SurfaceEndings());
  }
  return organs;
}

} // namespace Command

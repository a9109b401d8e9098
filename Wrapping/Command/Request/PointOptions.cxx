#include "PointOptions.h"

#include "Coordinates.h"
#include "FileFormats.h"
#include "Options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace Command
{
namespace
{

using FlipFree::ConstraintKind;

struct OptionOfKind
{
  const char* Name;
  ConstraintKind Kind;
};

/// In the order of the points.
constexpr OptionOfKind OptionsOfKinds[] = { { "inside", ConstraintKind::Inside },
  { "inside-stroke", ConstraintKind::Inside }, { "outside", ConstraintKind::Outside },
  { "outside-stroke", ConstraintKind::Outside }, { "boundary", ConstraintKind::Boundary } };

} // namespace

void PointOptions::AddOptions(CLI::App& command)
{
  for (const char* const name : { "inside", "outside", "boundary" })
  {
    AddOption(command, std::string("--") + name, this->Coordinates[name]);
  }
  for (const char* const name : { "inside-stroke", "outside-stroke" })
  {
    AddOption(command, std::string("--") + name, this->Strokes[name]);
  }
  AddOption(command, "--points", this->PointsIn);
  AddOption(command, "--save-points", this->PointsOut);
  AddOption(command, "--ras", this->RAS);
}

bool PointOptions::IsEmpty() const
{
  return std::all_of(this->Coordinates.begin(), this->Coordinates.end(),
           [](const auto& option) { return option.second.empty(); }) &&
    this->StrokeFiles().empty() && !this->HasFiles() && !this->RAS;
}

void PointOptions::Validate() const
{
  for (const auto& [name, coordinates] : this->Coordinates)
  {
    RequireCoordinates("--" + name, coordinates);
  }
  for (const auto& [name, strokes] : this->Strokes)
  {
    for (const std::string& stroke : strokes)
    {
      RequireEnding("--" + name, stroke, PointEndings());
    }
  }
  const std::pair<const char*, const std::string*> files[] = { { "--points", &this->PointsIn },
    { "--save-points", &this->PointsOut } };
  for (const auto& [name, file] : files)
  {
    if (!file->empty())
    {
      RequireEnding(name, *file, PointEndings());
    }
  }
}

std::array<double, 3> PointOptions::InLps(const double* given) const
{
  const std::array<double, 3> point{ { given[0], given[1], given[2] } };
  return this->RAS ? SwapLpsRas(point) : point;
}

std::vector<std::string> PointOptions::StrokeFiles() const
{
  std::vector<std::string> files;
  for (const auto& option : this->Strokes)
  {
    files.insert(files.end(), option.second.begin(), option.second.end());
  }
  return files;
}

std::vector<CorrectionPoint> PointOptions::PointsEndingAt(const std::string& option,
  std::size_t number) const
{
  const auto* const found = std::find_if(std::begin(OptionsOfKinds), std::end(OptionsOfKinds),
    [&option](const OptionOfKind& one) { return option == one.Name; });
  if (found == std::end(OptionsOfKinds))
  {
    return {};
  }
  if (const auto strokes = this->Strokes.find(option); strokes != this->Strokes.end())
  {
    return ReadStroke(strokes->second.at(number - 1), found->Kind);
  }
  if (number % 3 != 0)
  {
    return {};
  }
  return { { found->Kind, this->InLps(this->Coordinates.at(option).data() + number - 3), 0 } };
}

std::vector<CorrectionPoint> PointOptions::Points() const
{
  std::vector<CorrectionPoint> points;
  if (!this->PointsIn.empty())
  {
    points = ReadPoints(this->PointsIn, "--inside-stroke or --outside-stroke");
  }
  for (const auto& [name, kind] : OptionsOfKinds)
  {
    const auto strokes = this->Strokes.find(name);
    const std::size_t count =
      strokes != this->Strokes.end() ? strokes->second.size() : this->Coordinates.at(name).size();
    for (std::size_t number = 1; number <= count; ++number)
    {
      const std::vector<CorrectionPoint> more = this->PointsEndingAt(name, number);
      points.insert(points.end(), more.begin(), more.end());
    }
  }
  return points;
}

} // namespace Command

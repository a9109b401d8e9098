#include "PointOptions.h"

#include "Coordinates.h"
#include "OutputFile.h"
#include "PointText.h"

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

void PointOptions::AddOptions(CLI::App& command, const std::string& what)
{
  const bool hasSeeds = what == "organ";
  const char* const group = "Corrections";
  const auto add =
    [&](const std::string& name, auto& values, const char* type, int count, const std::string& help)
  {
    command.add_option("--" + name, values[name], help)
      ->type_name(type)
      ->expected(count, CLI::detail::expected_max_vector_size)
      ->allow_extra_args(false) // of those that each time has
      ->group(group);
  };
  const auto addPoint = [&](const char* name, const std::string& help)
  { add(name, this->Coordinates, "X Y Z", 3, help); };
  addPoint("inside",
    "A point inside the " + what + " that was missed, in LPS millimeters; can be repeated");
  addPoint("outside", "A point outside the " + what + " that was taken for it, likewise");
  addPoint("boundary", "A point on the " + what + "'s boundary, likewise");
  add("inside-stroke", this->Strokes, "FILE", 1,
    "A stroke of points inside: a table (.csv: x, y, z) or a curve of 3D Slicer (.mrk.json); can "
    "be repeated");
  add("outside-stroke", this->Strokes, "FILE", 1, "A stroke of points outside, likewise");
  command
    .add_option("--points", this->PointsIn,
      hasSeeds
        ? "Points and further seeds from a file: a table (.csv: kind, x, y, z, radius) or markups "
          "of 3D Slicer (.mrk.json), whose labels are outside, inside, boundary, or seed and its "
          "radius"
        : "Such points from a file: a table (.csv: kind, x, y, z, radius) or markups of 3D Slicer "
          "(.mrk.json), whose labels are outside, inside or boundary")
    ->type_name("FILE")
    ->group(group);
  command
    .add_option("--save-points", this->PointsOut, "File for all these points (.csv .mrk.json)")
    ->type_name("FILE")
    ->group(group);
  command
    .add_flag("--ras", this->RAS,
      "Coordinates of the command line are RAS, as 3D Slicer and ITK-SNAP show them, not LPS")
    ->group(group);
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
    points = ReadPoints(this->PointsIn);
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

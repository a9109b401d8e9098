#include "PointOptions.h"

#include "Coordinates.h"
#include "OutputFile.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

namespace Command
{
namespace
{

using FlipFree::ConstraintKind;

/// In the order of --help and of the points.
constexpr std::array<ConstraintKind, 3> KindsOfOptions{ { ConstraintKind::Inside,
  ConstraintKind::Outside, ConstraintKind::Boundary } };

std::string OptionOf(ConstraintKind kind)
{
  return std::string("--") + KindName(kind);
}

} // namespace

void PointOptions::AddOptions(CLI::App& command, const std::string& what)
{
  const bool hasSeeds = what == "organ";
  const char* const group = "Corrections";
  const auto add = [&](ConstraintKind kind, const std::string& help)
  {
    command.add_option(OptionOf(kind), this->Coordinates.at(static_cast<std::size_t>(kind)), help)
      ->type_name("X Y Z")
      ->expected(3, CLI::detail::expected_max_vector_size)
      ->allow_extra_args(false) // of the three that each time has
      ->group(group);
  };
  add(ConstraintKind::Inside,
    "A point inside the " + what + " that was missed, in LPS millimeters; can be repeated");
  add(ConstraintKind::Outside, "A point outside the " + what + " that was taken for it, likewise");
  add(ConstraintKind::Boundary, "A point on the " + what + "'s boundary, likewise");
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
           [](const auto& values) { return values.empty(); }) &&
    this->PointsIn.empty() && this->PointsOut.empty() && !this->RAS;
}

void PointOptions::RequireSense() const
{
  for (const ConstraintKind kind : KindsOfOptions)
  {
    RequireCoordinates(OptionOf(kind), this->CoordinatesOf(kind));
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

const std::vector<double>& PointOptions::CoordinatesOf(ConstraintKind kind) const
{
  return this->Coordinates.at(static_cast<std::size_t>(kind));
}

std::optional<ConstraintKind> PointOptions::KindOfOption(const std::string& name)
{
  for (const ConstraintKind kind : KindsOfOptions)
  {
    if (name == KindName(kind))
    {
      return kind;
    }
  }
  return std::nullopt;
}

CorrectionPoint PointOptions::PointOf(ConstraintKind kind, std::size_t number) const
{
  return { kind, this->InLps(this->CoordinatesOf(kind).data() + 3 * number), 0 };
}

std::vector<CorrectionPoint> PointOptions::Points() const
{
  std::vector<CorrectionPoint> points;
  if (!this->PointsIn.empty())
  {
    points = ReadPoints(this->PointsIn);
  }
  for (const ConstraintKind kind : KindsOfOptions)
  {
    const std::size_t count = this->CoordinatesOf(kind).size() / 3;
    for (std::size_t number = 0; number < count; ++number)
    {
      points.push_back(this->PointOf(kind, number));
    }
  }
  return points;
}

} // namespace Command

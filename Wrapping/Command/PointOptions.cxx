#include "PointOptions.h"

#include "Coordinates.h"
#include "OutputFile.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace Command
{

void PointOptions::AddOptions(CLI::App& command, const std::string& what)
{
  const bool hasSeeds = what == "organ";
  const char* const group = "Corrections";
  const auto add = [&](const char* name, std::vector<double>& values, const std::string& help)
  {
    command.add_option(name, values, help)
      ->type_name("X Y Z")
      ->expected(3, CLI::detail::expected_max_vector_size)
      ->allow_extra_args(false) // of the three that each time has
      ->group(group);
  };
  add("--inside", this->Inside,
    "A point inside the " + what + " that was missed, in LPS millimeters; can be repeated");
  add("--outside", this->Outside,
    "A point outside the " + what + " that was taken for it, likewise");
  add("--boundary", this->Boundary, "A point on the " + what + "'s boundary, likewise");
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
  return this->Inside.empty() && this->Outside.empty() && this->Boundary.empty() &&
    this->PointsIn.empty() && this->PointsOut.empty() && !this->RAS;
}

void PointOptions::RequireSense() const
{
  const std::pair<const char*, const std::vector<double>*> options[] = { { "--inside",
                                                                           &this->Inside },
    { "--outside", &this->Outside }, { "--boundary", &this->Boundary } };
  for (const auto& [name, values] : options)
  {
    RequireCoordinates(name, *values);
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

CorrectionPoint PointOptions::PointOf(const std::string& kind, std::size_t number) const
{
  const std::vector<double>& values = kind == "inside" ? this->Inside
    : kind == "outside"                                ? this->Outside
                                                       : this->Boundary;
  return { kind, this->InLps(values.data() + 3 * number), 0 };
}

std::vector<CorrectionPoint> PointOptions::Points() const
{
  std::vector<CorrectionPoint> points;
  if (!this->PointsIn.empty())
  {
    points = ReadPoints(this->PointsIn);
  }
  const auto add = [&](const char* kind, const std::vector<double>& values)
  {
    for (std::size_t number = 0; number < values.size() / 3; ++number)
    {
      points.push_back(this->PointOf(kind, number));
    }
  };
  add("inside", this->Inside);
  add("outside", this->Outside);
  add("boundary", this->Boundary);
  return points;
}

} // namespace Command

#include "PointFile.h"

#include "Failure.h"
#include "FileFormats.h"
#include "PointText.h"
#include "Warning.h"

#include "Exchange/PointTable.h"
#include "Exchange/TableText.h"
#include "MessageText.h"
#include "TextWords.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace Command
{
namespace
{

using FlipFree::ConstraintKind;
using Json = nlohmann::json;

/// In millimeters: points of a stroke that are nearer than this are one.
constexpr double SamePlace = 1e-3;

std::array<double, 3> CoordinatesOf(const Eigen::Vector3d& place)
{
  return { { place[0], place[1], place[2] } };
}

CorrectionPoint PointOfControl(const std::string& words, const std::array<double, 3>& place)
{
  CorrectionPoint point;
  point.Place = place;
  std::istringstream label(words);
  std::string kind;
  std::string radius;
  label >> kind >> radius;
  if (kind.empty())
  {
    throw Failure(std::string("it has no label; give it one that begins with its kind: ") +
      FlipFree::KindsInWords);
  }
  try
  {
    // 3D Slicer numbers its points: inside-1.
    point.Kind = KindOf(FlipFree::InSmallLetters(kind.substr(0, kind.find_first_of("-_"))));
    if (point.Kind == ConstraintKind::Seed && !radius.empty())
    {
      point.Radius = PointNumberOf(radius);
    }
    RequireRadius(point);
  }
  catch (const Failure& failure)
  {
    throw Failure(std::string(failure.what()) + "; its label begins with its kind");
  }
  return point;
}

std::string TableOf(const std::vector<CorrectionPoint>& points)
{
  std::vector<std::vector<FlipFree::TableCell>> rows;
  for (const CorrectionPoint& point : points)
  {
    rows.push_back({ FlipFree::NameOf(point.Kind), point.Place[0], point.Place[1], point.Place[2],
      std::string() });
    if (point.Kind == ConstraintKind::Seed)
    {
      rows.back().back() = point.Radius;
    }
  }
  return FlipFree::TextOfTable({ "kind", "x", "y", "z", "radius" }, rows);
}

std::string MarkupsOf(const std::vector<CorrectionPoint>& points)
{
  Json controls = Json::array();
  for (const CorrectionPoint& point : points)
  {
    std::string label = FlipFree::NameOf(point.Kind);
    if (point.Kind == ConstraintKind::Seed)
    {
      label += " " + FlipFree::ExactTextOf(point.Radius);
    }
    controls.push_back({ { "id", std::to_string(controls.size() + 1) }, { "label", label },
      { "position", point.Place }, { "selected", true }, { "locked", false },
      { "visibility", true }, { "positionStatus", "defined" } });
  }
  const Json content{ { "@schema",
                        "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/"
                        "Markups/Resources/Schema/markups-schema-v1.0.3.json#" },
    { "markups",
      Json::array({ Json{ { "type", "Fiducial" }, { "coordinateSystem", "LPS" },
        { "coordinateUnits", "mm" }, { "controlPoints", controls } } }) } };
  return content.dump(2) + "\n";
}

} // namespace

ConstraintKind KindOf(const std::string& name)
{
  const std::optional<ConstraintKind> kind = FlipFree::KindNamed(name);
  if (!kind)
  {
    throw Failure("the kind is '" + name + "'; it can be " + FlipFree::KindsInWords);
  }
  return *kind;
}

void RequireRadius(const CorrectionPoint& point)
{
  if (point.Kind == ConstraintKind::Seed && !(point.Radius > 0))
  {
    throw Failure("a seed has no radius");
  }
}

std::vector<CorrectionPoint> ReadPoints(const std::string& name, const std::string& whatTakesPlaces)
{
  std::vector<CorrectionPoint> points;
  PointReader reader;
  reader.Columns = "kind, x, y, z and radius";
  reader.TakeTable = [&](const std::string& text)
  {
    for (const FlipFree::PointConstraint& point :
      FlipFree::ReadConstraintTable(name, text, whatTakesPlaces))
    {
      points.push_back({ point.Kind, CoordinatesOf(point.Point), point.Radius });
    }
  };
  reader.TakeControl = [&points](const std::string& label, const auto& place)
  { points.push_back(PointOfControl(label, place)); };
  ReadPointText(name, reader);
  if (points.empty())
  {
    Warn("'" + name + "' holds no points, so nothing is corrected by it.");
  }
  return points;
}

std::vector<CorrectionPoint> PointsOfControls(const std::string& name,
  const std::vector<std::pair<std::string, std::array<double, 3>>>& controls)
{
  std::vector<CorrectionPoint> points;
  int number = 0;
  for (const auto& [label, place] : controls)
  {
    ++number;
    try
    {
      points.push_back(PointOfControl(label, place));
    }
    catch (const Failure& failure)
    {
      throw Failure(
        "'" + name + "', " + NameOfControl(number, label) + ": " + failure.what() + ".");
    }
  }
  return points;
}

std::vector<std::array<double, 3>> ReadPlaces(const std::string& name)
{
  std::vector<std::array<double, 3>> places;
  PointReader reader;
  reader.Columns = "x, y and z";
  reader.TakeTable = [&](const std::string& text)
  {
    for (const Eigen::Vector3d& place : FlipFree::ReadPlaceTable(name, text))
    {
      places.push_back(CoordinatesOf(place));
    }
  };
  reader.TakeControl = [&places](const std::string&, const auto& place)
  { places.push_back(place); };
  ReadPointText(name, reader);
  return places;
}

std::vector<CorrectionPoint> ReadStroke(const std::string& name, ConstraintKind kind)
{
  std::vector<CorrectionPoint> points;
  // A closed curve comes back to its first point.
  for (const std::array<double, 3>& place : ReadPlaces(name))
  {
    const bool isNew = std::none_of(points.begin(), points.end(),
      [&place](const CorrectionPoint& point)
      {
        const auto& [x, y, z] = point.Place;
        return std::hypot(place[0] - x, place[1] - y, place[2] - z) < SamePlace;
      });
    if (isNew)
    {
      points.push_back({ kind, place, 0 });
    }
  }
  if (points.empty())
  {
    throw Failure("'" + name + "' holds no points. Draw the stroke, or leave the option out.");
  }
  return points;
}

std::string TextOfPoints(const std::string& name, const std::vector<CorrectionPoint>& points)
{
  return HasEnding(name, { ".csv" }) ? TableOf(points) : MarkupsOf(points);
}

void RequireNoSeeds(const std::vector<CorrectionPoint>& points)
{
  if (std::any_of(points.begin(), points.end(),
        [](const CorrectionPoint& point) { return point.Kind == ConstraintKind::Seed; }))
  {
    throw Failure("--points: a seed is of no use to a vessel. Give a further --point along it.");
  }
}

} // namespace Command

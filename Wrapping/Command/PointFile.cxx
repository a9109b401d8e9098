#include "PointFile.h"

#include "Failure.h"
#include "OutputFile.h"

#include "vtkFlipFreeSegmentation.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace Command
{
namespace
{

using Json = nlohmann::json;

const std::string Kinds = "outside, inside, boundary or seed";

bool IsKind(const std::string& word)
{
  return word == "outside" || word == "inside" || word == "boundary" || word == "seed";
}

std::string Lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return word;
}

double NumberOf(const std::string& text)
{
  std::size_t read = 0;
  double number = NAN;
  try
  {
    number = std::stod(text, &read);
  }
  catch (const std::exception&)
  {
  }
  if (read == 0 || text.find_first_not_of(" \t\r", read) != std::string::npos ||
    !std::isfinite(number))
  {
    throw Failure("'" + text + "' is no number");
  }
  return number;
}

std::vector<std::string> CellsOf(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream stream(line);
  std::string cell;
  while (std::getline(stream, cell, ','))
  {
    const std::size_t first = cell.find_first_not_of(" \t\r");
    const std::size_t last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

CorrectionPoint PointOfLine(const std::string& line)
{
  const std::vector<std::string> cells = CellsOf(line);
  if (cells.size() < 4 || cells.size() > 5)
  {
    throw Failure("there are " + std::to_string(cells.size()) +
      " cells; there are kind, x, y, z and, of a seed, radius");
  }
  CorrectionPoint point;
  point.Kind = Lower(cells[0]);
  for (int axis = 0; axis < 3; ++axis)
  {
    point.Place[axis] = NumberOf(cells[axis + 1]);
  }
  point.Radius = cells.size() == 5 && !cells[4].empty() ? NumberOf(cells[4]) : 0;
  RequireProper(point);
  return point;
}

std::vector<CorrectionPoint> PointsOfTable(std::istream& file)
{
  std::vector<CorrectionPoint> points;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    const bool isHeader = number == 1 && Lower(line).rfind("kind", 0) == 0;
    if (isHeader || line.find_first_not_of(" \t\r") == std::string::npos)
    {
      continue;
    }
    try
    {
      points.push_back(PointOfLine(line));
    }
    catch (const Failure& failure)
    {
      throw Failure("line " + std::to_string(number) + ": " + failure.what());
    }
  }
  return points;
}

CorrectionPoint PointOfControl(const Json& control, bool isRAS)
{
  CorrectionPoint point;
  std::istringstream label(control.at("label").get<std::string>());
  std::string radius;
  label >> point.Kind >> radius;
  // 3D Slicer numbers its points: inside-1.
  point.Kind = Lower(point.Kind.substr(0, point.Kind.find_first_of("-_")));
  point.Place = control.at("position").get<std::array<double, 3>>();
  if (isRAS)
  {
    point.Place[0] = -point.Place[0];
    point.Place[1] = -point.Place[1];
  }
  if (!std::all_of(point.Place.begin(), point.Place.end(),
        [](double x) { return std::isfinite(x); }))
  {
    throw Failure("its position is not finite");
  }
  point.Radius = radius.empty() ? 0 : NumberOf(radius);
  RequireProper(point);
  return point;
}

std::vector<CorrectionPoint> PointsOfMarkups(std::istream& file)
{
  std::vector<CorrectionPoint> points;
  const Json content = Json::parse(file);
  for (const Json& list : content.at("markups"))
  {
    // Files before version 1.0.1 have a number: 0 for RAS.
    const Json system = list.value("coordinateSystem", Json("LPS"));
    const bool isRAS = system == "RAS" || system == 0 || system == "0";
    if (!isRAS && system != "LPS" && system != 1 && system != "1")
    {
      throw Failure("the coordinate system is " + system.dump() + "; it can be LPS or RAS");
    }
    for (const Json& control : list.at("controlPoints"))
    {
      try
      {
        points.push_back(PointOfControl(control, isRAS));
      }
      catch (const Failure& failure)
      {
        throw Failure("control point " + control.at("label").dump() + ": " + failure.what() +
          "; its label begins with its kind");
      }
    }
  }
  return points;
}

std::string TableOf(const std::vector<CorrectionPoint>& points)
{
  std::string text = "kind,x,y,z,radius\n";
  for (const CorrectionPoint& point : points)
  {
    char line[160];
    std::snprintf(line, sizeof(line), "%s,%.17g,%.17g,%.17g,", point.Kind.c_str(), point.Place[0],
      point.Place[1], point.Place[2]);
    text += line;
    if (point.Kind == "seed")
    {
      std::snprintf(line, sizeof(line), "%.17g", point.Radius);
      text += line;
    }
    text += "\n";
  }
  return text;
}

std::string MarkupsOf(const std::vector<CorrectionPoint>& points)
{
  Json controls = Json::array();
  for (const CorrectionPoint& point : points)
  {
    std::ostringstream label;
    label.precision(17);
    label << point.Kind;
    if (point.Kind == "seed")
    {
      label << " " << point.Radius;
    }
    controls.push_back({ { "id", std::to_string(controls.size() + 1) }, { "label", label.str() },
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

void RequireProper(const CorrectionPoint& point)
{
  if (!IsKind(point.Kind))
  {
    throw Failure("the kind is '" + point.Kind + "'; it can be " + Kinds);
  }
  if (point.Kind == "seed" && !(point.Radius > 0))
  {
    throw Failure("a seed has no radius");
  }
}

const std::vector<std::string>& PointEndings()
{
  static const std::vector<std::string> endings{ ".csv", ".mrk.json" };
  return endings;
}

std::vector<CorrectionPoint> ReadPoints(const std::string& name)
{
  std::ifstream file(name);
  if (!file)
  {
    throw Failure("'" + name + "' cannot be read. Check the name and the permissions.");
  }
  try
  {
    return HasEnding(name, { ".csv" }) ? PointsOfTable(file) : PointsOfMarkups(file);
  }
  catch (const Json::exception&)
  {
    throw Failure("'" + name +
      "' does not hold markups of 3D Slicer. Give a file of control points that it has saved, or "
      "a table (.csv) with the columns kind, x, y, z and radius.");
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + name + "', " + failure.what() + ".");
  }
}

void WritePoints(const std::string& name, const std::vector<CorrectionPoint>& points)
{
  const std::string text = HasEnding(name, { ".csv" }) ? TableOf(points) : MarkupsOf(points);
  WriteBytes(name, text.data(), text.size());
}

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeSegmentation* filter)
{
  for (const CorrectionPoint& point : points)
  {
    const auto& [x, y, z] = point.Place;
    if (point.Kind == "outside")
    {
      filter->AddOutsidePoint(x, y, z);
    }
    else if (point.Kind == "inside")
    {
      filter->AddInsidePoint(x, y, z);
    }
    else if (point.Kind == "boundary")
    {
      filter->AddBoundaryPoint(x, y, z);
    }
    else
    {
      filter->AddSeed(x, y, z, point.Radius);
    }
  }
}

} // namespace Command

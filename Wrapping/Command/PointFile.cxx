#include "PointFile.h"

#include "Coordinates.h"
#include "Failure.h"
#include "OutputFile.h"
#include "UnreadableFile.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkFlipFreeVesselSegmentation.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Command
{
namespace
{

using FlipFree::ConstraintKind;
using Json = nlohmann::json;

/// In the order of ConstraintKind.
constexpr std::array<const char*, 4> KindNames{ { "outside", "inside", "boundary", "seed" } };

std::string Lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return word;
}

// Decimal, as tables and markups have them; other programs read no hexadecimal ones either.
double NumberOf(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos ||
    end != text.c_str() + text.size() || !std::isfinite(number))
  {
    throw Failure("'" + text + "' is not a number");
  }
  return number;
}

std::string Trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  const std::size_t last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// What stands between commas, without quotes around it; empty cells at the end do not count.
std::vector<std::string> CellsOf(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string text; std::getline(stream, text, ',');)
  {
    std::string cell = Trimmed(text);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
    {
      cell = Trimmed(cell.substr(1, cell.size() - 2));
    }
    cells.push_back(cell);
  }
  while (!cells.empty() && cells.back().empty())
  {
    cells.pop_back();
  }
  return cells;
}

/// The first line may name the columns. Throws Failure for other columns than those of the lines.
bool IsHeader(std::vector<std::string> cells)
{
  std::transform(cells.begin(), cells.end(), cells.begin(), Lower);
  if (cells.front() != "kind")
  {
    return false;
  }
  std::vector<std::string> columns{ "kind", "x", "y", "z", "radius" };
  if (cells != columns && (columns.pop_back(), cells != columns))
  {
    throw Failure("the columns are kind, x, y, z and, for seeds, radius, in this order");
  }
  return true;
}

CorrectionPoint PointOfLine(const std::vector<std::string>& cells)
{
  if (cells.size() < 4 || cells.size() > 5)
  {
    throw Failure("cells separated by commas: " + std::to_string(cells.size()) +
      "; needed are kind, x, y, z and, of a seed, radius");
  }
  CorrectionPoint point;
  for (int axis = 0; axis < 3; ++axis)
  {
    point.Place[axis] = NumberOf(cells[axis + 1]);
  }
  point.Radius = cells.size() == 5 && !cells[4].empty() ? NumberOf(cells[4]) : 0;
  point.Kind = KindOf(Lower(cells[0]));
  RequireRadius(point);
  return point;
}

std::vector<CorrectionPoint> PointsOfTable(const std::string& text)
{
  std::istringstream file(text);
  std::vector<CorrectionPoint> points;
  std::string line;
  bool isFirst = true;
  for (int number = 1; std::getline(file, line); ++number)
  {
    const std::vector<std::string> cells = CellsOf(line);
    if (cells.empty())
    {
      continue;
    }
    try
    {
      if (!isFirst || !IsHeader(cells))
      {
        points.push_back(PointOfLine(cells));
      }
      isFirst = false;
    }
    catch (const Failure& failure)
    {
      throw Failure("line " + std::to_string(number) + ": " + failure.what());
    }
  }
  return points;
}

/// How the coordinates of a list of control points become LPS millimeters.
struct MarkupsFrame
{
  bool IsRAS = false;
  double Factor = 1;
  double Divisor = 1; ///< apart from the factor, so that whole micrometers are exact
};

/// Millimeters per unit, as a factor and a divisor. By UCUM's codes.
const std::vector<std::pair<std::string, std::array<double, 2>>> LengthUnits{
  { "nm", { { 1, 1e6 } } },
  { "um", { { 1, 1e3 } } },
  { "mm", { { 1, 1 } } },
  { "cm", { { 10, 1 } } },
  { "dm", { { 100, 1 } } },
  { "m", { { 1000, 1 } } },
  { "[in_i]", { { 25.4, 1 } } },
};

MarkupsFrame FrameOf(const Json& list)
{
  MarkupsFrame frame;
  // Files before version 1.0.1 have a number: 0 for RAS.
  const Json system = list.value("coordinateSystem", Json("LPS"));
  const std::string name = system.is_string() ? system.get<std::string>() : system.dump();
  frame.IsRAS = name == "RAS" || name == "0";
  if (!frame.IsRAS && name != "LPS" && name != "1")
  {
    throw Failure("the coordinate system is " + system.dump() + "; it can be LPS or RAS");
  }
  // From version 1.0.4 on, the code is the first word of a coded entry.
  Json unit = list.value("coordinateUnits", Json("mm"));
  unit = unit.is_array() && !unit.empty() ? unit.front() : unit;
  const auto found = std::find_if(LengthUnits.begin(), LengthUnits.end(),
    [&unit](const auto& known) { return unit == known.first; });
  if (found == LengthUnits.end())
  {
    throw Failure(
      "the unit of coordinates is " + unit.dump() + "; it can be nm, um, mm, cm, dm, m or [in_i]");
  }
  frame.Factor = found->second[0];
  frame.Divisor = found->second[1];
  return frame;
}

/// 3D Slicer also saves points that are yet to be placed, with or without a position.
bool IsPlaced(const Json& control)
{
  const Json& position = control.at("position");
  const bool isEmpty = position.is_string() && position.get<std::string>().empty();
  return control.value("positionStatus", Json("defined")) == "defined" && !isEmpty;
}

std::string LabelOf(const Json& control)
{
  return control.value("label", Json("")).get<std::string>();
}

CorrectionPoint PointOfControl(const Json& control, const MarkupsFrame& frame)
{
  CorrectionPoint point;
  std::istringstream label(LabelOf(control));
  std::string kind;
  std::string radius;
  label >> kind >> radius;
  const auto& position = control.at("position").get_ref<const Json::array_t&>();
  if (position.size() != 3 ||
    !std::all_of(position.begin(), position.end(), [](const Json& x) { return x.is_number(); }))
  {
    throw Failure("its position is not three numbers");
  }
  std::transform(position.begin(), position.end(), point.Place.begin(),
    [&frame](const Json& x) { return x.get<double>() * frame.Factor / frame.Divisor; });
  if (frame.IsRAS)
  {
    point.Place = SwapLpsRas(point.Place);
  }
  try
  {
    // 3D Slicer numbers its points: inside-1.
    point.Kind = KindOf(Lower(kind.substr(0, kind.find_first_of("-_"))));
    if (point.Kind == ConstraintKind::Seed && !radius.empty())
    {
      point.Radius = NumberOf(radius);
    }
    RequireRadius(point);
  }
  catch (const Failure& failure)
  {
    throw Failure(std::string(failure.what()) + "; its label begins with its kind");
  }
  return point;
}

std::vector<CorrectionPoint> PointsOfMarkups(const std::string& text)
{
  std::vector<CorrectionPoint> points;
  const Json content = Json::parse(text);
  for (const Json& list : content.at("markups").get_ref<const Json::array_t&>())
  {
    const MarkupsFrame frame = FrameOf(list);
    int number = 0;
    for (const Json& control : list.at("controlPoints").get_ref<const Json::array_t&>())
    {
      ++number;
      if (!IsPlaced(control))
      {
        continue;
      }
      try
      {
        points.push_back(PointOfControl(control, frame));
      }
      catch (const Failure& failure)
      {
        const std::string label = LabelOf(control);
        throw Failure("control point " +
          (label.empty() ? std::to_string(number) : Json(label).dump()) + ": " + failure.what());
      }
    }
  }
  return points;
}

bool IsText(const std::string& text)
{
  try
  {
    Json(text).dump(); // which takes no other bytes than UTF-8
  }
  catch (const Json::exception&)
  {
    return false;
  }
  return text.find('\0') == std::string::npos;
}

/// Without the mark that some programs put in front of UTF-8.
std::string TextOf(const std::string& name)
{
  const std::ifstream file(name, std::ios::binary);
  std::ostringstream content;
  std::error_code ignored;
  const bool isFile = file && !std::filesystem::is_directory(name, ignored);
  if (isFile)
  {
    content << file.rdbuf();
  }
  if (!isFile || content.bad())
  {
    throw UnreadableFile(name);
  }
  const std::string text = content.str();
  if (!IsText(text))
  {
    throw Failure("'" + name + "' is not UTF-8 text. Save it as UTF-8.");
  }
  return text.rfind("\xEF\xBB\xBF", 0) == 0 ? text.substr(3) : text;
}

std::string TableOf(const std::vector<CorrectionPoint>& points)
{
  std::string text = "kind,x,y,z,radius\n";
  for (const CorrectionPoint& point : points)
  {
    char line[160];
    std::snprintf(line, sizeof(line), "%s,%.17g,%.17g,%.17g,", KindName(point.Kind), point.Place[0],
      point.Place[1], point.Place[2]);
    text += line;
    if (point.Kind == ConstraintKind::Seed)
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
    label << KindName(point.Kind);
    if (point.Kind == ConstraintKind::Seed)
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

const char* KindName(ConstraintKind kind)
{
  return KindNames.at(static_cast<std::size_t>(kind));
}

ConstraintKind KindOf(const std::string& name)
{
  const auto found = std::find(KindNames.begin(), KindNames.end(), name);
  if (found == KindNames.end())
  {
    throw Failure("the kind is '" + name + "'; it can be outside, inside, boundary or seed");
  }
  return static_cast<ConstraintKind>(found - KindNames.begin());
}

void RequireRadius(const CorrectionPoint& point)
{
  if (point.Kind == ConstraintKind::Seed && !(point.Radius > 0))
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
  const std::string text = TextOf(name);
  try
  {
    return HasEnding(name, { ".csv" }) ? PointsOfTable(text) : PointsOfMarkups(text);
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

namespace
{

/// False for a seed.
template <typename Filter>
bool AddPoint(const CorrectionPoint& point, Filter* filter)
{
  const auto& [x, y, z] = point.Place;
  switch (point.Kind)
  {
    case ConstraintKind::Outside:
      filter->AddOutsidePoint(x, y, z);
      return true;
    case ConstraintKind::Inside:
      filter->AddInsidePoint(x, y, z);
      return true;
    case ConstraintKind::Boundary:
      filter->AddBoundaryPoint(x, y, z);
      return true;
    case ConstraintKind::Seed:
      break;
  }
  return false;
}

} // namespace

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeSegmentation* filter)
{
  for (const CorrectionPoint& point : points)
  {
    if (!AddPoint(point, filter))
    {
      const auto& [x, y, z] = point.Place;
      filter->AddSeed(x, y, z, point.Radius);
    }
  }
}

void AddPoints(const std::vector<CorrectionPoint>& points, vtkFlipFreeVesselSegmentation* filter)
{
  for (const CorrectionPoint& point : points)
  {
    if (!AddPoint(point, filter))
    {
      throw Failure("--points: a seed is of no use to a vessel. Give a further --point along it.");
    }
  }
}

} // namespace Command

#include "PointText.h"

#include "Coordinates.h"
#include "Failure.h"
#include "FileFormats.h"
#include "TextFile.h"

#include "Exchange/FileProblem.h"
#include "Exchange/TableText.h"
#include "TextWords.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace Command
{
namespace
{

using Json = nlohmann::json;

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

std::array<double, 3> PlaceOf(const Json& control, const MarkupsFrame& frame)
{
  const auto& position = control.at("position").get_ref<const Json::array_t&>();
  if (position.size() != 3 ||
    !std::all_of(position.begin(), position.end(), [](const Json& x) { return x.is_number(); }))
  {
    throw Failure("its position is not three numbers");
  }
  std::array<double, 3> place;
  std::transform(position.begin(), position.end(), place.begin(),
    [&frame](const Json& x) { return x.get<double>() * frame.Factor / frame.Divisor; });
  return frame.IsRAS ? SwapLpsRas(place) : place;
}

void ReadMarkups(const std::string& text, const PointReader& reader)
{
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
      const std::string label = control.value("label", Json("")).get<std::string>();
      try
      {
        reader.TakeControl(label, PlaceOf(control, frame));
      }
      catch (const Failure& failure)
      {
        throw Failure(NameOfControl(number, label) + ": " + failure.what());
      }
    }
  }
}

} // namespace

void ReadPointText(const std::string& name, const PointReader& reader)
{
  const std::string text = ReadText(name);
  try
  {
    HasEnding(name, { ".csv" }) ? reader.TakeTable(text) : ReadMarkups(text, reader);
  }
  catch (const Json::exception&)
  {
    throw Failure("'" + name +
      "' does not hold markups of 3D Slicer. Give a file of control points that it has saved, or "
      "a table (.csv) with the columns " +
      reader.Columns + ".");
  }
  catch (const FlipFree::FileProblem& problem)
  {
    throw Failure(problem.what());
  }
  catch (const Failure& failure)
  {
    throw Failure("'" + name + "', " + failure.what() + ".");
  }
}

std::string NameOfControl(int number, const std::string& label)
{
  return "control point " + (label.empty() ? std::to_string(number) : Json(label).dump());
}

double PointNumberOf(const std::string& text)
{
  double number = 0;
  if (!FlipFree::AreDecimals(text) || !FlipFree::ToNumber(text, number))
  {
    throw Failure("'" + text + "' is not a number");
  }
  return number;
}

} // namespace Command

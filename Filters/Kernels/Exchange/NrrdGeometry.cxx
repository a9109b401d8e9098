#include "Exchange/NrrdGeometry.h"
#include "TextWords.h"

#include "MessageText.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace FlipFree
{
namespace
{

/// Vectors such as (1,0,0.5), or none for an axis that is not one of space.
std::vector<std::vector<double>> NrrdVectors(const TextFields& fields, const std::string& field)
{
  std::vector<std::vector<double>> vectors;
  std::string rest = fields.Text(field);
  for (rest = Trimmed(rest); !rest.empty(); rest = Trimmed(rest))
  {
    std::vector<double> vector;
    std::size_t end = 4;
    if (rest.compare(0, 4, "none") != 0)
    {
      end = rest.find(')');
      if (rest[0] != '(' || end == std::string::npos)
      {
        fields.Refuse(field, "is not a list of vectors in parentheses");
      }
      std::string numbers = rest.substr(1, end - 1);
      std::replace(numbers.begin(), numbers.end(), ',', ' ');
      for (const std::string& word : Words(numbers))
      {
        double number = 0;
        if (!ToNumber(word, number))
        {
          fields.Refuse(field, "holds what is not a number");
        }
        vector.push_back(number);
      }
      ++end;
    }
    vectors.push_back(vector);
    rest.erase(0, end);
  }
  return vectors;
}

Eigen::Vector3d VectorOfSpace(const std::string& name, const TextFields& fields,
  const std::string& field, const std::vector<double>& numbers)
{
  for (const double number : numbers)
  {
    RequireLength(name, field, number);
  }
  if (numbers.size() != 3)
  {
    fields.Refuse(field, "is not in a space of three dimensions");
  }
  return { numbers[0], numbers[1], numbers[2] };
}

/// What turns the file's directions into left, posterior and superior; nothing where the file does
/// not say how its space lies in the patient.
std::optional<Eigen::Vector3d> SignsOfSpace(const TextFields& fields)
{
  const std::string space = InSmallLetters(fields.Text("space"));
  struct Space
  {
    const char* Name;
    const char* Short;
    Eigen::Vector3d Signs;
  };
  static const Space known[] = {
    { "left-posterior-superior", "lps", Eigen::Vector3d(1, 1, 1) },
    { "right-anterior-superior", "ras", Eigen::Vector3d(-1, -1, 1) },
    { "left-anterior-superior", "las", Eigen::Vector3d(1, -1, 1) },
  };
  for (const Space& candidate : known)
  {
    for (const std::string name : { candidate.Name, candidate.Short })
    {
      if (space == name || space == name + "-time" || space == name + "t")
      {
        return candidate.Signs;
      }
    }
  }
  const char* const others[] = { "", "scanner-xyz", "3d-right-handed", "3d-left-handed",
    "scanner-xyz-time", "3d-right-handed-time", "3d-left-handed-time" };
  if (std::none_of(std::begin(others), std::end(others),
        [&space](const char* other) { return space == other; }))
  {
    fields.Refuse("space",
      "is none of left-posterior-superior, right-anterior-superior and "
      "left-anterior-superior");
  }
  return std::nullopt;
}

/// A word in quotes, such as "mm", as a length in millimeters.
double NrrdUnit(const TextFields& fields, const std::string& field, const std::string& word)
{
  static const std::map<std::string, double> units{ { "", 1 }, { "mm", 1 }, { "millimeter", 1 },
    { "millimeters", 1 }, { "cm", 10 }, { "m", 1000 }, { "meter", 1000 }, { "meters", 1000 },
    { "um", 1e-3 }, { "\xC2\xB5m", 1e-3 }, { "\xCE\xBCm", 1e-3 }, { "micron", 1e-3 },
    { "microns", 1e-3 }, { "nm", 1e-6 }, { "?", 1 }, { "???", 1 } };
  const auto found = units.find(InSmallLetters(word));
  if (found == units.end())
  {
    fields.Refuse(field, "holds a unit that is no length");
  }
  return found->second;
}

/// The quoted words of a field.
std::vector<std::string> QuotedWords(const std::string& text)
{
  std::vector<std::string> words;
  for (std::size_t begin = text.find('"'); begin != std::string::npos;
       begin = text.find('"', begin))
  {
    const std::size_t end = std::min(text.find('"', begin + 1), text.size());
    words.push_back(Trimmed(text.substr(begin + 1, end - begin - 1)));
    begin = std::min(end + 1, text.size());
  }
  return words;
}

/// Of the space's three dimensions.
Eigen::Vector3d UnitsOfSpace(const TextFields& fields)
{
  Eigen::Vector3d units = Eigen::Vector3d::Ones();
  const std::vector<std::string> words = QuotedWords(fields.Text("space units"));
  for (std::size_t row = 0; row < std::min<std::size_t>(3, words.size()); ++row)
  {
    units[static_cast<Eigen::Index>(row)] = NrrdUnit(fields, "space units", words[row]);
  }
  return units;
}

Eigen::Vector3d NrrdSpacings(const std::string& name, const TextFields& fields,
  const NrrdAxes& axes, std::size_t dimension)
{
  const std::vector<double> spacings = fields.Numbers("spacings", dimension);
  const std::vector<std::string> words = QuotedWords(fields.Text("units"));
  Eigen::Vector3d steps;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t place = axes.OfSpace[axis];
    RequireSpacing(name, "spacings", spacings[place]);
    steps[static_cast<Eigen::Index>(axis)] =
      spacings[place] * (place < words.size() ? NrrdUnit(fields, "units", words[place]) : 1);
  }
  return steps;
}

/// Bounds of axes place voxels by a centering that files hardly ever say. NaN stands for none.
void RefuseBounds(const TextFields& fields)
{
  for (const char* const field : { "axis mins", "axis maxs" })
  {
    const std::vector<double> bounds = fields.Numbers(field);
    if (std::any_of(bounds.begin(), bounds.end(), [](double bound) { return !std::isnan(bound); }))
    {
      fields.Refuse(field,
        "places the voxels without saying whether their centers or their borders are meant. Give "
        "the file space directions and a space origin in its place");
    }
  }
}

} // namespace

NrrdAxes FindNrrdAxes(const TextFields& fields, std::size_t dimension)
{
  const std::vector<std::string> kinds = Words(InSmallLetters(fields.Text("kinds")));
  if (!kinds.empty() && kinds.size() != dimension)
  {
    fields.Refuse("kinds", "does not hold one word for each axis");
  }
  std::vector<std::vector<double>> vectors;
  if (fields.Has("space directions"))
  {
    vectors = NrrdVectors(fields, "space directions");
    if (vectors.size() != dimension)
    {
      fields.Refuse("space directions", "does not hold one vector for each axis");
    }
  }
  NrrdAxes axes;
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    const bool isOfSpace = !vectors.empty() ? !vectors[axis].empty()
                                            : kinds.empty() || kinds[axis] == "domain" ||
        kinds[axis] == "space" || kinds[axis] == "???" || kinds[axis] == "none";
    // Without a word about it, further axes come last.
    (isOfSpace && axes.OfSpace.size() < 3 ? axes.OfSpace : axes.Others).push_back(axis);
  }
  return axes;
}

ImageGeometry NrrdGrid(const std::string& name, const TextFields& fields, const NrrdAxes& axes,
  const std::vector<double>& sizes, std::vector<std::string>& warnings)
{
  const std::array<int, 3> size = { { static_cast<int>(sizes[axes.OfSpace[0]]),
    static_cast<int>(sizes[axes.OfSpace[1]]), static_cast<int>(sizes[axes.OfSpace[2]]) } };
  const std::optional<Eigen::Vector3d> signs = SignsOfSpace(fields);
  const Eigen::Vector3d scale =
    signs.value_or(Eigen::Vector3d::Ones()).cwiseProduct(UnitsOfSpace(fields));
  Eigen::Matrix3d steps;
  std::vector<Unsaid> unsaid;
  const bool hasDirections = fields.Has("space directions");
  if (!hasDirections)
  {
    RefuseBounds(fields);
  }
  if (hasDirections)
  {
    const std::vector<std::vector<double>> vectors = NrrdVectors(fields, "space directions");
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      steps.col(static_cast<Eigen::Index>(axis)) = scale.cwiseProduct(
        VectorOfSpace(name, fields, "space directions", vectors[axes.OfSpace[axis]]));
    }
  }
  else if (fields.Has("spacings"))
  {
    const Eigen::Vector3d spacings = NrrdSpacings(name, fields, axes, sizes.size());
    steps = spacings.cwiseProduct(signs.value_or(Eigen::Vector3d::Ones())).asDiagonal();
  }
  else
  {
    steps = signs.value_or(Eigen::Vector3d::Ones()).asDiagonal();
    unsaid.push_back(Unsaid::VoxelSize);
  }
  if (!signs)
  {
    unsaid.push_back(Unsaid::Axes);
  }
  else if (!hasDirections)
  {
    unsaid.push_back(Unsaid::AxesInSpace);
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (fields.Has("space origin"))
  {
    const std::vector<std::vector<double>> vectors = NrrdVectors(fields, "space origin");
    if (vectors.size() != 1)
    {
      fields.Refuse("space origin", "is not one vector");
    }
    origin = scale.cwiseProduct(VectorOfSpace(name, fields, "space origin", vectors.front()));
  }
  else
  {
    unsaid.push_back(Unsaid::Origin);
  }
  WarnOfUnsaid(name, unsaid, warnings);
  return GridOfSteps(name, size, steps, origin);
}

} // namespace FlipFree

#include "Exchange/SegmentationLayers.h"

#include "Exchange/FileProblem.h"
#include "Suggestion.h"
#include "TextWords.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <sstream>

namespace FlipFree
{
namespace
{

[[noreturn]] void RefuseSegmentField(const std::string& file, const std::string& field,
  const std::string& text)
{
  throw FileProblem(FileProblem::Kind::Unusable,
    "The field " + field + " of '" + file + "' is '" + text +
      "', not a whole number from 0 on. Save the segmentation again.");
}

using SegmentPairs = std::map<std::string, std::string>;

constexpr std::size_t MostNamedSegments = 20; // of a list that people read

// A whole number from 0 on, without anything else.
std::optional<int> LabelIn(const std::string& text)
{
  constexpr std::size_t mostDigits = 10;
  const bool isNumber = !text.empty() && text.size() <= mostDigits &&
    std::all_of(text.begin(), text.end(),
      [](unsigned char letter) { return std::isdigit(letter) != 0; });
  const long long number = isNumber ? std::stoll(text) : -1;
  return number >= 0 && number <= std::numeric_limits<int>::max()
    ? std::optional<int>(static_cast<int>(number))
    : std::nullopt;
}

// The numbers of the segments: 12 of Segment12_Name.
std::set<int> SegmentNumbers(const SegmentPairs& pairs)
{
  const std::string start = "Segment";
  std::set<int> numbers;
  for (const auto& [key, value] : pairs)
  {
    if (key.compare(0, start.size(), start) == 0)
    {
      const std::string rest = key.substr(start.size());
      const std::optional<int> number = LabelIn(rest.substr(0, rest.find('_')));
      if (number && rest.find('_') != std::string::npos)
      {
        numbers.insert(*number);
      }
    }
  }
  return numbers;
}

// Red, green and blue, 0 to 1, as #ffd24a; empty for anything else.
std::string ColorIn(const std::string& text)
{
  std::istringstream numbers(text);
  std::string color = "#";
  for (int channel = 0; channel < 3; ++channel)
  {
    double value = -1;
    numbers >> value;
    if (!(value >= 0 && value <= 1))
    {
      return {};
    }
    char digits[8];
    std::snprintf(digits, sizeof(digits), "%02lx", std::lround(255 * value));
    color += digits;
  }
  return color;
}

std::string ListOf(const std::vector<const Segment*>& segments)
{
  std::string list;
  for (std::size_t index = 0; index < std::min(segments.size(), MostNamedSegments); ++index)
  {
    list += (index > 0 ? ", '" : "'") + segments[index]->Name + "'";
  }
  return list + (segments.size() > MostNamedSegments ? " and more" : "");
}

template <typename Predicate>
std::vector<const Segment*> SegmentsWhere(const std::vector<Segment>& segments,
  const Predicate& holds)
{
  std::vector<const Segment*> found;
  for (const Segment& segment : segments)
  {
    if (holds(segment))
    {
      found.push_back(&segment);
    }
  }
  return found;
}

[[noreturn]] void RefuseChoice(const std::string& message)
{
  throw FileProblem(FileProblem::Kind::Missing, message);
}

LabelChoice ChoiceOf(const Segment& segment, int numberOfLayers, const std::string& file)
{
  if (segment.Layer >= numberOfLayers)
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "'" + file + "' has " + std::to_string(numberOfLayers) +
        " layers, but says that the segment '" + segment.Name + "' is in layer " +
        std::to_string(segment.Layer) + ", counted from 0. Save the segmentation again.");
  }
  return { segment.Layer, segment.Label };
}

} // namespace

std::vector<Segment> SegmentsOf(const std::map<std::string, std::string>& pairs,
  const std::string& file)
{
  std::vector<Segment> segments;
  for (const int number : SegmentNumbers(pairs))
  {
    const std::string start = "Segment" + std::to_string(number) + "_";
    const auto textOf = [&](const std::string& field)
    {
      const auto pair = pairs.find(start + field);
      return pair == pairs.end() ? std::string() : pair->second;
    };
    // Slicer before 4.11 has neither field, and a layer for each segment.
    const auto numberIn = [&](const std::string& field, int otherwise)
    {
      const std::string text = textOf(field);
      const std::optional<int> value = text.empty() ? otherwise : LabelIn(text);
      if (!value)
      {
        RefuseSegmentField(file, start + field, text);
      }
      return *value;
    };
    const auto position = static_cast<int>(segments.size());
    segments.push_back({ textOf("Name"), ColorIn(textOf("Color")), numberIn("LabelValue", 1),
      numberIn("Layer", position) });
  }
  return segments;
}

std::vector<Segment> SegmentsOf(const VolumeFileHeader& header)
{
  std::vector<Segment> segments = SegmentsOf(header.Pairs, header.Name);
  for (const auto& [label, name] : header.LabelNames)
  {
    segments.push_back({ name, "", label, 0 });
  }
  return segments;
}

LabelChoice ChooseLabel(const std::vector<Segment>& segments, int numberOfLayers,
  const std::string& choice, const std::string& file)
{
  const std::vector<const Segment*> all =
    SegmentsWhere(segments, [](const Segment&) { return true; });
  const std::string several =
    "'" + file + "' has " + std::to_string(numberOfLayers) + " layers of segments that may overlap";
  const std::string known = all.empty() ? "" : ": " + ListOf(all);
  if (choice.empty())
  {
    if (numberOfLayers > 1)
    {
      RefuseChoice(several + known + ". Choose one segment by its name.");
    }
    return {};
  }
  std::vector<const Segment*> found =
    SegmentsWhere(segments, [&](const Segment& segment) { return segment.Name == choice; });
  if (found.empty())
  {
    found = SegmentsWhere(segments,
      [&](const Segment& segment)
      { return InSmallLetters(segment.Name) == InSmallLetters(choice); });
  }
  const std::optional<int> label = LabelIn(choice);
  if (found.empty() && label)
  {
    if (numberOfLayers == 1)
    {
      return { 0, label }; // whether a segment has it or not
    }
    found =
      SegmentsWhere(segments, [&](const Segment& segment) { return segment.Label == *label; });
    if (found.empty())
    {
      RefuseChoice(
        several + known + ". None has the value " + choice + ". Choose one by its name.");
    }
  }
  if (found.size() > 1)
  {
    RefuseChoice("'" + file + "' has " + std::to_string(found.size()) + " segments called '" +
      choice + "': " + ListOf(found) + ". Choose one by its exact name, or rename them.");
  }
  if (!found.empty())
  {
    return ChoiceOf(*found.front(), numberOfLayers, file);
  }
  if (all.empty())
  {
    RefuseChoice(
      "'" + file + "' names no segments, so there is no '" + choice + "'. Give the label's value.");
  }
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Segment* segment : all)
  {
    names.push_back(segment->Name);
  }
  RefuseChoice("'" + file + "' has no segment '" + choice + "'." + Suggestion(choice, names) +
    " There are " + ListOf(all) + ".");
}

void CopyLayer(const void* voxels, std::size_t count, std::size_t bytes, const VoxelLayers& layers,
  int layer, void* labels)
{
  const std::size_t step = layers.AreInterleaved ? static_cast<std::size_t>(layers.Count) : 1;
  const std::size_t first = static_cast<std::size_t>(layer) * (layers.AreInterleaved ? 1 : count);
  const char* from = static_cast<const char*>(voxels) + first * bytes;
  char* to = static_cast<char*>(labels);
  for (std::size_t voxel = 0; voxel < count; ++voxel, from += step * bytes, to += bytes)
  {
    std::copy_n(from, bytes, to);
  }
}

} // namespace FlipFree

#include "Deformation/Provenance.h"

#include "Deformation/SegmentationParameters.h"
#include "JsonText.h"

#include <utility>

namespace FlipFree
{
namespace
{

std::string EntryOf(const PointConstraint& constraint)
{
  const bool isSeed = constraint.Kind == ConstraintKind::Seed;
  return std::string(R"({"kind":")") + NameOf(constraint.Kind) + R"(","position":)" +
    FlipFree::JsonOf(constraint.Point.data(), 3) +
    (isSeed ? ",\"radius\":" + FlipFree::JsonOf(constraint.Radius) : "") + "}";
}

/// The parameters that change the surface.
ParameterTable<VolumeSegmentationSettings> ParametersOfSurfaces()
{
  ParameterTable<VolumeSegmentationSettings> table;
  for (const auto& parameter : SegmentationParameters())
  {
    if (parameter.Name != "LabelValue" && parameter.Name != "KeepHistory")
    {
      table.push_back(parameter);
    }
  }
  return table;
}

std::string EntryOf(const OrganProvenance& organ, std::size_t index, const std::string& parameters)
{
  std::string entry = "{\"name\":" + FlipFree::JsonOf(organ.Name) + R"(,"kind":"organ","color":")" +
    DefaultColor(index) + "\",";
  if (organ.StartLabel >= 0)
  {
    entry +=
      R"("seed":null,"startLabels":{"name":"","label":)" + std::to_string(organ.StartLabel) + "},";
  }
  else
  {
    entry += R"("seed":{"center":)" + FlipFree::JsonOf(organ.Seed.Center.data(), 3) +
      ",\"radius\":" + FlipFree::JsonOf(organ.Seed.Radius) + "},";
  }
  entry += organ.HasStartSurface ? "\"startSurface\":true," : "";
  return entry + R"("preset":"default","parameters":)" + parameters +
    ",\"corrections\":" + FlipFree::JsonOf(organ.Constraints) + "}";
}

// Ends lines only between entries, where there is no space that readers of comments might drop.
std::vector<std::string> LinesOf(const std::string& provenance)
{
  constexpr std::size_t enough = 100; // letters
  std::vector<std::string> lines{ "" };
  bool isQuoted = false;
  for (std::size_t at = 0; at < provenance.size(); ++at)
  {
    const char letter = provenance[at];
    lines.back() += letter;
    if (letter == '\\')
    {
      lines.back() += provenance[++at];
    }
    isQuoted = isQuoted != (letter == '"');
    if (letter == ',' && !isQuoted && lines.back().size() >= enough)
    {
      lines.emplace_back();
    }
  }
  return lines;
}

} // namespace

std::string JsonOf(ConstraintList constraints)
{
  std::vector<std::string> entries;
  for (const PointConstraint& constraint : SortedConstraints(std::move(constraints)))
  {
    entries.push_back(EntryOf(constraint));
  }
  return JsonList(entries);
}

std::string SessionOf(const ImageGeometry& geometry, const std::vector<std::string>& organs,
  const std::string& more)
{
  const RowMajorMatrix direction = geometry.Direction;
  return "{\"format\":\"flipfree-session\",\"version\":2,\"flipfree\":\"" FLIPFREE_VERSION
         "\",\"image\":{\"name\":\"\",\"size\":" +
    JsonOf(geometry.Dimensions.data(), 3) + ",\"spacing\":" + JsonOf(geometry.Spacing.data(), 3) +
    ",\"origin\":" + JsonOf(geometry.Origin.data(), 3) +
    ",\"direction\":" + JsonOf(direction.data(), 9) + "},\"organs\":" + JsonList(organs) + more +
    "}";
}

std::string ProvenanceOf(const OrganProvenance& organ, const VolumeSegmentationSettings& settings,
  const ImageGeometry& geometry)
{
  return SessionOf(geometry, { EntryOf(organ, 0, JsonOf(ParametersOfSurfaces(), settings)) });
}

std::string ProvenanceOf(const std::vector<OrganProvenance>& organs, std::size_t fixed,
  const VolumeSegmentationSettings& settings, const ImageGeometry& geometry)
{
  const std::string parameters = JsonOf(ParametersOfSurfaces(), settings);
  std::vector<std::string> entries;
  entries.reserve(organs.size());
  for (const OrganProvenance& organ : organs)
  {
    entries.push_back(EntryOf(organ, entries.size(), parameters));
  }
  return SessionOf(geometry, entries,
    R"(,"together":true,"fixed":)" + JsonList(std::vector<std::string>(fixed, "\"\"")));
}

std::vector<std::string> CommentsOn(const std::string& provenance)
{
  // SPACE=LPS is what 3D Slicer looks for.
  std::vector<std::string> comments{ "FlipFree " FLIPFREE_VERSION ", millimeters, SPACE=LPS" };
  if (!provenance.empty())
  {
    for (const std::string& line : LinesOf(provenance))
    {
      comments.push_back("provenance " + line);
    }
  }
  return comments;
}

std::string DefaultColor(std::size_t organ)
{
  const char* const colors[] = { "#ffd24a", "#8fe388", "#ff8a7a", "#d9a0ff", "#ffb347", "#ff9ed2",
    "#c8e65a", "#e6cfa8" };
  return colors[organ % (sizeof(colors) / sizeof(colors[0]))];
}

} // namespace FlipFree

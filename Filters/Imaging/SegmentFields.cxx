#include "SegmentFields.h"

#include "ImageAdapter.h"
#include "VolumeHeader.h"

#include "Deformation/Provenance.h"
#include "Exchange/SegmentationLayers.h"
#include "Exchange/VolumeFileHeader.h"
#include "Image/LabelBoxes.h"
#include "MessageText.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace FlipFree
{
namespace
{

constexpr std::size_t MostSegments = 4096; // more is not a label map

[[noreturn]] void Refuse(const std::string& name, const std::string& why)
{
  throw ImageFileError(vtkErrorCode::FileFormatError, "'" + name + "' cannot be written: " + why);
}

LabelBoxes LabelBoxesOf(vtkImageData* labels, const std::string& name)
{
  LabelBoxes boxes;
  if (!VisitVoxels(labels, "the image{ on port 0}",
        [&boxes](const auto& view) { return FindLabelBoxes(view, MostSegments, boxes); }))
  {
    Refuse(name,
      "the voxels of a .seg.nrrd file are labels, whole numbers and few of them, and these are "
      "not. Write a .nrrd file.");
  }
  return boxes;
}

vtkAbstractArray* FieldOf(vtkImageData* labels, const char* name)
{
  return labels->GetFieldData()->GetAbstractArray(name);
}

/// Those that the field data name.
std::vector<Segment> NamedSegments(vtkImageData* labels, const std::string& name)
{
  vtkDataArray* const values = vtkDataArray::SafeDownCast(FieldOf(labels, "SegmentLabels"));
  auto* const names = vtkStringArray::SafeDownCast(FieldOf(labels, "SegmentNames"));
  auto* const colors = vtkStringArray::SafeDownCast(FieldOf(labels, "SegmentColors"));
  std::vector<Segment> segments;
  if (!values && !names && !colors)
  {
    return segments;
  }
  const vtkIdType count = values ? values->GetNumberOfValues() : -1;
  if (!names || names->GetNumberOfValues() != count ||
    (colors && colors->GetNumberOfValues() != count))
  {
    Refuse(name,
      "the field arrays SegmentLabels, SegmentNames and SegmentColors of the image on port 0 must "
      "hold a value for each segment. Give them as many, or remove them.");
  }
  for (vtkIdType index = 0; index < count; ++index)
  {
    const std::string color = colors ? colors->GetValue(index) : std::string();
    const double label = values->GetComponent(index, 0);
    if (!(std::abs(label) <= VTK_INT_MAX))
    {
      Refuse(name,
        "the field array SegmentLabels of the image on port 0 holds " + TextOf(label) +
          ", which is no label. Give whole numbers.");
    }
    segments.push_back({ names->GetValue(index),
      color.empty() ? DefaultColor(segments.size()) : color, static_cast<int>(label) });
  }
  return segments;
}

/// Red, green and blue, 0 to 1.
std::string ColorField(const std::string& color, const std::string& name)
{
  const bool isColor = color.size() == 7 && color[0] == '#' &&
    color.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!isColor)
  {
    Refuse(name,
      "the field array SegmentColors of the image on port 0 holds '" + color +
        "'. Give colors as #ffd24a.");
  }
  std::string field;
  for (int channel = 0; channel < 3; ++channel)
  {
    char text[64];
    const long value = std::strtol(color.substr(1 + 2 * channel, 2).c_str(), nullptr, 16);
    std::snprintf(text, sizeof(text), "%ld.%06ld", value / 255, value % 255 * 1000000 / 255);
    field += (channel > 0 ? " " : "") + std::string(text);
  }
  return field;
}

/// A field ends with its line.
std::string OneLine(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return static_cast<unsigned char>(letter) < 0x20; },
    ' ');
  return text;
}

/// First and last voxel along i, j and k.
std::string ExtentText(const VoxelBox& box)
{
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    text += (axis > 0 ? " " : "") + std::to_string(box.Begin[axis]) + " " +
      std::to_string(box.End[axis] - 1);
  }
  return text;
}

} // namespace

bool IsSegmentation(const std::string& name)
{
  return HasEnding(name, ".seg.nrrd");
}

FileFields SegmentFieldsOf(vtkImageData* labels, const std::string& name)
{
  const LabelBoxes boxes = LabelBoxesOf(labels, name);
  std::vector<Segment> segments = NamedSegments(labels, name);
  const std::size_t named = segments.size();
  const std::string file = std::filesystem::path(name).filename().string();
  for (const auto& [label, box] : boxes)
  {
    const bool isNamed = std::any_of(segments.begin(), segments.end(),
      [wanted = label](const Segment& segment) { return segment.Label == wanted; });
    if (!isNamed)
    {
      const bool isOnly = boxes.size() == 1;
      segments.push_back(
        { isOnly ? file.substr(0, file.find('.', 1)) : "Segment_" + std::to_string(label),
          DefaultColor(segments.size()), static_cast<int>(label) });
    }
  }
  FileFields fields{ { "Segmentation_ContainedRepresentationNames",
                       "Binary labelmap|Closed surface|" },
    { "Segmentation_MasterRepresentation", "Binary labelmap" }, // until Slicer 5.0
    { "Segmentation_SourceRepresentation", "Binary labelmap" },
    { "Segmentation_ReferenceImageExtentOffset", "0 0 0" } };
  for (std::size_t index = 0; index < segments.size(); ++index)
  {
    const Segment& segment = segments[index];
    const auto found = boxes.find(segment.Label);
    const std::string key = "Segment" + std::to_string(index) + "_";
    fields.insert(fields.end(),
      { { key + "ID", "Segment_" + std::to_string(segment.Label) },
        { key + "Name", OneLine(segment.Name) },
        { key + "NameAutoGenerated", index < named ? "0" : "1" },
        { key + "Color", ColorField(segment.Color, name) }, { key + "ColorAutoGenerated", "0" },
        { key + "Extent", ExtentText(found == boxes.end() ? VoxelBox() : found->second) },
        { key + "LabelValue", std::to_string(segment.Label) }, { key + "Layer", "0" } });
  }
  return fields;
}

} // namespace FlipFree

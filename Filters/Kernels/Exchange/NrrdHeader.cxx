#include "Exchange/NrrdHeader.h"

#include "Exchange/HeaderField.h"
#include "Exchange/NrrdGeometry.h"
#include "TextWords.h"

#include <algorithm>
#include <climits>
#include <set>

namespace FlipFree
{
namespace
{

/// Fields have several names.
std::string NrrdFieldOf(const std::string& name)
{
  static const std::map<std::string, std::string> others{ { "datafile", "data file" },
    { "lineskip", "line skip" }, { "byteskip", "byte skip" }, { "blocksize", "block size" },
    { "axismins", "axis mins" }, { "axismaxs", "axis maxs" }, { "oldmin", "old min" },
    { "oldmax", "old max" }, { "centers", "centerings" }, { "sampleunits", "sample units" } };
  const std::string small = InSmallLetters(Trimmed(name));
  const auto other = others.find(small);
  return other == others.end() ? small : other->second;
}

struct NrrdText
{
  TextFields Fields;
  std::map<std::string, std::string> Pairs;
  std::vector<std::string> List; ///< of files, where the field `data file` says LIST
  std::size_t End = 0;           ///< where an attached file's voxels begin
};

bool IsNrrdField(const std::string& name)
{
  static const std::set<std::string> fields{ "content", "number", "type", "block size", "dimension",
    "space", "space dimension", "sizes", "spacings", "thicknesses", "axis mins", "axis maxs",
    "space directions", "centerings", "kinds", "labels", "units", "min", "max", "old min",
    "old max", "endian", "encoding", "line skip", "byte skip", "sample units", "space units",
    "space origin", "measurement frame", "data file" };
  return fields.count(NrrdFieldOf(name)) > 0;
}

/// A field, `name: value`, or a pair of a user's own, `name:=value`, whose name may hold colons.
/// Old files have fields without the blank.
void ReadNrrdLine(const std::string& name, const std::string& line, NrrdText& text)
{
  const std::size_t colon = line.find(':');
  const std::size_t pair = line.find(":=");
  const std::string field = line.substr(0, colon);
  const bool hasBlank = colon != std::string::npos &&
    (colon + 1 == line.size() || line[colon + 1] == ' ' || line[colon + 1] == '\t');
  const bool isPair = pair != std::string::npos && !(hasBlank && IsNrrdField(field));
  const bool isField = hasBlank || (colon != std::string::npos && IsNrrdField(field));
  if (!(isPair || isField) || !IsPrintable(line))
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "The header of '" + name +
        "' is not valid NRRD to its end: the file is damaged. Download or copy it again.");
  }
  if (isPair)
  {
    const std::string valid = TextForPeople(line, true, true); // the format has ASCII alone
    const std::size_t split = valid.find(":=");
    text.Pairs.emplace(valid.substr(0, split), valid.substr(split + 2));
  }
  else
  {
    text.Fields.Add(NrrdFieldOf(field), Trimmed(line.substr(colon + 1)));
  }
}

NrrdText ReadNrrdText(const std::string& name, const std::string& start)
{
  NrrdText text{ TextFields(name), {}, {}, start.size() };
  LineReader lines(start);
  std::string line;
  lines.Next(line); // the mark
  while (lines.Next(line))
  {
    if (line.empty())
    {
      text.End = lines.Place();
      return text;
    }
    if (IsFileList(text.Fields, "data file"))
    {
      text.List.push_back(Trimmed(line));
    }
    else if (line[0] != '#')
    {
      ReadNrrdLine(name, line, text);
    }
  }
  return text; // a detached header needs no blank line
}

VoxelType NrrdType(const TextFields& fields)
{
  static const std::map<std::string, VoxelType> types{ { "signed char", VoxelType::Int8 },
    { "int8", VoxelType::Int8 }, { "int8_t", VoxelType::Int8 }, { "uchar", VoxelType::UInt8 },
    { "unsigned char", VoxelType::UInt8 }, { "uint8", VoxelType::UInt8 },
    { "uint8_t", VoxelType::UInt8 }, { "short", VoxelType::Int16 },
    { "short int", VoxelType::Int16 }, { "signed short", VoxelType::Int16 },
    { "signed short int", VoxelType::Int16 }, { "int16", VoxelType::Int16 },
    { "int16_t", VoxelType::Int16 }, { "ushort", VoxelType::UInt16 },
    { "unsigned short", VoxelType::UInt16 }, { "unsigned short int", VoxelType::UInt16 },
    { "uint16", VoxelType::UInt16 }, { "uint16_t", VoxelType::UInt16 }, { "int", VoxelType::Int32 },
    { "signed int", VoxelType::Int32 }, { "int32", VoxelType::Int32 },
    { "int32_t", VoxelType::Int32 }, { "uint", VoxelType::UInt32 },
    { "unsigned int", VoxelType::UInt32 }, { "uint32", VoxelType::UInt32 },
    { "uint32_t", VoxelType::UInt32 }, { "longlong", VoxelType::Int64 },
    { "long long", VoxelType::Int64 }, { "long long int", VoxelType::Int64 },
    { "signed long long", VoxelType::Int64 }, { "signed long long int", VoxelType::Int64 },
    { "int64", VoxelType::Int64 }, { "int64_t", VoxelType::Int64 },
    { "ulonglong", VoxelType::UInt64 }, { "unsigned long long", VoxelType::UInt64 },
    { "unsigned long long int", VoxelType::UInt64 }, { "uint64", VoxelType::UInt64 },
    { "uint64_t", VoxelType::UInt64 }, { "float", VoxelType::Float32 },
    { "double", VoxelType::Float64 } };
  const auto found = types.find(InSmallLetters(fields.Text("type")));
  if (found == types.end())
  {
    fields.Refuse("type", "is not a type of voxels");
  }
  return found->second;
}

VoxelStorage::Coding NrrdCoding(const TextFields& fields)
{
  const std::string encoding = InSmallLetters(fields.Text("encoding"));
  static const std::map<std::string, VoxelStorage::Coding> codings{ { "raw",
                                                                      VoxelStorage::Coding::Raw },
    { "gz", VoxelStorage::Coding::Deflated }, { "gzip", VoxelStorage::Coding::Deflated },
    { "txt", VoxelStorage::Coding::Text }, { "text", VoxelStorage::Coding::Text },
    { "ascii", VoxelStorage::Coding::Text }, { "hex", VoxelStorage::Coding::Hex } };
  const auto found = codings.find(encoding);
  if (found == codings.end())
  {
    fields.Refuse("encoding", "is not one of raw, gzip, text and hex");
  }
  return found->second;
}

bool NrrdIsBigEndian(const TextFields& fields, const VoxelStorage& storage)
{
  const std::string endian = InSmallLetters(fields.Text("endian"));
  if (endian != "big" && endian != "little" && storage.Form != VoxelStorage::Coding::Text &&
    SizeOf(storage.Type) > 1)
  {
    fields.Refuse("endian",
      fields.Has("endian") ? "is neither little nor big"
                           : "is missing, so that the order of the voxels' bytes is unknown");
  }
  return endian == "big";
}

VoxelStorage NrrdStorage(const std::string& name, const NrrdText& text)
{
  const TextFields& fields = text.Fields;
  VoxelStorage storage;
  storage.Type = NrrdType(fields);
  storage.Form = NrrdCoding(fields);
  storage.IsBigEndian = NrrdIsBigEndian(fields, storage);
  if (fields.Has("data file"))
  {
    storage.Files = FilesOfField(fields, "data file", text.List, true);
  }
  else
  {
    storage.Offset = text.End;
  }
  const long lines = fields.Integer("line skip", 0, INT_MAX, 0);
  const long bytes = fields.Integer("byte skip", -1, INT_MAX, 0);
  storage.IsAtEnd = bytes < 0;
  storage.Lines = storage.IsAtEnd ? 0 : static_cast<std::uint64_t>(lines);
  storage.Skipped = static_cast<std::uint64_t>(std::max(0L, bytes));
  RequireLengthOfVoxels(name, "byte skip", storage);
  return storage;
}

/// The axes that are not of space: components of one voxel, time points, or the layers of a
/// segmentation.
VoxelLayers NrrdLayers(const std::string& name, const NrrdText& text, const NrrdAxes& axes,
  const std::vector<double>& sizes)
{
  VoxelLayers layers;
  for (const std::size_t axis : axes.Others)
  {
    const auto size = static_cast<int>(sizes[axis]);
    const bool isFirst = axis < axes.OfSpace.front();
    const bool isSegmentation = text.Pairs.count("Segment0_ID") > 0;
    if (size > 1 && (!isSegmentation || layers.Count > 1))
    {
      if (isFirst)
      {
        RefuseComponents(name, size);
      }
      VolumeSize(name,
        { sizes[axes.OfSpace[0]], sizes[axes.OfSpace[1]], sizes[axes.OfSpace[2]],
          sizes[axis] }); // which refuses them
    }
    if (size > 1)
    {
      if (!isFirst && axis < axes.OfSpace.back())
      {
        text.Fields.Refuse(text.Fields.Has("kinds") ? "kinds" : "space directions",
          "puts the layers of segments between axes of space, but they must come first or last");
      }
      layers = { size, isFirst };
    }
  }
  return layers;
}

} // namespace

bool IsNrrd(const std::string& start)
{
  return start.compare(0, 4, "NRRD") == 0;
}

VolumeFileHeader ReadNrrdHeader(const std::string& name, const std::string& start)
{
  const NrrdText text = ReadNrrdText(name, start);
  const TextFields& fields = text.Fields;
  const long dimension = fields.Integer("dimension", 1, 16, 0);
  if (dimension == 0)
  {
    fields.Refuse("dimension", "is missing");
  }
  const std::vector<double> sizes = fields.Sizes("sizes", static_cast<std::size_t>(dimension));
  VolumeFileHeader header;
  header.Name = name;
  const NrrdAxes axes = FindNrrdAxes(fields, sizes.size());
  std::vector<double> ofSpace;
  for (const std::size_t axis : axes.OfSpace)
  {
    ofSpace.push_back(sizes[axis]);
  }
  VolumeSize(name, ofSpace); // refuses fewer than three
  header.Layers = NrrdLayers(name, text, axes, sizes);
  header.Storage = NrrdStorage(name, text);
  header.Geometry = NrrdGrid(name, fields, axes, sizes, header.Warnings);
  header.Pairs = text.Pairs;
  return header;
}

} // namespace FlipFree

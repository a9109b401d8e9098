#include "Exchange/MetaImageHeader.h"

#include "Exchange/HeaderField.h"
#include "MessageText.h"
#include "TextWords.h"

#include <climits>
#include <cmath>

namespace FlipFree
{
namespace
{

/// The field that ends the header.
const char* const PlaceOfVoxels = "ElementDataFile";

const char* const NamesOfAxes = "AnatomicalOrientation";

struct MetaImageText
{
  TextFields Fields;
  std::vector<std::string> List; ///< of files, where ElementDataFile says LIST
  std::size_t End = 0;           ///< where a local file's voxels begin
};

MetaImageText ReadMetaImageText(const std::string& name, const std::string& start)
{
  constexpr std::size_t longestName = 200;
  MetaImageText text{ TextFields(name), {}, 0 };
  LineReader lines(start);
  std::string line;
  while (!text.Fields.Has(PlaceOfVoxels) && lines.Next(line))
  {
    const std::size_t equals = line.find('=');
    if (Trimmed(line).empty())
    {
      continue;
    }
    if (!IsPrintable(line) || equals > longestName)
    {
      RefuseField(name, "a line", "is not of the form NAME = VALUE");
    }
    text.Fields.Add(Trimmed(line.substr(0, equals)), Trimmed(line.substr(equals + 1)));
  }
  if (!text.Fields.Has(PlaceOfVoxels))
  {
    text.Fields.Refuse(PlaceOfVoxels, "is missing");
  }
  text.End = lines.Place();
  while (IsFileList(text.Fields, PlaceOfVoxels) && lines.Next(line))
  {
    text.List.push_back(Trimmed(line));
  }
  return text;
}

VoxelType MetaImageType(const TextFields& fields)
{
  static const std::map<std::string, VoxelType> types{ { "MET_CHAR", VoxelType::Int8 },
    { "MET_UCHAR", VoxelType::UInt8 }, { "MET_SHORT", VoxelType::Int16 },
    { "MET_USHORT", VoxelType::UInt16 }, { "MET_INT", VoxelType::Int32 },
    { "MET_UINT", VoxelType::UInt32 }, { "MET_LONG", VoxelType::Int32 },
    { "MET_ULONG", VoxelType::UInt32 }, { "MET_LONG_LONG", VoxelType::Int64 },
    { "MET_ULONG_LONG", VoxelType::UInt64 }, { "MET_FLOAT", VoxelType::Float32 },
    { "MET_DOUBLE", VoxelType::Float64 } };
  const auto found = types.find(fields.Text("ElementType"));
  if (found == types.end())
  {
    fields.Refuse("ElementType", "is not a type of voxels");
  }
  return found->second;
}

bool IsTrue(const std::string& text)
{
  return !text.empty() && std::string("Tt1").find(text.front()) != std::string::npos;
}

/// The first of several names of a field that is there; an empty name if none is.
std::string NameThatIsThere(const TextFields& fields, std::initializer_list<const char*> names)
{
  for (const char* const name : names)
  {
    if (fields.Has(name))
    {
      return name;
    }
  }
  return {};
}

/// The first three of as many numbers as the file has dimensions.
Eigen::Vector3d MetaImageVector(const std::string& name, const TextFields& fields,
  const std::string& field, std::size_t dimension,
  void (*judge)(const std::string&, const std::string&, double))
{
  const std::vector<double> numbers = fields.Numbers(field, dimension);
  for (const double number : numbers)
  {
    judge(name, field, number);
  }
  return { numbers[0], numbers[1], numbers[2] };
}

/// LPS millimeters are the format's own.
ImageGeometry MetaImageGrid(const std::string& name, const TextFields& fields,
  const std::vector<double>& sizes, std::vector<Unsaid>& unsaid)
{
  const std::array<int, 3> size = VolumeSize(name, sizes);
  const std::size_t dimension = sizes.size();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  const std::string ofSpacing = NameThatIsThere(fields, { "ElementSpacing", "ElementSize" });
  if (ofSpacing.empty())
  {
    unsaid.push_back(Unsaid::VoxelSize);
  }
  else
  {
    spacing = MetaImageVector(name, fields, ofSpacing, dimension, RequireSpacing);
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const std::string ofOrigin = NameThatIsThere(fields, { "Offset", "Position", "Origin" });
  if (ofOrigin.empty())
  {
    unsaid.push_back(Unsaid::Origin);
  }
  else
  {
    origin = MetaImageVector(name, fields, ofOrigin, dimension, RequireLength);
  }
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const std::string ofAxes =
    NameThatIsThere(fields, { "TransformMatrix", "Rotation", "Orientation" });
  if (ofAxes.empty())
  {
    // From right to left, from anterior to posterior, from inferior to superior.
    const bool saysTheSame = InSmallLetters(fields.Text(NamesOfAxes)) == "rai";
    if (!saysTheSame)
    {
      unsaid.push_back(fields.Has(NamesOfAxes) ? Unsaid::AxesButForNames : Unsaid::Axes);
    }
  }
  else
  {
    const std::vector<double> numbers = fields.Numbers(ofAxes, dimension * dimension);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t row = 0; row < 3; ++row)
      {
        const double number = numbers[axis * dimension + row];
        RequireLength(name, ofAxes, number);
        axes(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)) = number;
      }
    }
  }
  return GridOfSteps(name, size, axes * spacing.asDiagonal(), origin);
}

/// MetaIO's scale of the stored voxels.
void ReadMetaImageScale(const TextFields& fields, VolumeFileHeader& header)
{
  for (const auto& [field, value] : { std::pair("ElementToIntensityFunctionSlope", &header.Slope),
         std::pair("ElementToIntensityFunctionOffset", &header.Intercept) })
  {
    if (fields.Has(field))
    {
      *value = fields.Numbers(field, 1).front();
      if (!std::isfinite(*value) || header.Slope == 0)
      {
        fields.Refuse(field, "is " + TextOf(*value) + ", which gives the voxels no values");
      }
    }
  }
}

/// What a file without it has is the byte order of the machine that wrote it.
void ReadMetaImageByteOrder(const TextFields& fields, VoxelStorage& storage,
  std::vector<Unsaid>& unsaid)
{
  const std::string field =
    NameThatIsThere(fields, { "ElementByteOrderMSB", "BinaryDataByteOrderMSB" });
  storage.IsBigEndian = IsTrue(fields.Text(field));
  if (field.empty() && storage.Form != VoxelStorage::Coding::Text && SizeOf(storage.Type) > 1)
  {
    unsaid.push_back(Unsaid::ByteOrder);
  }
}

} // namespace

bool IsMetaImage(const std::string& name, const std::string& start)
{
  return (HasEnding(name, ".mha") || HasEnding(name, ".mhd")) && !start.empty() &&
    static_cast<unsigned char>(start.front()) >= ' ';
}

VolumeFileHeader ReadMetaImageHeader(const std::string& name, const std::string& start)
{
  const MetaImageText text = ReadMetaImageText(name, start);
  const TextFields& fields = text.Fields;
  VolumeFileHeader header;
  header.Name = name;
  const long dimension = fields.Integer("NDims", 1, 10, 0);
  if (dimension == 0)
  {
    fields.Refuse("NDims", "is missing");
  }
  const std::vector<double> sizes = fields.Sizes("DimSize", static_cast<std::size_t>(dimension));
  const long channels = fields.Integer("ElementNumberOfChannels", 1, 10000, 1);
  if (channels > 1)
  {
    RefuseComponents(name, channels);
  }
  VoxelStorage& storage = header.Storage;
  storage.Type = MetaImageType(fields);
  std::vector<Unsaid> unsaid;
  header.Geometry = MetaImageGrid(name, fields, sizes, unsaid);
  ReadMetaImageScale(fields, header);

  const std::string place = InSmallLetters(fields.Text(PlaceOfVoxels));
  const bool isLocal = place == "local";
  if (!isLocal)
  {
    storage.Files = FilesOfField(fields, PlaceOfVoxels, text.List, false);
  }
  const long skipped = fields.Integer("HeaderSize", -1, INT_MAX, 0);
  storage.IsAtEnd = skipped < 0;
  storage.Offset =
    skipped > 0 ? static_cast<std::uint64_t>(skipped) : (isLocal ? text.End : std::size_t(0));
  if (fields.Has("BinaryData") && !IsTrue(fields.Text("BinaryData")))
  {
    storage.Form = VoxelStorage::Coding::Text;
  }
  else if (IsTrue(fields.Text("CompressedData")))
  {
    storage.Form = VoxelStorage::Coding::Deflated;
  }
  RequireLengthOfVoxels(name, "HeaderSize", storage);
  ReadMetaImageByteOrder(fields, storage, unsaid);
  WarnOfUnsaid(name, unsaid, header.Warnings);
  return header;
}

} // namespace FlipFree

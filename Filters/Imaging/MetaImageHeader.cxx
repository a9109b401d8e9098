#include "MetaImageHeader.h"

#include "HeaderField.h"
#include "VolumeFile.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace FlipFree
{
namespace
{

struct Header
{
  TextFields Fields;
  std::vector<std::string> List; ///< of files, where ElementDataFile says LIST
  std::streamoff End = 0;        ///< where a local file's voxels begin
};

/// The field that ends the header.
const char* const Place = "ElementDataFile";

/// ITK's MetaImage library copies names and values into buffers of fixed size.
bool FitsBuffers(const std::string& line, std::size_t equals)
{
  constexpr std::size_t longestName = 200;
  constexpr std::size_t longestLine = 10000;
  const bool isText = std::none_of(line.begin(), line.end(),
    [](char letter)
    { return static_cast<unsigned char>(letter) < ' ' && letter != '\t' && letter != '\r'; });
  return isText && equals < longestName && line.size() < longestLine;
}

/// Its buffers for these texts are shorter than those for lines.
void RequireShortText(const std::string& file, const std::string& field, const std::string& value)
{
  constexpr std::size_t longest = 254;
  const char* const texts[] = { "ObjectType", "ObjectSubType", "Name", "Comment",
    "AcquisitionDate" };
  if (value.size() > longest &&
    std::any_of(std::begin(texts), std::end(texts),
      [&](const char* text) { return field == text; }))
  {
    RefuseField(file, field, "is longer than 254 characters");
  }
}

Header ReadHeader(const std::string& name)
{
  constexpr std::streamoff longest = 1 << 20;
  std::ifstream file(name, std::ios::binary);
  Header header{ TextFields(name), {}, 0 };
  std::string line;
  while (!header.Fields.Has(Place) && std::getline(file, line))
  {
    const std::size_t equals = line.find('=');
    if (Trimmed(line).empty())
    {
      continue;
    }
    if (!FitsBuffers(line, equals) || file.tellg() > longest)
    {
      RefuseField(name, "a line", "is not of the form NAME = VALUE");
    }
    const std::string field = Trimmed(line.substr(0, equals));
    const std::string value = Trimmed(line.substr(equals + 1));
    RequireShortText(name, field, value);
    header.Fields.Add(field, value);
  }
  if (!header.Fields.Has(Place))
  {
    header.Fields.Refuse(Place, "is missing");
  }
  header.End = file.good() ? static_cast<std::streamoff>(file.tellg())
                           : static_cast<std::streamoff>(std::filesystem::file_size(name));
  const std::vector<std::string> words = Words(header.Fields.Text(Place));
  if (!words.empty() && words.front() == "LIST")
  {
    while (std::getline(file, line) && file.tellg() < longest)
    {
      header.List.push_back(Trimmed(line));
    }
  }
  return header;
}

double BytesOf(const TextFields& fields)
{
  static const std::map<std::string, double> bytes{ { "MET_CHAR", 1 }, { "MET_UCHAR", 1 },
    { "MET_SHORT", 2 }, { "MET_USHORT", 2 }, { "MET_INT", 4 }, { "MET_UINT", 4 }, { "MET_LONG", 4 },
    { "MET_ULONG", 4 }, { "MET_LONG_LONG", 8 }, { "MET_ULONG_LONG", 8 }, { "MET_FLOAT", 4 },
    { "MET_DOUBLE", 8 } };
  const auto found = bytes.find(fields.Text("ElementType"));
  if (found == bytes.end())
  {
    fields.Refuse("ElementType", "is not a type of voxels");
  }
  return found->second;
}

void RequireGeometry(const std::string& name, const TextFields& fields, std::size_t dimension)
{
  const auto require = [&](const char* field, std::size_t count,
                         void (*judge)(const std::string&, const std::string&, double))
  {
    if (fields.Has(field))
    {
      for (const double number : fields.Numbers(field, count))
      {
        judge(name, field, number);
      }
    }
  };
  for (const char* const field : { "ElementSpacing", "ElementSize" })
  {
    require(field, dimension, RequireSpacing);
  }
  for (const char* const field : { "Offset", "Position", "Origin", "CenterOfRotation" })
  {
    require(field, dimension, RequireLength);
  }
  for (const char* const field : { "TransformMatrix", "Rotation", "Orientation" })
  {
    require(field, dimension * dimension, RequireLength);
  }
}

bool IsTrue(const std::string& text)
{
  return !text.empty() && std::string("Tt1").find(text.front()) != std::string::npos;
}

void FindFiles(const std::string& name, const Header& header, VoxelStorage& storage)
{
  const TextFields& fields = header.Fields;
  const std::string place = fields.Text(Place);
  const std::vector<std::string> words = Words(place);
  if (place == "LOCAL" || place == "Local" || place == "local")
  {
    storage.Files = { name };
    storage.Offset = static_cast<std::uint64_t>(header.End);
    return;
  }
  if (!words.empty() && words.front() == "LIST")
  {
    storage.Files = header.List;
  }
  else if (place.find('%') != std::string::npos)
  {
    double numbers[3] = { 1, 1, 1 };
    const bool areNumbers = words.size() >= 3 && words.size() <= 4 &&
      ToNumber(words[1], numbers[0]) && ToNumber(words[2], numbers[1]) &&
      (words.size() == 3 || ToNumber(words[3], numbers[2]));
    if (!areNumbers ||
      std::any_of(std::begin(numbers), std::end(numbers),
        [](double number) { return !(std::abs(number) < INT_MAX); }))
    {
      fields.Refuse(Place, "is not a pattern with its first, its last and a step");
    }
    storage.Files = NumberedFiles(fields, Place, words.front(), static_cast<long>(numbers[0]),
      static_cast<long>(numbers[1]), static_cast<long>(numbers[2]));
  }
  else
  {
    storage.Files = { place };
  }
  for (std::string& file : storage.Files)
  {
    file = (std::filesystem::path(name).parent_path() / file).string();
  }
}

} // namespace

bool IsMetaImage(const std::string& name)
{
  char letter = '\0';
  return (EndsWith(name, ".mha") || EndsWith(name, ".mhd")) &&
    std::ifstream(name, std::ios::binary).get(letter) && letter >= ' ';
}

VoxelStorage StorageOfMetaImage(const std::string& name)
{
  const Header header = ReadHeader(name);
  const TextFields& fields = header.Fields;
  VoxelStorage storage;
  const long dimension = fields.Integer("NDims", 1, 10, 0);
  if (dimension == 0)
  {
    fields.Refuse("NDims", "is missing");
  }
  const double values = fields.Voxels("DimSize", static_cast<std::size_t>(dimension)) *
    static_cast<double>(fields.Integer("ElementNumberOfChannels", 1, 10000, 1));
  storage.NumberOfBytes = values * BytesOf(fields);
  RequireGeometry(name, fields, static_cast<std::size_t>(dimension));
  FindFiles(name, header, storage);

  if (storage.Files.empty())
  {
    fields.Refuse(Place, "names no file");
  }
  const long skipped = fields.Integer("HeaderSize", -1, INT_MAX, 0);
  if (skipped > 0)
  {
    storage.Offset = static_cast<std::uint64_t>(skipped);
  }
  if (fields.Has("BinaryData") && !IsTrue(fields.Text("BinaryData")))
  {
    storage.NumberOfBytes = 2 * values - 1; // at least a digit and a blank each
    storage.Encoding = VoxelStorage::Form::Other;
  }
  else if (IsTrue(fields.Text("CompressedData")))
  {
    storage.Encoding = VoxelStorage::Form::Deflated;
    std::error_code ignored;
    const auto size = std::filesystem::file_size(storage.Files.front(), ignored);
    fields.Integer("CompressedDataSize", 0, ignored ? LONG_MAX : static_cast<long>(size), 0);
  }
  else if (skipped < 0)
  {
    storage.Encoding = VoxelStorage::Form::Other;
  }
  return storage;
}

} // namespace FlipFree

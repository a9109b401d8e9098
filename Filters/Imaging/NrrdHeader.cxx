#include "NrrdHeader.h"

#include "HeaderField.h"
#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cctype>
#include <climits>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace FlipFree
{
namespace
{

std::string SmallLetters(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Fields have several names.
std::string FieldOf(const std::string& name)
{
  static const std::map<std::string, std::string> others{ { "datafile", "data file" },
    { "lineskip", "line skip" }, { "byteskip", "byte skip" }, { "blocksize", "block size" },
    { "axismins", "axis mins" }, { "axismaxs", "axis maxs" }, { "oldmin", "old min" },
    { "oldmax", "old max" }, { "centers", "centerings" } };
  const std::string small = SmallLetters(name);
  const auto other = others.find(small);
  return other == others.end() ? small : other->second;
}

struct Header
{
  TextFields Fields;
  std::vector<std::string> List; ///< of files, where the field `data file` says LIST
  std::streamoff End = 0;        ///< where an attached file's voxels begin
};

/// ITK's NRRD reader overruns a buffer when it reports some lines that it cannot parse, so that
/// only headers that look like one reach it: short lines of text with a colon, comments and pairs
/// of a user's own, and a blank line last.
bool LooksLikeField(const std::string& line)
{
  constexpr std::size_t longestName = 200;
  constexpr std::size_t longestField = 500;
  constexpr std::size_t longestPair = 10000; // which is not parsed
  const bool isText = std::none_of(line.begin(), line.end(),
    [](char letter) { return static_cast<unsigned char>(letter) < ' ' && letter != '\t'; });
  const std::size_t colon = line.find(':');
  const bool isFree =
    line[0] == '#' || (colon != std::string::npos && line.compare(colon, 2, ":=") == 0);
  return isText && line.size() < (isFree ? longestPair : longestField) &&
    (line[0] == '#' || colon < longestName);
}

bool IsList(const TextFields& fields)
{
  const std::vector<std::string> words = Words(fields.Text("data file"));
  return !words.empty() && words.front() == "LIST";
}

Header ReadHeader(const std::string& name)
{
  constexpr std::streamoff longest = 1 << 20;
  std::ifstream file(name, std::ios::binary);
  Header header{ TextFields(name), {}, 0 };
  std::string line;
  std::getline(file, line); // the mark
  while (std::getline(file, line) && file.tellg() < longest)
  {
    if (!line.empty() && line.back() == '\r')
    {
      line.pop_back();
    }
    if (line.empty())
    {
      header.End = file.tellg();
      return header;
    }
    if (IsList(header.Fields))
    {
      header.List.push_back(Trimmed(line));
      continue;
    }
    if (!LooksLikeField(line))
    {
      throw ImageFileError(vtkErrorCode::FileFormatError,
        "The header of '" + name +
          "' is not valid NRRD to its end: the file is damaged. Download or copy it again.");
    }
    const std::size_t colon = line.find(':');
    if (line[0] != '#' && line.compare(colon, 2, ":=") != 0) // a pair of a user's own
    {
      header.Fields.Add(FieldOf(line.substr(0, colon)), Trimmed(line.substr(colon + 1)));
    }
  }
  file.clear();
  header.End = file.tellg(); // a detached header needs no blank line
  return header;
}

double BytesOf(const TextFields& fields)
{
  static const std::map<std::string, double> bytes{ { "signed char", 1 }, { "int8", 1 },
    { "int8_t", 1 }, { "uchar", 1 }, { "unsigned char", 1 }, { "uint8", 1 }, { "uint8_t", 1 },
    { "short", 2 }, { "short int", 2 }, { "signed short", 2 }, { "signed short int", 2 },
    { "int16", 2 }, { "int16_t", 2 }, { "ushort", 2 }, { "unsigned short", 2 },
    { "unsigned short int", 2 }, { "uint16", 2 }, { "uint16_t", 2 }, { "int", 4 },
    { "signed int", 4 }, { "int32", 4 }, { "int32_t", 4 }, { "uint", 4 }, { "unsigned int", 4 },
    { "uint32", 4 }, { "uint32_t", 4 }, { "longlong", 8 }, { "long long", 8 },
    { "long long int", 8 }, { "signed long long", 8 }, { "signed long long int", 8 },
    { "int64", 8 }, { "int64_t", 8 }, { "ulonglong", 8 }, { "unsigned long long", 8 },
    { "unsigned long long int", 8 }, { "uint64", 8 }, { "uint64_t", 8 }, { "float", 4 },
    { "double", 8 } };
  const auto found = bytes.find(SmallLetters(fields.Text("type")));
  if (found == bytes.end())
  {
    fields.Refuse("type", "is not a type of voxels");
  }
  return found->second;
}

/// Vectors such as (1,0,0.5), or none for an axis that is not one of space.
std::vector<std::vector<double>> Vectors(const TextFields& fields, const std::string& field)
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

void RequireGeometry(const std::string& name, const TextFields& fields, std::size_t dimension)
{
  if (fields.Has("spacings"))
  {
    for (const double spacing : fields.Numbers("spacings", dimension))
    {
      if (!std::isnan(spacing)) // an axis that is not one of space
      {
        RequireSpacing(name, "spacings", spacing);
      }
    }
  }
  for (const char* const field : { "space directions", "space origin", "measurement frame" })
  {
    if (!fields.Has(field))
    {
      continue;
    }
    for (const std::vector<double>& vector : Vectors(fields, field))
    {
      for (const double entry : vector)
      {
        RequireLength(name, field, entry);
      }
      if (!vector.empty() && vector.size() != 3)
      {
        fields.Refuse(field, "is not in a space of three dimensions");
      }
    }
  }
  if (fields.Has("space directions") && Vectors(fields, "space directions").size() != dimension)
  {
    fields.Refuse("space directions", "does not hold one vector for each axis");
  }
}

void FindFiles(const std::string& name, const Header& header, VoxelStorage& storage)
{
  const TextFields& fields = header.Fields;
  if (!fields.Has("data file"))
  {
    storage.Files = { name };
    storage.Offset = static_cast<std::uint64_t>(header.End);
    return;
  }
  const std::string place = fields.Text("data file");
  const std::vector<std::string> words = Words(place);
  if (IsList(fields))
  {
    storage.Files = header.List;
  }
  else if (place.find('%') != std::string::npos)
  {
    double numbers[3] = { 0, 0, 0 };
    bool areNumbers = words.size() == 4;
    for (std::size_t index = 0; index < 3 && areNumbers; ++index)
    {
      areNumbers = ToNumber(words[index + 1], numbers[index]) && std::abs(numbers[index]) < INT_MAX;
    }
    if (!areNumbers)
    {
      fields.Refuse("data file", "is not a pattern with its first, its last and a step");
    }
    storage.Files = NumberedFiles(fields, "data file", words.front(), static_cast<long>(numbers[0]),
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

/// ITK's NRRD library copies each word of voxels that are text into a buffer of fixed size.
void RequireShortWords(const std::string& name, const VoxelStorage& storage)
{
  constexpr int longest = 100;
  for (const std::string& part : storage.Files)
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(part, ignored))
    {
      continue; // to be refused
    }
    std::ifstream file(part, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(storage.Offset));
    int length = 0;
    for (std::istreambuf_iterator<char> letter(file), end; letter != end; ++letter)
    {
      length = std::isspace(static_cast<unsigned char>(*letter)) ? 0 : length + 1;
      if (length > longest)
      {
        RefuseField(name, "encoding", "is text, but the voxels are not numbers");
      }
    }
  }
}

/// The position after this many lines; lines are skipped before anything else.
std::uint64_t AfterLines(const VoxelStorage& storage, long lines)
{
  std::error_code ignored;
  if (lines == 0 || !std::filesystem::is_regular_file(storage.Files.front(), ignored))
  {
    return storage.Offset;
  }
  std::ifstream file(storage.Files.front(), std::ios::binary);
  file.seekg(static_cast<std::streamoff>(storage.Offset));
  for (std::string line; lines > 0 && std::getline(file, line);)
  {
    --lines;
  }
  return file ? static_cast<std::uint64_t>(file.tellg())
              : std::filesystem::file_size(storage.Files.front(), ignored);
}

} // namespace

bool IsNrrd(const std::string& name)
{
  char mark[4] = {};
  return std::ifstream(name, std::ios::binary).read(mark, 4) && std::string(mark, 4) == "NRRD";
}

VoxelStorage StorageOfNrrd(const std::string& name)
{
  const Header header = ReadHeader(name);
  const TextFields& fields = header.Fields;
  VoxelStorage storage;
  const long dimension = fields.Integer("dimension", 1, 16, 0);
  if (dimension == 0)
  {
    fields.Refuse("dimension", "is missing");
  }
  const double values = fields.Voxels("sizes", static_cast<std::size_t>(dimension));
  storage.NumberOfBytes = values * BytesOf(fields);
  RequireGeometry(name, fields, static_cast<std::size_t>(dimension));
  FindFiles(name, header, storage);

  if (storage.Files.empty())
  {
    fields.Refuse("data file", "names no file");
  }
  const std::string encoding = SmallLetters(fields.Text("encoding"));
  storage.Offset = AfterLines(storage, fields.Integer("line skip", 0, INT_MAX, 0));
  const long bytes = fields.Integer("byte skip", -1, INT_MAX, 0);
  if (encoding == "raw")
  {
    if (bytes < 0)
    {
      storage.Encoding = VoxelStorage::Form::Other;
    }
    storage.Offset += static_cast<std::uint64_t>(std::max(0L, bytes));
  }
  else if (encoding == "gz" || encoding == "gzip")
  {
    storage.Encoding = VoxelStorage::Form::Deflated;
    storage.NumberOfBytes += static_cast<double>(std::max(0L, bytes)); // skipped when inflated
  }
  else if (encoding == "txt" || encoding == "text" || encoding == "ascii" || encoding == "hex")
  {
    // A value takes at least a digit and a blank, or a byte two digits.
    storage.NumberOfBytes = 2 * (encoding == "hex" ? storage.NumberOfBytes : values) - 1;
    storage.Encoding = VoxelStorage::Form::Other;
    if (encoding != "hex")
    {
      RequireShortWords(name, storage);
    }
  }
  else
  {
    fields.Refuse("encoding", "is not one of raw, gzip, text and hex");
  }
  return storage;
}

} // namespace FlipFree

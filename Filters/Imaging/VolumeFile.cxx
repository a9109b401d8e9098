#include "VolumeFile.h"

#include "InflatedFile.h"

#include "Exchange/SegmentationLayers.h"
#include "Exchange/VoxelDecoding.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

namespace FlipFree
{
namespace
{

std::string FirstBytes(const std::string& name)
{
  InflatedFile file(name, IsPackedFile(name));
  std::string start(BytesOfHeader, '\0');
  start.resize(file.Read(&start[0], start.size()));
  return start;
}

/// The file whose header describes this one.
std::string HeaderFileOf(const std::string& name)
{
  for (const std::string& file : HeaderFilesOf(name))
  {
    if (std::ifstream(file))
    {
      return file;
    }
  }
  return name;
}

void RequireReadable(const std::string& name)
{
  std::error_code ignored;
  const auto status = std::filesystem::status(name, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    throw FileProblem(FileProblem::Kind::Missing,
      "'" + name + "' is not a regular file. Give a file, or the folder of a DICOM series.");
  }
  if (!std::ifstream(name))
  {
    throw FileProblem(FileProblem::Kind::Missing,
      "'" + name + "' does not exist or cannot be read. Check its name and permissions.");
  }
}

double SizeOfFile(const std::string& name)
{
  std::error_code ignored;
  const auto status = std::filesystem::status(name, ignored);
  if (!std::filesystem::exists(status))
  {
    return MissingFile;
  }
  return std::filesystem::is_regular_file(status)
    ? static_cast<double>(std::filesystem::file_size(name, ignored))
    : IrregularFile;
}

/// Names of files relative to the header's become paths; of a pair, the voxels may be packed.
void FindFiles(const std::string& headerFile, VoxelStorage& storage)
{
  const std::filesystem::path folder = std::filesystem::path(headerFile).parent_path();
  for (std::string& file : storage.Files)
  {
    file = file.empty() ? headerFile : (folder / file).string();
    std::error_code ignored;
    if (storage.MayBePacked && !std::filesystem::exists(file, ignored) &&
      std::filesystem::exists(file + ".gz", ignored))
    {
      file += ".gz";
    }
  }
  // Only of a regular file: others may never end.
  if (storage.MayBePacked && SizeOfFile(storage.Files.front()) > 0 &&
    IsPackedFile(storage.Files.front()))
  {
    TakePacked(storage);
  }
}

/// Where the voxels begin in one of several files of as many bytes each.
std::uint64_t BeginOfVoxels(const VoxelStorage& storage, const std::string& file,
  std::uint64_t bytes)
{
  if (!storage.IsAtEnd)
  {
    return storage.Offset;
  }
  const auto size = static_cast<std::uint64_t>(std::max(0., SizeOfFile(file)));
  return size - std::min(size, bytes);
}

/// Skips a number of bytes once they are inflated; false where there are fewer.
bool SkipBytes(InflatedFile& file, std::uint64_t count)
{
  std::vector<char> ignored(std::min<std::uint64_t>(count, 1 << 16));
  while (count > 0)
  {
    const std::size_t part = std::min<std::uint64_t>(count, ignored.size());
    if (file.Read(ignored.data(), part) != part)
    {
      return false;
    }
    count -= part;
  }
  return true;
}

/// All that follows in the file.
std::string Rest(InflatedFile& file)
{
  std::string text;
  std::vector<char> part(1 << 16);
  for (std::size_t found = part.size(); found == part.size();)
  {
    found = file.Read(part.data(), part.size());
    text.append(part.data(), found);
  }
  return text;
}

/// All layers.
void ReadStoredVoxels(const VolumeFileHeader& header, void* values, const Monitor& monitor)
{
  const VoxelStorage& storage = header.Storage;
  const std::size_t ofFile = header.NumberOfStoredVoxels() / storage.Files.size();
  const std::size_t stored = SizeOf(storage.Type);
  const std::size_t ofValue = SizeOf(header.ValueType());
  constexpr std::size_t atATime = 1 << 18; // voxels
  std::vector<char> bytes(atATime * stored);
  auto* place = static_cast<char*>(values);
  std::size_t done = 0;
  for (const std::string& name : storage.Files)
  {
    InflatedFile file(name, storage.Form == VoxelStorage::Coding::Deflated,
      BeginOfVoxels(storage, name, ofFile * stored));
    file.SkipLines(storage.Lines);
    bool isWhole = SkipBytes(file, storage.Skipped);
    if (storage.Form == VoxelStorage::Coding::Text || storage.Form == VoxelStorage::Coding::Hex)
    {
      DecodeDigits(header, Rest(file), values);
      return;
    }
    for (std::size_t left = ofFile; isWhole && left > 0;)
    {
      const std::size_t count = std::min(atATime, left);
      isWhole = file.Read(bytes.data(), count * stored) == count * stored;
      DecodeVoxels(header, bytes.data(), count, place);
      place += count * ofValue;
      left -= count;
      done += count;
      if (!monitor(static_cast<double>(done) / static_cast<double>(header.NumberOfStoredVoxels())))
      {
        return;
      }
    }
    const bool endsProperly = file.EndsProperly();
    if (!endsProperly || !isWhole)
    {
      throw IncompleteVoxels(header.Name,
        endsProperly ? Incompleteness::TooFewVoxels : Incompleteness::BrokenStream);
    }
  }
}

} // namespace

VolumeFileHeader OpenVolumeFile(const std::string& name)
{
  RequireReadable(name);
  const std::string headerFile = HeaderFileOf(name);
  VolumeFileHeader header = ReadVolumeFileHeader(headerFile, FirstBytes(headerFile));
  FindFiles(headerFile, header.Storage);
  std::vector<double> sizes;
  for (const std::string& file : header.Storage.Files)
  {
    sizes.push_back(SizeOfFile(file));
  }
  RequireFiles(header, sizes);
  return header;
}

void ReadVolumeFile(const VolumeFileHeader& header, int layer, void* values, const Monitor& monitor)
{
  if (header.Layers.Count == 1)
  {
    ReadStoredVoxels(header, values, monitor);
    return;
  }
  const std::size_t bytes = SizeOf(header.ValueType());
  std::vector<char> all(header.NumberOfStoredVoxels() * bytes);
  ReadStoredVoxels(header, all.data(), monitor);
  CopyLayer(all.data(), header.Geometry.NumberOfVoxels(), bytes, header.Layers, layer, values);
}

} // namespace FlipFree

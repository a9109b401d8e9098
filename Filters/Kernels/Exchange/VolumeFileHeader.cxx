#include "Exchange/VolumeFileHeader.h"

#include "Exchange/MetaImageHeader.h"
#include "Exchange/NiftiHeader.h"
#include "Exchange/NrrdHeader.h"
#include "TextWords.h"

#include <algorithm>
#include <cctype>

namespace FlipFree
{
namespace
{

FileProblem NoVoxels(const std::string& name, const std::string& what)
{
  return { FileProblem::Kind::Incomplete,
    "The voxels of '" + name + "' cannot be read: " + what +
      ". The file is truncated or damaged. Download or copy it again." };
}

FileProblem WhyNotReadable(const std::string& name, const std::string& start)
{
  constexpr std::size_t preamble = 128;
  if (start.size() > preamble && start.compare(preamble, 4, "DICM") == 0)
  {
    return { FileProblem::Kind::Unrecognized,
      "'" + name +
        "' is a single slice of a DICOM series. Give the folder of its series instead." };
  }
  const char* const known[] = { ".nii", ".nii.gz", ".hdr", ".img", ".img.gz", ".nrrd", ".nhdr",
    ".mha", ".mhd" };
  if (std::any_of(std::begin(known), std::end(known),
        [&name](const char* ending) { return HasEnding(name, ending); }))
  {
    return { FileProblem::Kind::Unusable,
      "'" + name +
        "' does not begin as its file extension requires: the file is empty, truncated, " +
        "damaged, or in another format. Download or copy it again, or correct the extension." };
  }
  return { FileProblem::Kind::Unrecognized,
    "The format of '" + name + "' is unknown. Known are NIfTI (.nii, .nii.gz), NRRD (.nrrd, " +
      ".nhdr), MetaImage (.mha, .mhd) and folders of DICOM files." };
}

/// A header may name files in another encoding.
std::string InQuotedUtf8(const std::string& file)
{
  return "'" + TextForPeople(file, true, true) + "'";
}

/// The path with another ending, in the case of the letters that it has.
std::string WithEnding(const std::string& name, std::size_t length, const std::string& ending)
{
  const std::string stem = name.substr(0, name.size() - length);
  const bool isUpper = std::isupper(static_cast<unsigned char>(name.back())) != 0;
  std::string wanted = ending;
  if (isUpper)
  {
    std::transform(wanted.begin(), wanted.end(), wanted.begin(),
      [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  }
  return stem + wanted;
}

} // namespace

VoxelType VolumeFileHeader::ValueType() const
{
  if (!this->IsScaled())
  {
    return this->Storage.Type;
  }
  // Single precision holds 24 bits.
  return SizeOf(this->Storage.Type) > 2 && this->Storage.Type != VoxelType::Float32
    ? VoxelType::Float64
    : VoxelType::Float32;
}

bool HasEnding(const std::string& name, const std::string& ending)
{
  return name.size() >= ending.size() &&
    InSmallLetters(name.substr(name.size() - ending.size())) == ending;
}

std::vector<std::string> HeaderFilesOf(const std::string& name)
{
  for (const std::string ending : { ".img", ".img.gz" })
  {
    if (HasEnding(name, ending))
    {
      return { WithEnding(name, ending.size(), ".hdr"),
        WithEnding(name, ending.size(), ".hdr.gz") };
    }
  }
  return { name };
}

VolumeFileHeader ReadVolumeFileHeader(const std::string& name, const std::string& start)
{
  if (IsNrrd(start))
  {
    return ReadNrrdHeader(name, start);
  }
  if (IsNifti(start))
  {
    return ReadNiftiHeader(name, start);
  }
  if (IsMetaImage(name, start))
  {
    return ReadMetaImageHeader(name, start);
  }
  throw FileProblem(WhyNotReadable(name, start));
}

void TakePacked(VoxelStorage& storage)
{
  storage.Form = VoxelStorage::Coding::Deflated;
  storage.Skipped = storage.Offset;
  storage.Offset = 0;
}

void RequireFiles(const VolumeFileHeader& header, const std::vector<double>& sizes)
{
  const VoxelStorage& storage = header.Storage;
  double found = 0;
  for (std::size_t index = 0; index < sizes.size(); ++index)
  {
    const std::string file = InQuotedUtf8(storage.Files[index]);
    if (sizes[index] == MissingFile)
    {
      throw FileProblem(FileProblem::Kind::Missing,
        "There is no file " + file + ", which has the voxels of '" + header.Name +
          "'. Put it beside the header, or correct its name there.");
    }
    if (sizes[index] < 0)
    {
      throw FileProblem(NoVoxels(header.Name, file + " is not a regular file"));
    }
    found += std::max(0., sizes[index] - static_cast<double>(storage.Offset));
  }
  double voxels = header.Layers.Count; // more than an integer can number, maybe
  for (const int size : header.Geometry.Dimensions)
  {
    voxels *= size;
  }
  double wanted = voxels * static_cast<double>(SizeOf(storage.Type));
  // Deflate cannot exceed this ratio.
  constexpr double greatestRatio = 1032;
  switch (storage.Form)
  {
    case VoxelStorage::Coding::Deflated:
      found *= greatestRatio;
      break;
    case VoxelStorage::Coding::Text:
      wanted = 2 * voxels - 1; // a digit and a blank each
      break;
    case VoxelStorage::Coding::Hex:
      wanted *= 2;
      break;
    case VoxelStorage::Coding::Raw:
      break;
  }
  if (found < wanted)
  {
    const bool isOther = storage.Files.size() == 1 && storage.Files.front() != header.Name;
    throw FileProblem(NoVoxels(header.Name,
      (isOther ? InQuotedUtf8(storage.Files.front()) : "it") +
        " holds fewer voxels than its header says"));
  }
  if (header.NumberOfStoredVoxels() % sizes.size() != 0)
  {
    throw FileProblem(NoVoxels(header.Name,
      "its header names " + std::to_string(sizes.size()) +
        " files, which cannot hold as many voxels each"));
  }
}

FileProblem IncompleteVoxels(const std::string& name, Incompleteness reason)
{
  return NoVoxels(name,
    reason == Incompleteness::BrokenStream
      ? "its compressed stream breaks off or fails its checksum"
      : "it holds fewer voxels than its header says");
}

} // namespace FlipFree

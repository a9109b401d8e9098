#include "VoxelStorage.h"

#include "MetaImageHeader.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"
#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include <filesystem>

namespace FlipFree
{
namespace
{

VoxelStorage StorageByHeader(const std::string& name)
{
  if (IsNrrd(name))
  {
    return StorageOfNrrd(name);
  }
  if (IsMetaImage(name))
  {
    return StorageOfMetaImage(name);
  }
  return IsNifti(name) ? StorageOfNifti(name) : VoxelStorage();
}

ImageFileError Incomplete(const std::string& name, const std::string& what)
{
  return { vtkErrorCode::PrematureEndOfFileError,
    "The voxels of '" + name + "' cannot be read: " + what +
      ". The file is truncated or damaged. Download or copy it again." };
}

/// Before memory is allocated: voxels that cannot be there, and files that would never end.
void RequireFiles(const std::string& name, const VoxelStorage& storage)
{
  double size = 0;
  for (const std::string& file : storage.Files)
  {
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status))
    {
      throw Incomplete(name, "'" + file + "' is missing");
    }
    if (!std::filesystem::is_regular_file(status))
    {
      throw Incomplete(name, "'" + file + "' is not a regular file");
    }
    size += static_cast<double>(std::filesystem::file_size(file, failure));
  }
  // Deflate cannot exceed this ratio.
  constexpr double greatestRatio = 1032;
  const double greatest = storage.Encoding == VoxelStorage::Form::Deflated
    ? greatestRatio * size
    : size - static_cast<double>(storage.Offset);
  if (greatest < storage.NumberOfBytes)
  {
    const bool isOther = storage.Files.size() == 1 && storage.Files.front() != name;
    throw Incomplete(name,
      (isOther ? "'" + storage.Files.front() + "'" : "it") +
        " holds fewer voxels than its header says");
  }
}

} // namespace

VoxelStorage StorageOf(const std::string& name)
{
  VoxelStorage storage = StorageByHeader(name);
  RequireFiles(name, storage);
  return storage;
}

} // namespace FlipFree

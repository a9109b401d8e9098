#include "NiftiCheck.h"

#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include "itk_zlib.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

namespace FlipFree
{
namespace
{

using Gzip = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

Gzip OpenGzip(const std::string& name)
{
  Gzip file(gzopen(name.c_str(), "rb"), gzclose);
  if (file)
  {
    gzbuffer(file.get(), 1 << 17);
  }
  return file;
}

/// A number of the header, from the machine's byte order or the other.
template <typename T>
T Field(const unsigned char* header, int offset, bool swap)
{
  unsigned char bytes[sizeof(T)];
  std::copy_n(header + offset, sizeof(T), bytes);
  if (swap)
  {
    std::reverse(bytes, bytes + sizeof(T));
  }
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

struct NiftiLayout
{
  bool IsPair = false;      // .hdr and .img
  double NumberOfBytes = 0; // of header and voxels in the file that holds the voxels
};

/// By the layout of nifti1.h, which no version of the format has changed.
NiftiLayout LayoutOf(const std::string& name)
{
  unsigned char header[348] = {};
  const Gzip file = OpenGzip(name);
  if (!file || gzread(file.get(), header, sizeof(header)) != static_cast<int>(sizeof(header)))
  {
    return {};
  }
  const bool swap = Field<std::int32_t>(header, 0, false) != 348;
  NiftiLayout layout;
  layout.IsPair = std::memcmp(header + 344, "n+1", 3) != 0;
  const int dimension = std::min<int>(7, Field<std::int16_t>(header, 40, swap));
  double bits = Field<std::int16_t>(header, 72, swap);
  for (int axis = 1; axis <= dimension; ++axis)
  {
    bits *= std::max<int>(1, Field<std::int16_t>(header, 40 + 2 * axis, swap));
  }
  const double offset = Field<float>(header, 108, swap);
  layout.NumberOfBytes = std::ceil(bits / 8) + (layout.IsPair ? 0 : std::max(352.0, offset));
  return layout;
}

/// The first file of the pair that exists, .img or .img.gz.
std::string VoxelFileOfPair(const std::string& name)
{
  std::filesystem::path path(name);
  if (path.extension() == ".gz")
  {
    path.replace_extension();
  }
  path.replace_extension(".img");
  return std::filesystem::exists(path) ? path.string() : path.string() + ".gz";
}

ImageFileError Incomplete(const std::string& name, const std::string& what)
{
  return { vtkErrorCode::PrematureEndOfFileError,
    "The voxels of '" + name + "' cannot be read: " + what +
      ". The file is truncated or damaged: get it anew." };
}

void RequireCompleteGzip(const std::string& name, gzFile file, double wanted,
  const Monitor& monitor)
{
  const double size = static_cast<double>(std::filesystem::file_size(name));
  std::vector<unsigned char> chunk(1 << 19);
  double found = 0;
  for (int count = 1; count > 0; found += std::max(0, count))
  {
    if (!monitor(std::min(1.0, static_cast<double>(gzoffset(file)) / size)))
    {
      return;
    }
    count = gzread(file, chunk.data(), static_cast<unsigned int>(chunk.size()));
  }
  int error = Z_OK;
  gzerror(file, &error);
  if (error != Z_OK && error != Z_STREAM_END)
  {
    throw Incomplete(name, "its gzip stream breaks off or fails its checksum");
  }
  if (found < wanted)
  {
    throw Incomplete(name, "it holds fewer voxels than its header says");
  }
}

} // namespace

void RequireCompleteNifti(const std::string& name, const Monitor& monitor)
{
  const NiftiLayout layout = LayoutOf(name);
  const std::string voxels = layout.IsPair ? VoxelFileOfPair(name) : name;
  const Gzip file = OpenGzip(voxels);
  if (!file)
  {
    throw Incomplete(name, "'" + voxels + "' is missing");
  }
  if (!gzdirect(file.get()))
  {
    RequireCompleteGzip(voxels, file.get(), layout.NumberOfBytes, monitor);
  }
  else if (static_cast<double>(std::filesystem::file_size(voxels)) < layout.NumberOfBytes)
  {
    throw Incomplete(voxels, "it holds fewer voxels than its header says");
  }
}

} // namespace FlipFree

#include "CompletenessCheck.h"

#include "vtkErrorCode.h"

#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itk_zlib.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <vector>

namespace FlipFree
{
namespace
{

double SizeOf(const std::string& name)
{
  std::error_code failure;
  const auto size = std::filesystem::file_size(name, failure);
  return failure ? 0 : static_cast<double>(size);
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
  // Of a file that is not compressed it reads the plain bytes.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(name.c_str(), "rb"), gzclose);
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
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path.string() : path.string() + ".gz";
}

ImageFileError Incomplete(const std::string& name, const std::string& what)
{
  return { vtkErrorCode::PrematureEndOfFileError,
    "The voxels of '" + name + "' cannot be read: " + what +
      ". The file is truncated or damaged: get it anew." };
}

/// Inflates what follows in the file, of zlib or gzip, until it has given as many bytes as wanted,
/// and on to the checksum of that part; of several gzip members, one after the other.
void RequireCompleteStream(const std::string& name, std::ifstream& file, double wanted,
  const Monitor& monitor)
{
  std::vector<char> packed(1 << 17);
  std::vector<unsigned char> plain(1 << 19);
  z_stream stream = {};
  if (inflateInit2(&stream, MAX_WBITS + 32) != Z_OK)
  {
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  double found = 0;
  int state = Z_OK;
  while (state == Z_OK && monitor(std::min(1.0, found / wanted)))
  {
    if (stream.avail_in == 0)
    {
      file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
      stream.next_in = reinterpret_cast<unsigned char*>(packed.data());
      stream.avail_in = static_cast<unsigned int>(file.gcount());
    }
    stream.next_out = plain.data();
    stream.avail_out = static_cast<unsigned int>(plain.size());
    state = inflate(&stream, Z_NO_FLUSH); // without input left: Z_BUF_ERROR
    found += static_cast<double>(plain.size() - stream.avail_out);
    if (state == Z_STREAM_END && found < wanted && (stream.avail_in > 0 || file.peek() != EOF))
    {
      state = inflateReset(&stream);
    }
  }
  if (state != Z_OK && state != Z_STREAM_END)
  {
    throw Incomplete(name, "its compressed stream breaks off or fails its checksum");
  }
  if (state == Z_STREAM_END && found < wanted)
  {
    throw Incomplete(name, "it holds fewer voxels than its header says");
  }
}

void RequireCompleteNifti(const std::string& name, const Monitor& monitor)
{
  const NiftiLayout layout = LayoutOf(name);
  const std::string voxels = layout.IsPair ? VoxelFileOfPair(name) : name;
  std::ifstream file(voxels, std::ios::binary);
  if (!file)
  {
    throw Incomplete(name, "'" + voxels + "' is missing");
  }
  if (file.get() == 0x1F && file.get() == 0x8B) // the mark of gzip
  {
    file.seekg(0);
    RequireCompleteStream(voxels, file, layout.NumberOfBytes, monitor);
  }
  else if (SizeOf(voxels) < layout.NumberOfBytes)
  {
    throw Incomplete(voxels, "it holds fewer voxels than its header says");
  }
}

/// The fields of a MetaImage header, which ends with the name of the voxels' file; `end` is where.
std::map<std::string, std::string> MetaImageFields(const std::string& name, std::streamoff& end)
{
  std::map<std::string, std::string> fields;
  std::ifstream file(name, std::ios::binary);
  std::string line;
  while (fields.count("ElementDataFile") == 0 && std::getline(file, line))
  {
    const auto trimmed = [](const std::string& text)
    {
      const std::size_t first = text.find_first_not_of(" \t\r");
      return first == std::string::npos
        ? std::string()
        : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
    };
    const std::size_t equals = std::min(line.find('='), line.size());
    fields[trimmed(line.substr(0, equals))] =
      trimmed(line.substr(std::min(equals + 1, line.size())));
  }
  end = file.tellg();
  return fields;
}

void RequireCompleteMetaImage(const std::string& name, double wanted, const Monitor& monitor)
{
  std::streamoff offset = 0;
  auto fields = MetaImageFields(name, offset);
  std::string voxels = name;
  const std::string place = fields["ElementDataFile"];
  if (place == "LIST" || place.find('%') != std::string::npos || fields["BinaryData"] == "False")
  {
    return; // many files, or numbers as text
  }
  if (place != "LOCAL" && place != "Local" && place != "local")
  {
    voxels = (std::filesystem::path(name).parent_path() / place).string();
    offset = 0;
  }
  std::ifstream file(voxels, std::ios::binary);
  if (!file)
  {
    throw Incomplete(name, "'" + voxels + "' is missing");
  }
  if (fields["CompressedData"] == "True")
  {
    file.seekg(offset);
    RequireCompleteStream(name, file, wanted, monitor);
  }
  else if (SizeOf(voxels) < wanted + static_cast<double>(offset))
  {
    throw Incomplete(name, "it holds fewer voxels than its header says");
  }
}

} // namespace

void RequireComplete(itk::ImageIOBase* io, const std::string& name, const Monitor& monitor)
{
  if (dynamic_cast<itk::NiftiImageIO*>(io))
  {
    RequireCompleteNifti(name, monitor);
  }
  else if (dynamic_cast<itk::MetaImageIO*>(io))
  {
    RequireCompleteMetaImage(name, static_cast<double>(HeaderOf(io, name).NumberOfBytes()),
      monitor);
  }
}

} // namespace FlipFree

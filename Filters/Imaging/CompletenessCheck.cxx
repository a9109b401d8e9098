#include "CompletenessCheck.h"

#include "VoxelStorage.h"

#include "vtkErrorCode.h"

#include "itk_zlib.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

namespace FlipFree
{
namespace
{

ImageFileError Incomplete(const std::string& name, const std::string& what)
{
  return { vtkErrorCode::PrematureEndOfFileError,
    "The voxels of '" + name + "' cannot be read: " + what +
      ". The file is truncated or damaged. Download or copy it again." };
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

} // namespace

void RequireComplete(const std::string& name, const Monitor& monitor)
{
  const VoxelStorage storage = StorageOf(name);
  if (storage.Encoding == VoxelStorage::Form::Deflated && storage.Files.size() == 1)
  {
    std::ifstream file(storage.Files.front(), std::ios::binary);
    file.seekg(static_cast<std::streamoff>(storage.Offset));
    RequireCompleteStream(name, file, storage.NumberOfBytes, monitor);
  }
}

} // namespace FlipFree

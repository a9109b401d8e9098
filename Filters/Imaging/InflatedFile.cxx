#include "InflatedFile.h"

#include "Exchange/VolumeFileHeader.h"

#include "itk_zlib.h"

#include <algorithm>
#include <limits>
#include <new>

namespace FlipFree
{

struct InflatedFile::Stream
{
  Stream()
  {
    if (inflateInit2(&this->Zlib, MAX_WBITS + 32) != Z_OK) // of zlib or gzip
    {
      throw std::bad_alloc();
    }
  }
  ~Stream() { inflateEnd(&this->Zlib); }
  Stream(const Stream&) = delete;
  void operator=(const Stream&) = delete;

  z_stream Zlib = {};
  std::vector<char> Input = std::vector<char>(1 << 17);
  int State = Z_OK;
};

InflatedFile::InflatedFile(const std::string& name, bool isPacked, std::uint64_t offset)
  : File(name, std::ios::binary)
  , Packed(isPacked ? std::make_unique<Stream>() : nullptr)
{
  this->File.seekg(static_cast<std::streamoff>(offset));
}

InflatedFile::~InflatedFile() = default;

std::size_t InflatedFile::Inflate(unsigned char* bytes, std::size_t size, bool isInOneMember)
{
  Stream& packed = *this->Packed;
  std::size_t found = 0;
  while (found < size && (packed.State == Z_OK || (packed.State == Z_STREAM_END && !isInOneMember)))
  {
    if (packed.Zlib.avail_in < 2) // bytes of a mark
    {
      std::copy_n(packed.Zlib.next_in, packed.Zlib.avail_in, packed.Input.data());
      this->File.read(packed.Input.data() + packed.Zlib.avail_in,
        static_cast<std::streamsize>(packed.Input.size() - packed.Zlib.avail_in));
      packed.Zlib.next_in = reinterpret_cast<unsigned char*>(packed.Input.data());
      packed.Zlib.avail_in += static_cast<unsigned int>(this->File.gcount());
    }
    if (packed.State == Z_STREAM_END)
    {
      if (packed.Zlib.avail_in < 2 ||
        !std::equal(PackedMark, PackedMark + 2, reinterpret_cast<char*>(packed.Zlib.next_in)))
      {
        return found; // padding, if anything
      }
      packed.State = inflateReset(&packed.Zlib); // another member of gzip
    }
    const auto wanted =
      static_cast<unsigned int>(std::min<std::size_t>(size - found, std::size_t(1) << 30));
    packed.Zlib.next_out = bytes + found;
    packed.Zlib.avail_out = wanted;
    packed.State = inflate(&packed.Zlib, Z_NO_FLUSH); // without input left: Z_BUF_ERROR
    found += wanted - packed.Zlib.avail_out;
  }
  return found;
}

std::size_t InflatedFile::Read(void* bytes, std::size_t size)
{
  if (this->Packed)
  {
    return this->Inflate(static_cast<unsigned char*>(bytes), size, false);
  }
  this->File.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size));
  return static_cast<std::size_t>(this->File.gcount());
}

void InflatedFile::SkipLines(std::uint64_t lines)
{
  for (; lines > 0 && this->File; --lines)
  {
    this->File.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
}

bool InflatedFile::EndsProperly()
{
  std::vector<unsigned char> ignored(this->Packed ? 1 << 16 : 0);
  while (this->Packed && this->Packed->State == Z_OK)
  {
    this->Inflate(ignored.data(), ignored.size(), true);
  }
  return !this->Packed || this->Packed->State == Z_STREAM_END;
}

bool IsPackedFile(const std::string& name)
{
  char mark[2] = {};
  std::ifstream(name, std::ios::binary).read(mark, sizeof(mark));
  return std::equal(mark, mark + 2, PackedMark);
}

} // namespace FlipFree

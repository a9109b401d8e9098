#include "DicomFolder.h"

#include "DicomDecoder.h"

#include "Exchange/FileProblem.h"

#include "itk_zlib.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

namespace FlipFree
{
namespace
{

/// The rest of a deflated file, unpacked; cut off where it is damaged, or too large to be true.
std::string Inflated(const std::string& packed)
{
  constexpr std::size_t greatest = std::size_t(1) << 31;
  z_stream stream = {};
  inflateInit2(&stream, -MAX_WBITS); // without a header of its own
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string plain;
  std::string part(1 << 16, '\0');
  for (int state = Z_OK; state == Z_OK && plain.size() < greatest;)
  {
    stream.next_out = reinterpret_cast<Bytef*>(&part[0]);
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    plain.append(part, 0, part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return plain;
}

/// A file as the kernels read it: unpacked, if it is deflated.
std::unique_ptr<std::istream> OpenUnpacked(const std::string& name, std::uint64_t deflatedOffset)
{
  auto file = std::make_unique<std::ifstream>(name, std::ios::binary);
  if (deflatedOffset == 0)
  {
    return file;
  }
  const std::string bytes{ std::istreambuf_iterator<char>(*file), {} };
  const std::size_t begin = std::min<std::size_t>(deflatedOffset, bytes.size());
  return std::make_unique<std::istringstream>(
    bytes.substr(0, begin) + Inflated(bytes.substr(begin)));
}

DicomFile ReadFile(const std::string& name)
{
  DicomFile file;
  file.Name = name;
  std::ifstream stream(name, std::ios::binary);
  if (!stream)
  {
    file.Unreadable = std::string("it cannot be opened (") + std::strerror(errno) + ")";
    return file;
  }
  if (stream.peek() == std::ifstream::traits_type::eof())
  {
    file.Unreadable = "it is empty";
    return file;
  }
  file.Data = ReadDicomDataSet(stream);
  if (file.Data.IsDeflated)
  {
    const std::uint64_t offset = file.Data.DeflatedOffset;
    file.Data = ReadDicomDataSet(*OpenUnpacked(name, offset), true);
    file.Data.IsDeflated = true;
    file.Data.DeflatedOffset = offset;
  }
  return file;
}

/// Links whose file is gone are listed, too.
std::vector<std::string> FilesIn(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
  {
    std::error_code ignored;
    const bool isHidden = entry.path().filename().string().front() == '.';
    if (!isHidden && (entry.is_regular_file(ignored) || !entry.exists(ignored)))
    {
      files.push_back(entry.path().string());
    }
  }
  if (failure)
  {
    throw FileProblem(FileProblem::Kind::Missing,
      "The folder '" + folder + "' cannot be searched: " + failure.message() +
        ". Check its permissions.");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The stored bytes of frames. A compressed file is decoded once for all of its frames.
class FrameReader
{
public:
  explicit FrameReader(const DicomFolder& folder)
    : Folder(folder)
  {
  }

  std::string Read(const DicomFrame& frame)
  {
    const DicomFile& file = this->Folder.Files[frame.File];
    if (!this->Stream || this->Current != frame.File)
    {
      this->Stream = OpenUnpacked(file.Name, file.Data.IsDeflated ? file.Data.DeflatedOffset : 0);
      this->Current = frame.File;
      this->Decoded.clear();
    }
    const std::size_t size = frame.Format.BytesPerFrame();
    std::string stored;
    if (IsReadDirectly(file.Data))
    {
      stored = ReadStoredFrame(*this->Stream, file.Data, frame.Number);
    }
    else
    {
      if (this->Decoded.empty())
      {
        this->Decoded = DecodeDicomPixels(MinimalDicomFile(*this->Stream, file.Data));
      }
      if (this->Decoded.size() == size * NumberOfDicomFrames(file.Data))
      {
        stored = this->Decoded.substr(size * frame.Number, size);
      }
    }
    if (stored.size() != size)
    {
      throw FileProblem(FileProblem::Kind::Incomplete,
        "The pixels of '" + file.Name + "' cannot be read: the file is truncated or damaged, or has " +
          "changed since its header was read. Download or copy it again.");
    }
    return stored;
  }

private:
  const DicomFolder& Folder;
  std::unique_ptr<std::istream> Stream;
  std::size_t Current = 0;
  std::string Decoded;
};

} // namespace

bool HasDicomMark(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  char mark[4] = {};
  file.seekg(128).read(mark, sizeof(mark));
  return file && std::equal(mark, mark + 4, "DICM");
}

DicomFolder ReadDicomFolder(const std::string& name, const Monitor& monitor)
{
  const std::vector<std::string> names = FilesIn(name);
  std::vector<DicomFile> files;
  for (std::size_t index = 0; index < names.size(); ++index)
  {
    if (!monitor(static_cast<double>(index) / static_cast<double>(names.size())))
    {
      return {};
    }
    files.push_back(ReadFile(names[index]));
  }
  return FindDicomVolumes(name, std::move(files),
    [](const DicomFile& file, std::size_t frame)
    {
      const auto stream =
        OpenUnpacked(file.Name, file.Data.IsDeflated ? file.Data.DeflatedOffset : 0);
      return ReadCodedFrame(*stream, file.Data, frame);
    });
}

void ReadDicomVoxels(const DicomFolder& folder, const DicomVolume& volume, void* voxels,
  const Monitor& monitor)
{
  FrameReader reader(folder);
  const std::size_t count = volume.Frames.size();
  for (std::size_t index = 0; index < count; ++index)
  {
    if (!monitor(static_cast<double>(index) / static_cast<double>(count)))
    {
      return;
    }
    const DicomFrame& frame = volume.Frames[index];
    const std::string stored = reader.Read(frame);
    ToVoxels(stored.data(), frame.Format, frame.Rescale, volume.Type,
      static_cast<char*>(voxels) + index * frame.Format.NumberOfPixels() * SizeOf(volume.Type));
  }
}

} // namespace FlipFree

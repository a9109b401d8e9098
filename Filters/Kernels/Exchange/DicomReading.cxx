#include "Exchange/DicomReading.h"

#include "Exchange/FileNames.h"
#include "Exchange/FileProblem.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <sstream>

namespace FlipFree
{
namespace
{

/// A file that grows beyond this is none of a scanner, but meant to fill the memory.
constexpr std::size_t MostInflatedBytes = std::size_t(1) << 30;

/// A file as it is parsed: inflated, if it is deflated.
std::unique_ptr<std::istream> OpenInflated(const DicomAccess& access, const std::string& name,
  std::uint64_t deflatedOffset)
{
  std::unique_ptr<std::istream> file = access.Open(name);
  if (deflatedOffset == 0)
  {
    return file;
  }
  const std::string bytes{ std::istreambuf_iterator<char>(*file), {} };
  const std::size_t begin = std::min<std::size_t>(deflatedOffset, bytes.size());
  return std::make_unique<std::istringstream>(
    bytes.substr(0, begin) + access.Inflate(bytes.substr(begin), MostInflatedBytes));
}

std::unique_ptr<std::istream> OpenInflated(const DicomAccess& access, const DicomFile& file)
{
  return OpenInflated(access, file.Name, file.Data.IsDeflated ? file.Data.DeflatedOffset : 0);
}

DicomFile ReadDicomFile(const std::string& name, const DicomAccess& access)
{
  DicomFile file;
  file.Name = name;
  errno = 0;
  const std::unique_ptr<std::istream> stream = access.Open(name);
  if (!*stream)
  {
    file.Unreadable = std::string("it cannot be opened (") +
      (errno ? std::strerror(errno) : "unknown reason") + ")";
    return file;
  }
  if (stream->peek() == std::istream::traits_type::eof())
  {
    file.Unreadable = "it is empty";
    return file;
  }
  file.Data = ReadDicomDataSet(*stream);
  if (file.Data.IsDeflated)
  {
    const std::uint64_t offset = file.Data.DeflatedOffset;
    try
    {
      file.Data = ReadDicomDataSet(*OpenInflated(access, name, offset), true);
    }
    catch (const std::bad_alloc&)
    {
      file.Unreadable = "there is not enough memory to inflate it";
      return file;
    }
    file.Data.IsDeflated = true;
    file.Data.DeflatedOffset = offset;
  }
  return file;
}

void RequireStoredBits(const std::string& name, const std::string& stored,
  const DicomPixelFormat& format)
{
  if (!HasOnlyStoredBits(stored, format))
  {
    throw FileProblem(FileProblem::Kind::Unusable,
      "The compressed pixels of '" + name + "' have more bits than the " +
        std::to_string(format.BitsStored) +
        " of its BitsStored, so its gray values are unknown. Export the series again.");
  }
}

/// Where HighBit is wrong, nobody knows which bits are the pixels'.
void RequirePlaceOfBits(const std::string& name, const std::string& stored,
  const DicomPixelFormat& format)
{
  if (HasBitsBelowStoredOnes(stored, format))
  {
    const std::string count = std::to_string(format.BitsStored);
    throw FileProblem(FileProblem::Kind::Unusable,
      "The pixels of '" + name + "' do not lie where its header says: its HighBit is " +
        std::to_string(format.HighBit) + ", not BitsStored - 1 (" +
        std::to_string(format.BitsStored - 1) + "), but pixels have bits below the uppermost " +
        count + ". So its gray values are unknown. Export the series again.");
  }
}

/// The files that the iterator finds, but for hidden ones.
template <typename Iterator>
void AddFiles(const std::string& folder, std::vector<std::string>& files)
{
  std::error_code failure;
  // A range-based loop would throw where the disk fails between two files.
  for (Iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
  {
    std::error_code ignored;
    const bool isHidden = entry->path().filename().string().front() == '.';
    if (!isHidden && (entry->is_regular_file(ignored) || !entry->exists(ignored)))
    {
      files.push_back(entry->path().string());
    }
  }
  if (failure)
  {
    throw FileProblem(FileProblem::Kind::Missing,
      "The folder '" + folder + "' cannot be searched: " + failure.message() +
        ". Check its permissions.");
  }
}

/// The stored bytes of frames. A compressed file is decoded once for all of its frames.
class DicomFrameReader
{
public:
  DicomFrameReader(const DicomFolder& folder, const DicomAccess& access)
    : Folder(folder)
    , Access(access)
  {
  }

  std::string Read(const DicomFrame& frame)
  {
    const DicomFile& file = this->Folder.Files[frame.File];
    if (!this->Stream || this->Current != frame.File)
    {
      this->Stream = OpenInflated(this->Access, file);
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
        const std::string minimal = MinimalDicomFile(*this->Stream, file.Data);
        this->Decoded = minimal.empty() ? minimal : this->Access.Decode(minimal);
      }
      if (this->Decoded.size() == size * NumberOfDicomFrames(file.Data))
      {
        stored = this->Decoded.substr(size * frame.Number, size);
        RequireStoredBits(file.Name, stored, frame.Format);
      }
    }
    if (stored.size() != size)
    {
      throw FileProblem(FileProblem::Kind::Incomplete,
        "The pixels of '" + file.Name +
          "' cannot be read: the file is truncated or damaged, its compressed pixels contradict " +
          "its header, or it has changed since its header was read. Download or copy it again.");
    }
    RequirePlaceOfBits(file.Name, stored, frame.Format);
    return stored;
  }

private:
  const DicomFolder& Folder;
  const DicomAccess& Access;
  std::unique_ptr<std::istream> Stream;
  std::size_t Current = 0;
  std::string Decoded;
};

} // namespace

std::unique_ptr<std::istream> OpenDicomFile(const std::string& name)
{
  return std::make_unique<std::ifstream>(name, std::ios::binary);
}

std::vector<std::string> FilesInFolder(const std::string& folder)
{
  std::vector<std::string> files;
  AddFiles<std::filesystem::directory_iterator>(folder, files);
  if (std::any_of(files.begin(), files.end(), IsDicomDirectory))
  {
    files.clear();
    AddFiles<std::filesystem::recursive_directory_iterator>(folder, files);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> DicomFilesOf(const std::string& path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
  {
    return FilesInFolder(path);
  }
  if (!std::filesystem::is_regular_file(path, ignored))
  {
    return {};
  }
  std::ifstream file(path, std::ios::binary);
  constexpr std::size_t preamble = 128;
  std::string start(preamble + 4, '\0');
  file.read(&start[0], static_cast<std::streamsize>(start.size()));
  const bool isDicom = file && start.compare(preamble, 4, "DICM") == 0;
  return isDicom && NumberOfDicomFrames(ReadDicomDataSet(file)) > 1
    ? std::vector<std::string>{ path }
    : std::vector<std::string>();
}

DicomFolder ReadDicomFolder(const std::string& name, const std::vector<std::string>& files,
  const DicomAccess& access, const Monitor& monitor)
{
  std::vector<DicomFile> read;
  for (std::size_t index = 0; index < files.size(); ++index)
  {
    if (!monitor(static_cast<double>(index) / static_cast<double>(files.size())))
    {
      return {};
    }
    read.push_back(ReadDicomFile(files[index], access));
  }
  bool isStopped = false;
  DicomFolder folder = FindDicomVolumes(name, std::move(read),
    [&](const DicomFile& file, std::size_t frame)
    {
      isStopped = isStopped || !monitor(1);
      return isStopped ? std::string()
                       : ReadCodedFrame(*OpenInflated(access, file), file.Data, frame);
    });
  return isStopped ? DicomFolder() : std::move(folder);
}

bool NeedsDecoder(const DicomFolder& folder, const DicomVolume& volume)
{
  return std::any_of(volume.Frames.begin(), volume.Frames.end(),
    [&folder](const DicomFrame& frame) { return !IsReadDirectly(folder.Files[frame.File].Data); });
}

void ReadDicomVoxels(const DicomFolder& folder, const DicomVolume& volume,
  const DicomAccess& access, void* voxels, const Monitor& monitor)
{
  DicomFrameReader reader(folder, access);
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

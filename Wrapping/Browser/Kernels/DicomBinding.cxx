// Folders of DICOM files: what they hold, and the voxels of a volume.
#include "Bindings.h"
#include "VoxelArrays.h"

#include "Exchange/DicomChoice.h"
#include "Exchange/DicomReading.h"

#include <emscripten/bind.h>

#include <algorithm>
#include <array>
#include <istream>
#include <map>
#include <memory>
#include <streambuf>
#include <string>
#include <vector>

namespace FlipFree
{
namespace
{

/// The bytes of an Uint8Array, of which a part at a time is copied.
class ArrayBuffer : public std::streambuf
{
public:
  explicit ArrayBuffer(val bytes)
    : Bytes(std::move(bytes))
    , Size(static_cast<off_type>(this->Bytes["length"].as<double>()))
  {
  }

protected:
  int_type underflow() override
  {
    const off_type count = std::min<off_type>(this->Part.size(), this->Size - this->Place);
    if (count <= 0)
    {
      return traits_type::eof();
    }
    const val part = this->Bytes.call<val>("subarray", static_cast<double>(this->Place),
      static_cast<double>(this->Place + count));
    val(emscripten::typed_memory_view(this->Part.size(), this->Part.data()))
      .call<void>("set", part);
    char* const begin = reinterpret_cast<char*>(this->Part.data());
    this->setg(begin, begin, begin + count);
    this->Place += count;
    return traits_type::to_int_type(*begin);
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override
  {
    const off_type now = this->Place - (this->egptr() - this->gptr());
    const off_type base =
      from == std::ios_base::beg ? 0 : (from == std::ios_base::cur ? now : this->Size);
    return this->seekpos(base + offset, std::ios_base::in);
  }

  pos_type seekpos(pos_type place, std::ios_base::openmode) override
  {
    if (off_type(place) < 0 || off_type(place) > this->Size)
    {
      return pos_type(off_type(-1));
    }
    this->Place = place;
    this->setg(nullptr, nullptr, nullptr);
    return place;
  }

private:
  val Bytes;
  off_type Size;
  off_type Place = 0; // of what follows the part
  std::array<unsigned char, 1 << 16> Part = {};
};

class ArrayStream : public std::istream
{
public:
  explicit ArrayStream(val bytes)
    : std::istream(nullptr)
    , Buffer(std::move(bytes))
  {
    this->rdbuf(&this->Buffer);
  }

private:
  ArrayBuffer Buffer;
};

/// A function of JavaScript from bytes, and what numbers it takes, to bytes.
template <typename... Numbers>
std::function<std::string(const std::string&, Numbers...)> ByJavaScript(const val& function)
{
  return [function](const std::string& bytes, Numbers... numbers)
  {
    const val view(emscripten::typed_memory_view(bytes.size(),
      reinterpret_cast<const unsigned char*>(bytes.data())));
    const auto answer = emscripten::convertJSArrayToNumberVector<unsigned char>(
      function(view.call<val>("slice"), static_cast<double>(numbers)...));
    return std::string(answer.begin(), answer.end());
  };
}

/// Files are { name, bytes }. `names` gets a name for each: files of several folders may have the
/// same one, and then a number stands before it, as if it were their folder's.
DicomAccess AccessTo(const val& files, const val& inflate, const val& decode,
  std::vector<std::string>& names)
{
  auto contents = std::make_shared<std::map<std::string, val>>();
  for (const val& file : emscripten::vecFromJSArray<val>(files))
  {
    const auto given = file["name"].as<std::string>();
    std::string name = given;
    for (int number = 2; !contents->emplace(name, file["bytes"]).second; ++number)
    {
      name = std::to_string(number) + "/" + given;
    }
    names.push_back(name);
  }
  const auto open = [contents](const std::string& name) -> std::unique_ptr<std::istream>
  { return std::make_unique<ArrayStream>(contents->at(name)); };
  return { open, ByJavaScript<std::size_t>(inflate), ByJavaScript<>(decode) };
}

/// A folder that has been read.
class ReadFolder
{
public:
  ReadFolder(DicomAccess access, DicomFolder folder)
    : Access(std::move(access))
    , Folder(std::move(folder))
  {
  }

  val List() const
  {
    return Guarded(
      [this]
      {
        RequireDicomVolumes(this->Folder);
        val list = val::array();
        for (const DicomVolume& volume : this->Folder.Volumes)
        {
          val row = val::object();
          row.set("uid", volume.Identifier());
          row.set("number", volume.SeriesNumber);
          row.set("description", volume.Description);
          row.set("modality", volume.Modality);
          row.set("slices", static_cast<double>(volume.Frames.size()));
          row.set("spacing",
            volume.Problem.empty() ? ArrayOf(volume.Geometry.Spacing) : val::null());
          row.set("problem", volume.Problem);
          list.call<void>("push", row);
        }
        val answer = val::object();
        answer.set("list", list);
        return answer;
      });
  }

  val Choose(const std::string& wanted) const
  {
    return Guarded(
      [&]
      {
        val answer = val::object();
        answer.set("needsDecoder",
          NeedsDecoder(this->Folder, ChooseDicomVolume(this->Folder, wanted)));
        return answer;
      });
  }

  val Read(const std::string& wanted, const val& report) const
  {
    return Guarded(
      [&]
      {
        const DicomVolume& volume = ChooseDicomVolume(this->Folder, wanted);
        val answer = val::object();
        SetGrid(answer, volume.Geometry);
        answer.set("voxels",
          FilledArray(volume.Type, volume.Geometry.NumberOfVoxels(),
            [&](void* voxels) {
              ReadDicomVoxels(this->Folder, volume, this->Access, voxels,
                MonitorOf(report, 0.5, 1));
            }));
        answer.set("series", volume.Identifier());
        val warnings = val::array();
        for (const std::string& warning :
          { volume.Warning, WarningOfLeftOut(this->Folder, volume) })
        {
          if (!warning.empty())
          {
            warnings.call<void>("push", warning);
          }
        }
        answer.set("warnings", warnings);
        return answer;
      });
  }

private:
  DicomAccess Access;
  DicomFolder Folder;
};

// { folder: DicomFolder } of { name, bytes } of files.
val OpenFolder(const std::string& name, const val& files, const val& inflate, const val& decode,
  const val& report)
{
  return Guarded(
    [&]
    {
      std::vector<std::string> names;
      DicomAccess access = AccessTo(files, inflate, decode, names);
      DicomFolder folder = ReadDicomFolder(name, names, access, MonitorOf(report, 0, 0.5));
      val answer = val::object();
      answer.set("folder", std::make_shared<ReadFolder>(std::move(access), std::move(folder)));
      return answer;
    });
}

} // namespace

void BindDicom()
{
  emscripten::class_<ReadFolder>("DicomFolder")
    .smart_ptr<std::shared_ptr<ReadFolder>>("DicomFolder")
    .function("list", &ReadFolder::List)
    .function("choose", &ReadFolder::Choose)
    .function("read", &ReadFolder::Read);
  emscripten::function("openDicom", &OpenFolder);
}

} // namespace FlipFree

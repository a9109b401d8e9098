#include "NiftiHeader.h"

#include "HeaderField.h"
#include "VolumeHeader.h"

#include "vtkErrorCode.h"

#include "itk_zlib.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

namespace FlipFree
{
namespace
{

/// The layout of nifti1.h, in the byte order of the machine or in the other.
class Header
{
public:
  static constexpr int Size = 348;

  /// Reads a packed file or a plain one.
  explicit Header(const std::string& name)
  {
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(name.c_str(), "rb"), gzclose);
    this->Found = file ? std::max(0, gzread(file.get(), this->Bytes.data(), Size)) : 0;
  }

  bool IsVersion(std::int32_t size)
  {
    for (const bool swap : { false, true })
    {
      this->Swap = swap;
      if (this->Found >= 4 && this->Field<std::int32_t>(0) == size)
      {
        return true;
      }
    }
    return false;
  }
  bool IsWhole() const { return this->Found == Size; }
  bool IsAnalyze() const { return this->Magic() != "n+1" && this->Magic() != "ni1"; }
  bool IsPair() const { return this->Magic() != "n+1"; }

  template <typename T>
  T Field(int offset) const
  {
    unsigned char bytes[sizeof(T)];
    std::copy_n(this->Bytes.data() + offset, sizeof(T), bytes);
    if (this->Swap)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

private:
  std::string Magic() const
  {
    return { reinterpret_cast<const char*>(this->Bytes.data()) + 344, 3 };
  }

  std::array<unsigned char, Size> Bytes = {};
  int Found = 0;
  bool Swap = false;
};

constexpr std::int32_t SizeOfNifti2 = 540;

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

/// The header of a pair may be given by the name of its voxels.
std::string HeaderFileOf(const std::string& name)
{
  std::filesystem::path path(name);
  const bool packed = path.extension() == ".gz";
  if (packed)
  {
    path.replace_extension();
  }
  if (path.extension() != ".img")
  {
    return name;
  }
  path.replace_extension(".hdr");
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path.string() : path.string() + ".gz";
}

std::string Numbered(const char* field, int index)
{
  return field + ("[" + std::to_string(index) + "]");
}

double RequireSize(const std::string& name, const Header& header)
{
  const int dimension = header.Field<std::int16_t>(40);
  if (dimension < 1 || dimension > 7)
  {
    RefuseField(name, "dim[0]",
      "is " + std::to_string(dimension) + ", not a dimension from 1 to 7");
  }
  double voxels = 1;
  for (int axis = 1; axis <= dimension; ++axis)
  {
    const int size = header.Field<std::int16_t>(40 + 2 * axis);
    if (size < 0 || (size == 0 && axis <= 3))
    {
      RefuseField(name, Numbered("dim", axis),
        "is " + std::to_string(size) + ", but must be positive");
    }
    voxels *= std::max(1, size); // a trailing axis of length zero is an axis of length one
    if (axis <= 3)
    {
      const std::string field = Numbered("pixdim", axis);
      const float spacing = header.Field<float>(76 + 4 * axis);
      RequireSpacing(name, field, spacing);
      // Readers disagree whether a negative spacing mirrors the image; left and right are at stake.
      if (spacing < 0)
      {
        RefuseField(name, field, "is negative, but a spacing must be positive");
      }
    }
    else
    {
      RequireLength(name, Numbered("pixdim", axis), header.Field<float>(76 + 4 * axis));
    }
  }
  return voxels;
}

double RequireDatatype(const std::string& name, const Header& header)
{
  static const std::map<int, double> bytes{ { 2, 1 }, { 4, 2 }, { 8, 4 }, { 16, 4 }, { 32, 8 },
    { 64, 8 }, { 128, 3 }, { 256, 1 }, { 512, 2 }, { 768, 4 }, { 1024, 8 }, { 1280, 8 },
    { 1536, 16 }, { 1792, 16 }, { 2048, 32 }, { 2304, 4 } };
  const int datatype = header.Field<std::int16_t>(70);
  const auto found = bytes.find(datatype);
  if (found == bytes.end())
  {
    RefuseField(name, "datatype",
      "is " + std::to_string(datatype) + ", which stands for no type of whole bytes");
  }
  return found->second;
}

void RequireOrientation(const std::string& name, const Header& header)
{
  if (header.Field<std::int16_t>(252) > 0)
  {
    const float sign = header.Field<float>(76);
    if (!std::isfinite(sign))
    {
      RefuseField(name, "pixdim[0]", "is not a finite number, where 1 or -1 is expected");
    }
    const char* const fields[] = { "quatern_b", "quatern_c", "quatern_d", "qoffset_x", "qoffset_y",
      "qoffset_z" };
    for (int index = 0; index < 6; ++index)
    {
      RequireLength(name, fields[index], header.Field<float>(256 + 4 * index));
    }
  }
  if (header.Field<std::int16_t>(254) > 0)
  {
    const char* const rows[] = { "srow_x", "srow_y", "srow_z" };
    for (int entry = 0; entry < 12; ++entry)
    {
      RequireLength(name, Numbered(rows[entry / 4], entry % 4),
        header.Field<float>(280 + 4 * entry));
    }
    for (int row = 0; row < 3; ++row)
    {
      const auto entry = [&](int axis) { return header.Field<float>(280 + 16 * row + 4 * axis); };
      // Readers silently fall back to another orientation.
      if (entry(0) == 0 && entry(1) == 0 && entry(2) == 0)
      {
        RefuseField(name, rows[row],
          "holds zeros where it should say which way the voxels' axes run");
      }
    }
  }
}

double RequireOffset(const std::string& name, const Header& header)
{
  const double offset = header.Field<float>(108);
  if (!(offset >= 0) || offset > INT_MAX)
  {
    RefuseField(name, "vox_offset", "is not a place in the file");
  }
  return header.IsPair() ? offset : std::max<double>(352, offset);
}

} // namespace

bool IsNifti(const std::string& name)
{
  Header header(HeaderFileOf(name));
  return header.IsVersion(Header::Size) || header.IsVersion(SizeOfNifti2);
}

VoxelStorage StorageOfNifti(const std::string& name)
{
  Header header(HeaderFileOf(name));
  if (header.IsVersion(SizeOfNifti2))
  {
    throw ImageFileError(vtkErrorCode::UnrecognizedFileTypeError,
      "'" + name + "' is a NIfTI-2 file, and only NIfTI-1 files are read. Convert it to NIfTI-1, " +
        "NRRD or MetaImage.");
  }
  header.IsVersion(Header::Size); // sets the byte order
  if (!header.IsWhole())
  {
    RefuseField(name, "it", "ends after fewer than 348 bytes");
  }
  VoxelStorage storage;
  const double bytes = RequireSize(name, header) * RequireDatatype(name, header);
  if (!header.IsAnalyze())
  {
    RequireOrientation(name, header);
  }
  const double offset = RequireOffset(name, header);
  const std::string voxels = header.IsPair() ? VoxelFileOfPair(name) : name;
  storage.Files = { voxels };
  std::ifstream file(voxels, std::ios::binary);
  const bool packed = file.get() == 0x1F && file.get() == 0x8B; // the mark of gzip
  // A packed file is packed from its first byte on.
  storage.Encoding = packed ? VoxelStorage::Form::Deflated : VoxelStorage::Form::Plain;
  storage.Offset = packed ? 0 : static_cast<std::uint64_t>(offset);
  storage.NumberOfBytes = bytes + (packed ? offset : 0);
  return storage;
}

} // namespace FlipFree

/**
 * What the header of a NIfTI, NRRD or MetaImage file says: the one place where the headers of these
 * formats are understood. A front end passes the first bytes of a file; it learns where the voxels
 * are and how they are coded, reads or inflates them with the library at hand, and decodes them
 * with VoxelDecoding.
 *
 * No number is invented. What a file does not say is an error, or a warning that says what was
 * taken instead; what contradicts itself is a warning that says what was taken.
 */
#ifndef FlipFreeVolumeFileHeader_h
#define FlipFreeVolumeFileHeader_h

#include "KernelTypes.h"

#include "Exchange/FileProblem.h"
#include "Exchange/VoxelType.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace FlipFree
{

/// Where the voxels are.
struct VoxelStorage
{
  enum class Coding
  {
    Raw,
    Deflated, ///< by gzip or zlib, from the offset on
    Text,     ///< numbers between white space
    Hex       ///< two digits a byte
  };

  /// One after the other, each with an equal part; paths as the header gives them, relative to its
  /// own folder. The header's own file is an empty name.
  std::vector<std::string> Files{ std::string() };
  std::uint64_t Offset = 0;  ///< of the first byte in each file, as it is stored
  std::uint64_t Lines = 0;   ///< to skip there first, as they are stored
  std::uint64_t Skipped = 0; ///< bytes before the voxels, once they are inflated
  bool IsAtEnd = false;      ///< the voxels are the last bytes of the file, wherever they begin
  Coding Form = Coding::Raw;
  bool MayBePacked = false; ///< by gzip as a whole, which its own first bytes tell
  VoxelType Type = VoxelType::Int16;
  bool IsBigEndian = false;
};

/// Of the segmentations of 3D Slicer, whose segments may overlap: as many label maps in one file.
struct VoxelLayers
{
  int Count = 1;
  bool AreInterleaved = false; ///< the layers of a voxel follow each other; else layers are volumes
};

/// For front ends.
inline const char* NameOf(VoxelStorage::Coding form)
{
  constexpr const char* names[] = { "raw", "deflated", "text", "hex" };
  return names[static_cast<int>(form)];
}

struct VolumeFileHeader
{
  std::string Name; ///< of the file, for messages
  ImageGeometry Geometry;
  VoxelStorage Storage;
  VoxelLayers Layers;
  double Slope = 1; ///< a value is Slope times what is stored, plus Intercept
  double Intercept = 0;
  std::vector<std::string> Warnings;        ///< whole sentences that name the file
  std::map<std::string, std::string> Pairs; ///< the user's own fields in NRRD, in UTF-8
  std::map<int, std::string> LabelNames;    ///< by a label table in NIfTI

  bool IsScaled() const { return this->Slope != 1 || this->Intercept != 0; }
  /// Of the values: that of the stored voxels, or of numbers with fractions where they are scaled.
  VoxelType ValueType() const;
  std::size_t NumberOfStoredVoxels() const
  {
    return this->Geometry.NumberOfVoxels() * static_cast<std::size_t>(this->Layers.Count);
  }
  /// Of all files together, inflated.
  std::uint64_t NumberOfStoredBytes() const
  {
    return std::uint64_t(this->NumberOfStoredVoxels()) * SizeOf(this->Storage.Type);
  }
};

/// So many first bytes of a file are enough, inflated where it begins with the mark of gzip.
constexpr std::size_t BytesOfHeader = 1 << 20;

/// The file whose header describes `name`: of a pair, `.hdr` for `.img`. The second one is tried
/// where there is no first.
std::vector<std::string> HeaderFilesOf(const std::string& name);

/// Reads the header of a file called `name`, recognized by its first bytes `start`. A FileProblem
/// names the field that cannot be as it is.
VolumeFileHeader ReadVolumeFileHeader(const std::string& name, const std::string& start);

/// The mark of gzip, with which a packed file begins.
constexpr char PackedMark[] = "\x1F\x8B";

/// Of a file that may be packed, and is: the offset counts bytes of what is inflated.
void TakePacked(VoxelStorage& storage);

/// What a front end finds where a file of voxels should be, instead of its size.
constexpr double MissingFile = -1;
constexpr double IrregularFile = -2;

/// Before memory is allocated: throws a FileProblem where files are missing or too small for the
/// voxels. The storage names them as the front end opens them, and `sizes` has the bytes of each.
void RequireFiles(const VolumeFileHeader& header, const std::vector<double>& sizes);

/// Why the voxels of a file are not whole.
enum class Incompleteness
{
  BrokenStream,
  TooFewVoxels
};
FileProblem IncompleteVoxels(const std::string& name, Incompleteness reason);

/// Whatever the case of the letters; the ending is given in small ones.
bool HasEnding(const std::string& name, const std::string& ending);

} // namespace FlipFree

#endif

/**
 * Reads a folder of DICOM files: what they say, and the voxels of a volume. What needs a library,
 * such as to inflate and to decode, is given from outside.
 */
#ifndef FlipFreeDicomReading_h
#define FlipFreeDicomReading_h

#include "Exchange/DicomVolumes.h"

#include "KernelTypes.h"

#include <cstddef>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <vector>

namespace FlipFree
{

struct DicomAccess
{
  /// Opens a file by its name; in a state of failure, or empty, if it cannot be read.
  std::function<std::unique_ptr<std::istream>(const std::string& name)> Open;
  /// Inflates bytes without a header of their own (RFC 1951), as far as they are sound, and up to
  /// about `most` bytes.
  std::function<std::string(const std::string& packed, std::size_t most)> Inflate;
  /// The stored bytes, little-endian, of all frames of a MinimalDicomFile(); empty where they
  /// cannot be decoded.
  std::function<std::string(const std::string& file)> Decode;
};

/// Opens a file of the disk.
std::unique_ptr<std::istream> OpenDicomFile(const std::string& name);

/// The files of a folder of the disk, but for hidden ones. Those in the folders within it are among
/// them only beside a DICOMDIR, as on a CD; links whose file is gone always. A FileProblem where
/// the folder cannot be searched.
std::vector<std::string> FilesInFolder(const std::string& folder);

/// The DICOM files that may hold the volume of this path: those of a folder, or a file of several
/// frames itself. None for any other file: a single slice is no volume.
std::vector<std::string> DicomFilesOf(const std::string& path);

/// What the files of a folder say. An empty answer if the monitor says stop.
DicomFolder ReadDicomFolder(const std::string& name, const std::vector<std::string>& files,
  const DicomAccess& access, const Monitor& monitor);

/// Whether pixels of the volume are compressed in a way that DicomAccess::Decode is needed for.
bool NeedsDecoder(const DicomFolder& folder, const DicomVolume& volume);

/// Reads the voxels of all slices, one after the other, as VoxelType `volume.Type`. Where the
/// monitor says stop, the rest is left as it was. A FileProblem where pixels are damaged.
void ReadDicomVoxels(const DicomFolder& folder, const DicomVolume& volume,
  const DicomAccess& access, void* voxels, const Monitor& monitor);

} // namespace FlipFree

#endif

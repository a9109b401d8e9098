/**
 * Private to the module: volumes that are a folder of DICOM files. What the files say is understood
 * by the kernels (Exchange/DicomVolumes.h); here they are listed, opened and decoded.
 */
#ifndef FlipFreeDicomFolder_h
#define FlipFreeDicomFolder_h

#include "Exchange/DicomVolumes.h"

#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

/// Whether the file says that it is DICOM, by the mark behind its preamble.
bool HasDicomMark(const std::string& name);

/// What the files of a folder say (not those in the folders within it); hidden ones are passed over.
/// An empty answer if the monitor says stop; a FileProblem where the folder cannot be searched.
DicomFolder ReadDicomFolder(const std::string& name, const Monitor& monitor);

/// Reads the voxels of all slices, one after the other, as VoxelType `volume.Type`. Where the monitor
/// says stop, the rest is left as it was. A FileProblem where pixels are damaged.
void ReadDicomVoxels(const DicomFolder& folder, const DicomVolume& volume, void* voxels,
  const Monitor& monitor);

} // namespace FlipFree

#endif

/**
 * Private to the module: volumes that are one file in a NIfTI, NRRD or MetaImage format.
 */
#ifndef FlipFreeVolumeFile_h
#define FlipFreeVolumeFile_h

#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

namespace FlipFree
{

/// Whatever the case of the letters; the ending is given in small ones.
bool EndsWith(const std::string& name, const std::string& ending);

/// ITK's reader for the file, its header read; an ImageFileError if there is none.
itk::ImageIOBase::Pointer OpenVolumeFile(const std::string& name);

/// Reads the voxels of a file that has just been opened into `scalars`, which have their size. ITK
/// reads a file in one go and cannot be stopped, so it does so in a thread of its own; where the
/// monitor says stop, that thread is left to end alone, and `scalars` stay its own until then.
void ReadVolumeFile(const itk::ImageIOBase::Pointer& io, const std::string& name,
  const vtkSmartPointer<vtkDataArray>& scalars, const Monitor& monitor);

} // namespace FlipFree

#endif

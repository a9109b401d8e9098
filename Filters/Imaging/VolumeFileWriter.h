/**
 * Private to the module: writes a volume into one file, wholly or not at all.
 */
#ifndef FlipFreeVolumeFileWriter_h
#define FlipFreeVolumeFileWriter_h

#include "SegmentFields.h"
#include "VolumeHeader.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

namespace FlipFree
{

/// Writes the volume, and the fields where there are any (of NRRD), in the format of the name's
/// ending: into a folder beside the destination, where it is read back and compared, and from there
/// by renaming. An ImageFileError where that fails, false where the monitor says stop; nothing is
/// left behind then.
bool WriteVolumeFile(const std::string& name, const VolumeHeader& header,
  const vtkSmartPointer<vtkDataArray>& scalars, const FileFields& fields, bool compress,
  const Monitor& monitor);

} // namespace FlipFree

#endif

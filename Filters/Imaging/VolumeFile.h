/**
 * Private to the module: volumes that are one file in a NIfTI, NRRD or MetaImage format.
 */
#ifndef FlipFreeVolumeFile_h
#define FlipFreeVolumeFile_h

#include "KernelTypes.h"

#include "Exchange/VolumeFileHeader.h"

#include <string>

namespace FlipFree
{

/// The header of a file, whose storage names files that are there and large enough. A FileProblem
/// if there are none, or if it is of none of these formats.
VolumeFileHeader OpenVolumeFile(const std::string& name);

/// Reads one layer of a file that has just been opened; `values` have room for it. A FileProblem
/// where they are damaged or too few. Where the monitor says stop, the rest is left as it was.
void ReadVolumeFile(const VolumeFileHeader& header, int layer, void* values,
  const Monitor& monitor);

} // namespace FlipFree

#endif

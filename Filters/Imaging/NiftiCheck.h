/**
 * Private to the module: is a NIfTI file all there? ITK 5.2 does not notice when it is not: its
 * copy of the NIfTI library reports the short read, but compares it as an unsigned number.
 */
#ifndef FlipFreeNiftiCheck_h
#define FlipFreeNiftiCheck_h

#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

/// Throws an ImageFileError if the file holds fewer voxels than its header says, or if its gzip
/// stream is broken or fails its checksum. Returns early where the monitor says stop.
void RequireCompleteNifti(const std::string& name, const Monitor& monitor);

} // namespace FlipFree

#endif

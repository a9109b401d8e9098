/**
 * Private to the module: checks that a compressed file is complete. ITK 5.2 does not notice when it
 * is not. Its NIfTI library compares the result of a short read as an unsigned number and its
 * MetaImage library prints a line and goes on, so that the missing voxels stay undefined; its NRRD
 * library does not look at the checksum. The size of other files is judged with their header.
 */
#ifndef FlipFreeCompletenessCheck_h
#define FlipFreeCompletenessCheck_h

#include "VolumeHeader.h"

namespace FlipFree
{

/// Throws an ImageFileError if the compressed stream of the file is broken, fails its checksum or
/// holds fewer voxels than its header says. Returns early where the monitor says stop.
void RequireComplete(const std::string& name, const Monitor& monitor);

} // namespace FlipFree

#endif

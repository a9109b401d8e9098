/**
 * Private to the module: is a NIfTI or MetaImage file all there? ITK 5.2 does not notice when it is
 * not, and leaves the missing voxels undefined: its NIfTI library compares the result of a short
 * read as an unsigned number, its MetaImage library prints a line and goes on.
 */
#ifndef FlipFreeCompletenessCheck_h
#define FlipFreeCompletenessCheck_h

#include "VolumeHeader.h"

namespace FlipFree
{

/// Throws an ImageFileError if the file that `io` has opened holds fewer voxels than its header
/// says, or if its compressed stream is broken or fails its checksum. Returns early where the
/// monitor says stop. Formats of which ITK notices it are not looked at.
void RequireComplete(itk::ImageIOBase* io, const std::string& name, const Monitor& monitor);

} // namespace FlipFree

#endif

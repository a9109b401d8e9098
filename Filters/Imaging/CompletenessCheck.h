/**
 * Private to the module: is a NIfTI or MetaImage file all there? ITK 5.2 does not notice when it is
 * not, and leaves the missing voxels undefined: its NIfTI library compares the result of a short
 * read as an unsigned number, its MetaImage library prints a line and goes on. The size of a file
 * is judged with its header; whether a compressed one is whole shows only when it is inflated.
 */
#ifndef FlipFreeCompletenessCheck_h
#define FlipFreeCompletenessCheck_h

#include "VolumeHeader.h"

namespace FlipFree
{

/// Throws an ImageFileError if the compressed stream of the file that `io` has opened is broken,
/// fails its checksum or holds fewer voxels than its header says. Returns early where the monitor
/// says stop. Formats of which ITK notices it are not looked at.
void RequireComplete(itk::ImageIOBase* io, const std::string& name, const Monitor& monitor);

} // namespace FlipFree

#endif

/**
 * Private to the module: judges the header of a MetaImage file.
 */
#ifndef FlipFreeMetaImageHeader_h
#define FlipFreeMetaImageHeader_h

#include "VoxelStorage.h"

namespace FlipFree
{

/// By the ending of its name, and a first line that is text.
bool IsMetaImage(const std::string& name);

/// For such a file. Throws an ImageFileError.
VoxelStorage StorageOfMetaImage(const std::string& name);

} // namespace FlipFree

#endif

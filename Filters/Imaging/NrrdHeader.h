/**
 * Private to the module: judges the header of a NRRD file.
 */
#ifndef FlipFreeNrrdHeader_h
#define FlipFreeNrrdHeader_h

#include "VoxelStorage.h"

namespace FlipFree
{

/// By the first line of the file.
bool IsNrrd(const std::string& name);

/// For such a file. Throws an ImageFileError.
VoxelStorage StorageOfNrrd(const std::string& name);

} // namespace FlipFree

#endif

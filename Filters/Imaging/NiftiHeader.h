/**
 * Private to the module: judges the header of a NIfTI file, or of an ANALYZE 7.5 pair, which has
 * the same layout without an orientation.
 */
#ifndef FlipFreeNiftiHeader_h
#define FlipFreeNiftiHeader_h

#include "VoxelStorage.h"

namespace FlipFree
{

/// Whether the file, packed or not, begins with the size of such a header, in any byte order.
bool IsNifti(const std::string& name);

/// For a file that does. Throws an ImageFileError.
VoxelStorage StorageOfNifti(const std::string& name);

} // namespace FlipFree

#endif

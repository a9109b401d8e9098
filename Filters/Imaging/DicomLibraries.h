/**
 * Private to the module: the libraries by which the kernels read DICOM files.
 */
#ifndef FlipFreeDicomLibraries_h
#define FlipFreeDicomLibraries_h

#include "Exchange/DicomReading.h"

namespace FlipFree
{

/// Files of the disk; zlib inflates, and GDCM decodes. GDCM stops the program at much that files
/// may hold, so it gets to see nothing but the minimal files that the kernels make.
DicomAccess DicomByLibraries();

} // namespace FlipFree

#endif

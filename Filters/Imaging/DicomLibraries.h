/**
 * Private to the module: the libraries by which the kernels read DICOM files.
 */
#ifndef FlipFreeDicomLibraries_h
#define FlipFreeDicomLibraries_h

#include "Exchange/DicomReading.h"

#include <string>

namespace FlipFree
{

/// Whether the file says that it is DICOM, by the mark behind its preamble.
bool HasDicomMark(const std::string& name);

/// Files of the disk; zlib inflates, and GDCM decodes. GDCM stops the program at much that files
/// may hold, so it gets to see nothing but the minimal files that the kernels make.
DicomAccess DicomByLibraries();

} // namespace FlipFree

#endif

/**
 * Private to the module: checks that a DICOM file is complete. GDCM's parser does not report some
 * truncated and foreign files but stops the program, so each file is walked through before GDCM
 * sees it.
 */
#ifndef FlipFreeDicomCheck_h
#define FlipFreeDicomCheck_h

#include <string>

namespace FlipFree
{

/// Does the file bear the mark of DICOM, behind a preamble of 128 bytes?
bool HasDicomMark(const std::string& name);

/// Is the file, which bears the mark, an image? Contours, plans, reports, presentation states and
/// directories are not. Throws an ImageFileError where an element runs past the end of the file,
/// or where an image has no, or too few, pixels.
bool IsCompleteDicomImage(const std::string& name);

} // namespace FlipFree

#endif

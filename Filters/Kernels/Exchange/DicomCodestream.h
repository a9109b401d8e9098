/**
 * Checks compressed pixels before a decoder sees them: libraries stop the program, or write beyond
 * their memory, where a stream is of another size than the file that holds it.
 */
#ifndef FlipFreeDicomCodestream_h
#define FlipFreeDicomCodestream_h

#include "Exchange/DicomPixels.h"

#include <string>

namespace FlipFree
{

/// Whether a frame's stream (JPEG and JPEG-LS: ISO/IEC 10918-1 and 14495-1; JPEG 2000: 15444-1) has
/// one component of the format's rows and columns, with no more bits than it has room for, and
/// headers that are well-formed up to the data. Where the stream tells whether pixels are signed
/// (JPEG 2000), it has to say the same as the format.
bool IsCodestreamOf(const std::string& stream, const std::string& transferSyntax,
  const DicomPixelFormat& format);

} // namespace FlipFree

#endif

/**
 * Private to the module: compressed DICOM pixels, decoded by GDCM.
 */
#ifndef FlipFreeDicomDecoder_h
#define FlipFreeDicomDecoder_h

#include <string>

namespace FlipFree
{

/// The stored bytes of all frames, little-endian, of a whole DICOM file that holds nothing but
/// compressed pixels of one sample (MinimalDicomFile()); empty where they cannot be decoded. GDCM
/// stops the program at much that files of others may hold.
std::string DecodeDicomPixels(const std::string& file);

} // namespace FlipFree

#endif

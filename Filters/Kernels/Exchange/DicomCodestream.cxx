#include "Exchange/DicomCodestream.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

/// Reads numbers, the most significant byte first; 0 beyond the end, and then IsGood() is false.
class StreamBytes
{
public:
  explicit StreamBytes(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  std::uint32_t Number(int count)
  {
    std::uint32_t number = 0;
    for (int byte = 0; byte < count; ++byte)
    {
      this->Good = this->Good && this->At < this->Bytes.size();
      number = number << 8 | (this->Good ? static_cast<unsigned char>(this->Bytes[this->At]) : 0);
      ++this->At;
    }
    return this->Good ? number : 0;
  }

  bool IsGood() const { return this->Good; }
  std::size_t Position() const { return this->At; }
  void MoveTo(std::size_t position) { this->At = position; }

private:
  const std::string& Bytes;
  std::size_t At = 0;
  bool Good = true;
};

bool FitsIntoPixels(std::uint32_t bits, const DicomPixelFormat& format)
{
  return bits >= 1 && bits <= static_cast<std::uint32_t>(format.BitsAllocated) &&
    (bits > 8) == (format.BitsAllocated > 8);
}

/// The kind of frame that each transfer syntax may have, by its marker.
bool IsFrameMarker(std::uint32_t marker, const std::string& syntax)
{
  const std::string ending = syntax.substr(syntax.find_last_of('.') + 1);
  const bool isLossless = ending == "57" || ending == "70";
  const bool isLS = ending == "80" || ending == "81";
  return isLS    ? marker == 0xFFF7
    : isLossless ? marker == 0xFFC3
                 : marker == 0xFFC0 || marker == 0xFFC1;
}

/// JPEG and JPEG-LS: segments up to the first scan, one of them the frame.
bool IsJpegOf(const std::string& stream, const std::string& syntax, const DicomPixelFormat& format)
{
  StreamBytes bytes(stream);
  bool hasFrame = false;
  bool hasTable = IsFrameMarker(0xFFF7, syntax); // of Huffman codes, which JPEG-LS has not
  if (bytes.Number(2) != 0xFFD8)
  {
    return false;
  }
  while (bytes.IsGood())
  {
    std::uint32_t marker = bytes.Number(2);
    while (marker == 0xFFFF) // fill bytes
    {
      marker = 0xFF00 | bytes.Number(1);
    }
    const std::size_t start = bytes.Position();
    const std::uint32_t length = bytes.Number(2);
    if (marker < 0xFFC0 || length < 2 || start + length > stream.size())
    {
      return false;
    }
    if (marker == 0xFFDA)
    {
      return hasFrame && hasTable && bytes.Number(1) == 1;
    }
    const bool isFrame = (marker >= 0xFFC0 && marker <= 0xFFCF && marker != 0xFFC4 &&
                           marker != 0xFFC8 && marker != 0xFFCC) ||
      marker == 0xFFF7;
    if (isFrame)
    {
      const std::uint32_t bits = bytes.Number(1);
      const std::uint32_t rows = bytes.Number(2);
      const std::uint32_t columns = bytes.Number(2);
      const std::uint32_t components = bytes.Number(1);
      const bool fits = FitsIntoPixels(bits, format) &&
        rows == static_cast<std::uint32_t>(format.Rows) &&
        columns == static_cast<std::uint32_t>(format.Columns) && components == 1 && length == 11;
      if (hasFrame || !fits || !IsFrameMarker(marker, syntax))
      {
        return false;
      }
      hasFrame = true;
    }
    hasTable = hasTable || marker == 0xFFC4;
    bytes.MoveTo(start + length);
  }
  return false;
}

/// JPEG 2000: the size segment stands first.
bool IsJpeg2000Of(const std::string& stream, const DicomPixelFormat& format)
{
  StreamBytes bytes(stream);
  const bool isMarked = bytes.Number(2) == 0xFF4F && bytes.Number(2) == 0xFF51;
  const std::uint32_t length = bytes.Number(2);
  bytes.Number(2); // capabilities
  const std::uint32_t columns = bytes.Number(4);
  const std::uint32_t rows = bytes.Number(4);
  const bool hasOffset = bytes.Number(4) != 0 || bytes.Number(4) != 0;
  const std::uint32_t tileColumns = bytes.Number(4);
  const std::uint32_t tileRows = bytes.Number(4);
  const bool hasTileOffset = bytes.Number(4) != 0 || bytes.Number(4) != 0;
  const std::uint32_t components = bytes.Number(2);
  const std::uint32_t depth = bytes.Number(1);
  const std::uint32_t bits = (depth & 0x7F) + 1;
  const bool isSigned = (depth & 0x80) != 0;
  const bool isFull = bytes.Number(1) == 1 && bytes.Number(1) == 1;
  return bytes.IsGood() && isMarked && length == 41 && !hasOffset && !hasTileOffset && isFull &&
    columns == static_cast<std::uint32_t>(format.Columns) &&
    rows == static_cast<std::uint32_t>(format.Rows) && tileColumns > 0 && tileRows > 0 &&
    components == 1 && isSigned == format.IsSigned && FitsIntoPixels(bits, format);
}

} // namespace

bool IsCodestreamOf(const std::string& stream, const std::string& transferSyntax,
  const DicomPixelFormat& format)
{
  const std::string jpeg2000 = "1.2.840.10008.1.2.4.9";
  return transferSyntax.compare(0, jpeg2000.size(), jpeg2000) == 0
    ? IsJpeg2000Of(stream, format)
    : IsJpegOf(stream, transferSyntax, format);
}

} // namespace FlipFree

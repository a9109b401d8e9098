#include "DicomLibraries.h"

#include "gdcmImageReader.h"
#include "gdcmTrace.h"

#include "itk_zlib.h"

#include <exception>
#include <sstream>

namespace FlipFree
{
namespace
{

/// GDCM's messages go to the terminal, past VTK's; within a scope that holds one of these they are
/// off. What they are about is reported where the pixels are wanted.
class GdcmMessagesOff
{
public:
  GdcmMessagesOff()
  {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
  }
  ~GdcmMessagesOff()
  {
    gdcm::Trace::SetWarning(this->Warnings);
    gdcm::Trace::SetError(this->Errors);
  }
  GdcmMessagesOff(const GdcmMessagesOff&) = delete;
  void operator=(const GdcmMessagesOff&) = delete;

private:
  bool Warnings = gdcm::Trace::GetWarningFlag();
  bool Errors = gdcm::Trace::GetErrorFlag();
};

std::string InflateBytes(const std::string& packed, std::size_t most)
{
  z_stream stream = {};
  inflateInit2(&stream, -MAX_WBITS); // without a header of its own
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string plain;
  std::string part(1 << 16, '\0');
  for (int state = Z_OK; state == Z_OK && plain.size() < most;)
  {
    stream.next_out = reinterpret_cast<Bytef*>(&part[0]);
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    plain.append(part, 0, part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return plain;
}

std::string DecodePixels(const std::string& file)
{
  const GdcmMessagesOff quiet;
  try
  {
    std::istringstream stream(file);
    gdcm::ImageReader reader;
    reader.SetStream(stream);
    if (!reader.Read())
    {
      return {};
    }
    const gdcm::Image& image = reader.GetImage();
    std::string stored(image.GetBufferLength(), '\0');
    return image.GetBuffer(&stored[0]) ? stored : std::string();
  }
  catch (const std::exception&)
  {
    return {};
  }
}

} // namespace

DicomAccess DicomByLibraries()
{
  return { OpenDicomFile, InflateBytes, DecodePixels };
}

} // namespace FlipFree

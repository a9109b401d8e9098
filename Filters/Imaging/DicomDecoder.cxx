#include "DicomDecoder.h"

#include "gdcmImageReader.h"
#include "gdcmTrace.h"

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

} // namespace

std::string DecodeDicomPixels(const std::string& file)
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

} // namespace FlipFree

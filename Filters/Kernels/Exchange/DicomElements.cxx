#include "Exchange/DicomElements.h"

#include "Exchange/DicomAttributes.h"

#include <algorithm>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>

namespace FlipFree
{
namespace
{

const std::map<std::uint32_t, const char*>& WantedElements()
{
  using namespace DicomTag;
  static const std::map<std::uint32_t, const char*> wanted{ { TransferSyntaxUID, "UI" },
    { SpecificCharacterSet, "CS" }, { ImageType, "CS" }, { SOPClassUID, "UI" },
    { SOPInstanceUID, "UI" }, { AcquisitionTime, "TM" }, { Modality, "CS" },
    { SeriesDescription, "LO" }, { FrameType, "CS" }, { KVP, "DS" }, { EchoTime, "DS" },
    { EchoNumbers, "IS" }, { SpacingBetweenSlices, "DS" }, { TriggerTime, "DS" },
    { ConvolutionKernel, "SH" }, { ImagerPixelSpacing, "DS" }, { EffectiveEchoTime, "FD" },
    { DiffusionBValue, "FD" }, { DiffusionGradientOrientation, "FD" }, { SeriesInstanceUID, "UI" },
    { SeriesNumber, "IS" }, { AcquisitionNumber, "IS" }, { ImagePositionPatient, "DS" },
    { ImageOrientationPatient, "DS" }, { TemporalPositionIdentifier, "IS" }, { StackID, "SH" },
    { TemporalPositionIndex, "UL" }, { NominalCardiacTriggerDelayTime, "FD" },
    { FrameAcquisitionNumber, "US" }, { TemporalPositionTimeOffset, "FD" },
    { SamplesPerPixel, "US" }, { PhotometricInterpretation, "CS" }, { NumberOfFrames, "IS" },
    { FrameIncrementPointer, "AT" }, { SliceVector, "US" }, { Rows, "US" }, { Columns, "US" },
    { PixelSpacing, "DS" }, { BitsAllocated, "US" }, { BitsStored, "US" }, { HighBit, "US" },
    { PixelRepresentation, "US" }, { RescaleIntercept, "DS" }, { RescaleSlope, "DS" },
    { FrameReferenceTime, "DS" }, { GridFrameOffsetVector, "DS" }, { DoseGridScaling, "DS" } };
  return wanted;
}

template <typename T>
std::string DicomNumbersText(const std::string& bytes, bool isBigEndian)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
  {
    text << (at ? "\\" : "") << DicomNumberAt<T>(bytes, at, isBigEndian);
  }
  return text.str();
}

/// Tags as numbers. The group comes first, whatever the order of bytes.
std::string DicomTagsText(const std::string& bytes, bool isBigEndian)
{
  std::string text;
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4)
  {
    const std::uint32_t group = DicomNumberAt<std::uint16_t>(bytes, at, isBigEndian);
    const std::uint32_t element = DicomNumberAt<std::uint16_t>(bytes, at + 2, isBigEndian);
    text += (at ? "\\" : "") + std::to_string(group << 16 | element);
  }
  return text;
}

} // namespace

const char* TypeOfWantedElement(std::uint32_t tag)
{
  const auto wanted = WantedElements().find(tag);
  return wanted == WantedElements().end() ? nullptr : wanted->second;
}

bool IsFunctionalGroup(std::uint32_t tag)
{
  constexpr std::uint32_t groups[] = {
    0x00189114, // MR echo
    0x00189117, // MR diffusion
    0x00189076, // diffusion gradient direction, within it
    0x00189118, // cardiac synchronization
    0x00189226, // MR image frame type
    0x00189329, // CT image frame type
    0x00189751, // PET image frame type
    0x00209111, // frame content
    0x00209113, // plane position
    0x00209116, // plane orientation
    0x00209310, // temporal position
    0x00289110, // pixel measures
    0x00289145  // pixel value transformation
  };
  return std::find(std::begin(groups), std::end(groups), tag) != std::end(groups);
}

bool IsShortDicomType(const std::string& type)
{
  static const std::string types =
    "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US ";
  return types.find(type + ' ') != std::string::npos;
}

bool IsLongDicomType(const std::string& type)
{
  static const std::string types = "OB OD OF OL OV OW SQ SV UC UN UR UT UV ";
  return types.find(type + ' ') != std::string::npos;
}

std::string DicomValueText(const std::string& bytes, const std::string& type, bool isBigEndian)
{
  if (type == "US")
  {
    return DicomNumbersText<std::uint16_t>(bytes, isBigEndian);
  }
  if (type == "SS")
  {
    return DicomNumbersText<std::int16_t>(bytes, isBigEndian);
  }
  if (type == "UL")
  {
    return DicomNumbersText<std::uint32_t>(bytes, isBigEndian);
  }
  if (type == "SL")
  {
    return DicomNumbersText<std::int32_t>(bytes, isBigEndian);
  }
  if (type == "AT")
  {
    return DicomTagsText(bytes, isBigEndian);
  }
  if (type == "FL")
  {
    return DicomNumbersText<float>(bytes, isBigEndian);
  }
  if (type == "FD")
  {
    return DicomNumbersText<double>(bytes, isBigEndian);
  }
  return WithoutDicomPadding(bytes);
}

} // namespace FlipFree

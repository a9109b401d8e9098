/**
 * What a DICOM file says, by tags: texts and numbers.
 */
#ifndef FlipFreeDicomAttributes_h
#define FlipFreeDicomAttributes_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace FlipFree
{

namespace DicomTag
{
constexpr std::uint32_t TransferSyntaxUID = 0x00020010;
constexpr std::uint32_t SpecificCharacterSet = 0x00080005;
constexpr std::uint32_t ImageType = 0x00080008;
constexpr std::uint32_t SOPClassUID = 0x00080016;
constexpr std::uint32_t SOPInstanceUID = 0x00080018;
constexpr std::uint32_t AcquisitionTime = 0x00080032;
constexpr std::uint32_t Modality = 0x00080060;
constexpr std::uint32_t SeriesDescription = 0x0008103E;
constexpr std::uint32_t FrameType = 0x00089007;
constexpr std::uint32_t KVP = 0x00180060;
constexpr std::uint32_t EchoTime = 0x00180081;
constexpr std::uint32_t EchoNumbers = 0x00180086;
constexpr std::uint32_t SpacingBetweenSlices = 0x00180088;
constexpr std::uint32_t TriggerTime = 0x00181060;
constexpr std::uint32_t ConvolutionKernel = 0x00181210;
constexpr std::uint32_t ImagerPixelSpacing = 0x00181164;
constexpr std::uint32_t EffectiveEchoTime = 0x00189082;
constexpr std::uint32_t DiffusionBValue = 0x00189087;
constexpr std::uint32_t DiffusionGradientOrientation = 0x00189089;
constexpr std::uint32_t SeriesInstanceUID = 0x0020000E;
constexpr std::uint32_t SeriesNumber = 0x00200011;
constexpr std::uint32_t AcquisitionNumber = 0x00200012;
constexpr std::uint32_t ImagePositionPatient = 0x00200032;
constexpr std::uint32_t ImageOrientationPatient = 0x00200037;
constexpr std::uint32_t TemporalPositionIdentifier = 0x00200100;
constexpr std::uint32_t StackID = 0x00209056;
constexpr std::uint32_t TemporalPositionIndex = 0x00209128;
constexpr std::uint32_t NominalCardiacTriggerDelayTime = 0x00209153;
constexpr std::uint32_t FrameAcquisitionNumber = 0x00209156;
constexpr std::uint32_t TemporalPositionTimeOffset = 0x0020930D;
constexpr std::uint32_t SamplesPerPixel = 0x00280002;
constexpr std::uint32_t PhotometricInterpretation = 0x00280004;
constexpr std::uint32_t NumberOfFrames = 0x00280008;
constexpr std::uint32_t FrameIncrementPointer = 0x00280009;
constexpr std::uint32_t Rows = 0x00280010;
constexpr std::uint32_t Columns = 0x00280011;
constexpr std::uint32_t PixelSpacing = 0x00280030;
constexpr std::uint32_t BitsAllocated = 0x00280100;
constexpr std::uint32_t BitsStored = 0x00280101;
constexpr std::uint32_t HighBit = 0x00280102;
constexpr std::uint32_t PixelRepresentation = 0x00280103;
constexpr std::uint32_t RescaleIntercept = 0x00281052;
constexpr std::uint32_t RescaleSlope = 0x00281053;
constexpr std::uint32_t SliceVector = 0x00540080;
constexpr std::uint32_t FrameReferenceTime = 0x00541300;
constexpr std::uint32_t GridFrameOffsetVector = 0x3004000C;
constexpr std::uint32_t DoseGridScaling = 0x3004000E;
} // namespace DicomTag

/// Values by tag. Numbers are text, too, whatever their coding in the file; several values are
/// separated by backslashes.
class DicomAttributes
{
public:
  /// The first value of a tag stays.
  void Add(std::uint32_t tag, const std::string& text) { this->Values.emplace(tag, text); }

  /// An empty value counts as none.
  bool Has(std::uint32_t tag) const { return !this->Text(tag).empty(); }

  /// Empty where there is none.
  const std::string& Text(std::uint32_t tag) const;

  /// Empty where there are none, or what is no finite number among them.
  std::vector<double> Numbers(std::uint32_t tag) const;

  /// The only number of the tag, if it is whole and within bounds; else the other one.
  int Integer(std::uint32_t tag, int least, int greatest, int otherwise) const;

private:
  std::map<std::uint32_t, std::string> Values;
};

/// A value without the blanks and zeros that fill it up.
std::string WithoutDicomPadding(const std::string& text);

/// Text in UTF-8 for people, by the file's character set; what that does not tell is shown as `?`.
std::string DicomTextForPeople(const DicomAttributes& attributes, std::uint32_t tag);

} // namespace FlipFree

#endif

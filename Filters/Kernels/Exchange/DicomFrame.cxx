#include "Exchange/DicomFrame.h"

#include <cmath>

namespace FlipFree
{
namespace
{

/// Longer ones are no measures of the body.
constexpr double GreatestDicomLength = 1e6; // mm

/// Every frame holds its keys, so that long ones of many frames would fill the memory.
constexpr std::size_t LongestKey = 256;

/// In the order of DicomFrame::Keys.
constexpr std::uint32_t TellingTags[] = { DicomTag::StackID, DicomTag::TemporalPositionIndex,
  DicomTag::TemporalPositionIdentifier, DicomTag::AcquisitionNumber,
  DicomTag::FrameAcquisitionNumber, DicomTag::EchoNumbers, DicomTag::EchoTime,
  DicomTag::EffectiveEchoTime, DicomTag::DiffusionBValue, DicomTag::DiffusionGradientOrientation,
  DicomTag::TriggerTime, DicomTag::NominalCardiacTriggerDelayTime,
  DicomTag::TemporalPositionTimeOffset, DicomTag::FrameReferenceTime, DicomTag::ImageType,
  DicomTag::FrameType, DicomTag::KVP, DicomTag::ConvolutionKernel, DicomTag::AcquisitionTime };

std::string QuotedDicomText(const DicomDataSet& data, std::uint32_t tag, std::size_t frame)
{
  DicomAttributes shown;
  shown.Add(tag, data.TextOf(tag, frame).substr(0, 60));
  return "'" + DicomTextForPeople(shown, tag) + "'";
}

std::string ReadSpacing(const DicomDataSet& data, DicomFrame& frame)
{
  const std::string remedy =
    ". Without the size of a pixel nothing can be measured: export the series again with it";
  if (data.TextOf(DicomTag::PixelSpacing, frame.Number).empty())
  {
    return data.TextOf(DicomTag::ImagerPixelSpacing, frame.Number).empty()
      ? "has no PixelSpacing" + remedy
      : "has no PixelSpacing but only ImagerPixelSpacing, which is measured at the detector and "
        "not "
        "in the patient" +
        remedy;
  }
  const std::vector<double> numbers = data.NumbersOf(DicomTag::PixelSpacing, frame.Number);
  if (numbers.size() != 2 || numbers[0] <= 1 / GreatestDicomLength ||
    numbers[1] <= 1 / GreatestDicomLength || numbers[0] > GreatestDicomLength ||
    numbers[1] > GreatestDicomLength)
  {
    return "has the PixelSpacing " + QuotedDicomText(data, DicomTag::PixelSpacing, frame.Number) +
      ", which is not two lengths in millimeters" + remedy;
  }
  frame.Spacing = { numbers[1], numbers[0] }; // the file gives the distance of rows first
  return {};
}

std::string ReadAxes(const DicomDataSet& data, DicomFrame& frame)
{
  const std::string remedy = ", so its place in the patient is unknown. Export the series again "
                             "with it, or choose another one";
  const std::vector<double> numbers =
    data.NumbersOf(DicomTag::ImageOrientationPatient, frame.Number);
  if (numbers.empty() && data.TextOf(DicomTag::ImageOrientationPatient, frame.Number).empty())
  {
    return "has no ImageOrientationPatient" + remedy;
  }
  constexpr double tolerance = 0.02; // for rounded digits
  bool isGood = numbers.size() == 6;
  if (isGood)
  {
    frame.Axes = Eigen::Map<const Eigen::Matrix<double, 3, 2>>(numbers.data()).array() + 0.0;
    isGood =
      (frame.Axes.transpose() * frame.Axes - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() <
      tolerance;
    frame.Axes.colwise().normalize(); // lengths are those of PixelSpacing alone
  }
  return isGood ? ""
                : "has the ImageOrientationPatient " +
      QuotedDicomText(data, DicomTag::ImageOrientationPatient, frame.Number) +
      ", which is not two unit vectors at a right angle" + remedy;
}

/// Where a multi-frame image that is not enhanced says how far its frames are from the first one.
/// Frames that also differ in time, energy or detector are no volume, so their number places them
/// only where nothing else than the slice counts them.
std::string ReadOffsets(const DicomDataSet& data, std::vector<double>& offsets)
{
  const std::size_t frames = NumberOfDicomFrames(data);
  offsets.assign(frames, 0);
  if (frames == 1 || !data.Frames.empty())
  {
    return {};
  }
  const DicomAttributes& known = data.Attributes;
  const std::vector<double> distances = known.Numbers(DicomTag::GridFrameOffsetVector);
  const std::vector<double> spacing = known.Numbers(DicomTag::SpacingBetweenSlices);
  const std::vector<double> slices = known.Numbers(DicomTag::SliceVector);
  const std::string& pointer = known.Text(DicomTag::FrameIncrementPointer);
  const bool isBySlice = pointer.empty() || pointer == std::to_string(DicomTag::SliceVector);
  if (distances.size() == frames)
  {
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
      offsets[frame] = distances[frame] - distances[0];
    }
    return {};
  }
  const bool isBySpacing = !known.Has(DicomTag::GridFrameOffsetVector) && spacing.size() == 1;
  if (isBySpacing && !isBySlice)
  {
    return "counts its " + std::to_string(frames) +
      " frames by other things than slices (FrameIncrementPointer), such as times, energies or "
      "detectors, so their places in the patient are unknown. Export it as an enhanced image, or "
      "choose another series";
  }
  if (!isBySpacing || (!slices.empty() && slices.size() != frames))
  {
    return "does not say where its " + std::to_string(frames) +
      " frames lie in the patient. Export it as an enhanced image, or choose another series";
  }
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    // A negative spacing leads against the normal.
    offsets[frame] =
      spacing[0] * (slices.empty() ? static_cast<double>(frame) : slices[frame] - slices[0]);
  }
  return {};
}

std::string ReadPosition(const DicomDataSet& data, DicomFrame& frame)
{
  const std::string remedy = ", so its place in the patient is unknown. Export the series again "
                             "with it, or choose another one";
  const std::vector<double> numbers = data.NumbersOf(DicomTag::ImagePositionPatient, frame.Number);
  if (numbers.empty() && data.TextOf(DicomTag::ImagePositionPatient, frame.Number).empty())
  {
    return "has no ImagePositionPatient" + remedy;
  }
  bool isGood = numbers.size() == 3;
  if (isGood)
  {
    frame.Position = Eigen::Map<const Eigen::Vector3d>(numbers.data()).array() + 0.0;
    isGood = frame.Position.cwiseAbs().maxCoeff() < GreatestDicomLength;
  }
  if (!isGood)
  {
    return "has the ImagePositionPatient " +
      QuotedDicomText(data, DicomTag::ImagePositionPatient, frame.Number) +
      ", which is not a point in millimeters" + remedy;
  }
  return {};
}

std::string ReadStorage(const DicomDataSet& data, DicomFrame& frame)
{
  const DicomAttributes& known = data.Attributes;
  if (!known.Has(DicomTag::BitsStored))
  {
    frame.Assumption = "has no BitsStored, so all " + std::to_string(frame.Format.BitsAllocated) +
      " bits of its pixels are taken";
  }
  if (!known.Has(DicomTag::PixelRepresentation))
  {
    frame.Assumption = (frame.Assumption.empty() ? "" : frame.Assumption + "; it ") +
      std::string("has no PixelRepresentation, so its pixels are taken as unsigned");
  }
  else if (known.Integer(DicomTag::PixelRepresentation, 0, 1, -1) < 0)
  {
    return "has the PixelRepresentation " +
      QuotedDicomText(data, DicomTag::PixelRepresentation, frame.Number) +
      ", which is neither 0 (unsigned) nor 1 (signed), so its gray values are unknown. Export the "
      "series again";
  }
  return {};
}

std::string ReadRescale(const DicomDataSet& data, DicomFrame& frame)
{
  const std::string remedy = ", so its gray values are unknown. Export the series again";
  std::uint32_t slopeTag = DicomTag::RescaleSlope;
  bool hasSlope = !data.TextOf(slopeTag, frame.Number).empty();
  const bool hasIntercept = !data.TextOf(DicomTag::RescaleIntercept, frame.Number).empty();
  if (!hasSlope && !hasIntercept && data.Attributes.Has(DicomTag::DoseGridScaling))
  {
    slopeTag = DicomTag::DoseGridScaling;
    hasSlope = true;
  }
  frame.HasRescale = hasSlope || hasIntercept;
  if (data.HasModalityLut && !hasSlope)
  {
    return "has a table of gray values (ModalityLUTSequence) in place of a RescaleSlope, which is "
           "not supported. Export the series again with RescaleSlope and RescaleIntercept";
  }
  if (hasSlope != hasIntercept && slopeTag == DicomTag::RescaleSlope)
  {
    return std::string("has a ") + (hasSlope ? "RescaleSlope" : "RescaleIntercept") + " but no " +
      (hasSlope ? "RescaleIntercept" : "RescaleSlope") + remedy;
  }
  const auto read = [&](std::uint32_t tag, double& number)
  {
    const std::vector<double> numbers = data.NumbersOf(tag, frame.Number);
    number = numbers.size() == 1 ? numbers[0] : 0;
    return numbers.size() == 1;
  };
  constexpr double least = 1e-30;
  constexpr double greatest = 1e30;
  const bool isGood = (!hasSlope || read(slopeTag, frame.Rescale.Slope)) &&
    (!hasIntercept || read(DicomTag::RescaleIntercept, frame.Rescale.Intercept)) &&
    std::abs(frame.Rescale.Slope) > least && std::abs(frame.Rescale.Slope) < greatest &&
    std::abs(frame.Rescale.Intercept) < greatest;
  return isGood ? ""
                : "has the RescaleSlope " + QuotedDicomText(data, slopeTag, frame.Number) +
      " and the RescaleIntercept " +
      QuotedDicomText(data, DicomTag::RescaleIntercept, frame.Number) + remedy;
}

} // namespace

std::vector<DicomFrame> DicomFramesOf(const DicomDataSet& data, std::size_t file)
{
  const DicomPixelFormat format = PixelFormatOf(data);
  const bool isLocalizer =
    data.Attributes.Text(DicomTag::ImageType).find("LOCALIZER") != std::string::npos;
  std::vector<double> offsets;
  const std::string problemOfOffsets = ReadOffsets(data, offsets);
  std::vector<DicomFrame> frames(NumberOfDicomFrames(data));
  for (std::size_t number = 0; number < frames.size(); ++number)
  {
    DicomFrame& frame = frames[number];
    frame.File = file;
    frame.Number = number;
    frame.Format = format;
    frame.IsLocalizer = isLocalizer;
    frame.HasPosition = !data.TextOf(DicomTag::ImagePositionPatient, number).empty();
    frame.Instance = data.Attributes.Text(DicomTag::SOPInstanceUID).substr(0, LongestKey);
    for (const auto read : { ReadSpacing, ReadAxes, ReadPosition, ReadStorage, ReadRescale })
    {
      if (frame.Problem.empty())
      {
        frame.Problem = read(data, frame);
      }
    }
    if (frame.Problem.empty())
    {
      frame.Problem = problemOfOffsets;
      frame.Position += offsets[number] * frame.Normal();
    }
    for (const std::uint32_t tag : TellingTags)
    {
      frame.Keys.push_back(data.TextOf(tag, number).substr(0, LongestKey));
    }
  }
  return frames;
}

} // namespace FlipFree

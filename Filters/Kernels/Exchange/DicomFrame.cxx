#include "Exchange/DicomFrame.h"

#include <cmath>

namespace FlipFree
{
namespace
{

/// Longer ones are no measures of the body.
constexpr double GreatestDicomLength = 1e6; // mm

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
  }
  return isGood ? ""
                : "has the ImageOrientationPatient " +
      QuotedDicomText(data, DicomTag::ImageOrientationPatient, frame.Number) +
      ", which is not two unit vectors at a right angle" + remedy;
}

/// Where a multi-frame image that is not enhanced says how far its frames are from the first one.
std::string ReadOffset(const DicomDataSet& data, std::size_t frame, double& offset)
{
  offset = 0;
  const std::size_t frames = NumberOfDicomFrames(data);
  if (frames == 1 || !data.Frames.empty())
  {
    return {};
  }
  const std::vector<double> offsets = data.Attributes.Numbers(DicomTag::GridFrameOffsetVector);
  const std::vector<double> spacing = data.Attributes.Numbers(DicomTag::SpacingBetweenSlices);
  if (offsets.size() == frames)
  {
    offset = offsets[frame] - offsets[0];
  }
  else if (offsets.empty() && spacing.size() == 1)
  {
    offset = spacing[0] * static_cast<double>(frame); // a negative one leads against the normal
  }
  else
  {
    return "does not say where its " + std::to_string(frames) +
      " frames lie in the patient. Export it as an enhanced image, or choose another series";
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
  double offset = 0;
  const std::string problem = ReadOffset(data, frame.Number, offset);
  frame.Position += offset * frame.Normal();
  return problem;
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
  std::vector<DicomFrame> frames(NumberOfDicomFrames(data));
  for (std::size_t number = 0; number < frames.size(); ++number)
  {
    DicomFrame& frame = frames[number];
    frame.File = file;
    frame.Number = number;
    frame.Format = format;
    frame.IsLocalizer = isLocalizer;
    frame.HasPosition = !data.TextOf(DicomTag::ImagePositionPatient, number).empty();
    frame.Instance = data.Attributes.Text(DicomTag::SOPInstanceUID);
    for (const auto read : { ReadSpacing, ReadAxes, ReadPosition, ReadRescale })
    {
      if (frame.Problem.empty())
      {
        frame.Problem = read(data, frame);
      }
    }
    for (const std::uint32_t tag : TellingTags)
    {
      frame.Keys.push_back(data.TextOf(tag, number));
    }
  }
  return frames;
}

} // namespace FlipFree

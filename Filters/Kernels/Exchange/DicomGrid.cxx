#include "Exchange/DicomGrid.h"

#include "MessageText.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

constexpr double GridTolerance = 1e-3; // of a pixel, and of a unit axis

bool HaveOneSize(const DicomFrame& a, const DicomFrame& b)
{
  return a.Format.Columns == b.Format.Columns && a.Format.Rows == b.Format.Rows;
}

bool HaveOneSpacing(const DicomFrame& a, const DicomFrame& b)
{
  return (a.Spacing - b.Spacing).norm() < GridTolerance * a.Spacing[0];
}

std::string SizeText(const DicomFrame& frame)
{
  return std::to_string(frame.Format.Columns) + " x " + std::to_string(frame.Format.Rows);
}

std::string SpacingText(const DicomFrame& frame)
{
  return TextOf(frame.Spacing[0]) + " x " + TextOf(frame.Spacing[1]) + " mm";
}

/// The angle of the rotation between the frames, in degrees.
double AngleBetween(const DicomFrame& a, const DicomFrame& b)
{
  const auto axes = [](const DicomFrame& frame)
  {
    Eigen::Matrix3d all;
    all << frame.Axes, frame.Normal();
    return all;
  };
  constexpr double degrees = 180 / EIGEN_PI;
  const double cosine = ((axes(a).transpose() * axes(b)).trace() - 1) / 2;
  return degrees * std::acos(std::max(-1., std::min(1., cosine)));
}

} // namespace

bool AreOnOneGrid(const DicomFrame& a, const DicomFrame& b)
{
  return HaveOneSize(a, b) && HaveOneSpacing(a, b) && (a.Axes - b.Axes).norm() < GridTolerance;
}

std::string GridDifference(const DicomFrame& frame, const DicomFrame& usual)
{
  if (!HaveOneSize(frame, usual))
  {
    return SizeText(frame) + " pixels, not " + SizeText(usual);
  }
  if (!HaveOneSpacing(frame, usual))
  {
    return "pixels of " + SpacingText(frame) + ", not " + SpacingText(usual);
  }
  return AreOnOneGrid(frame, usual)
    ? std::string()
    : "axes that are turned by " + TextOf(AngleBetween(frame, usual)) + " degrees";
}

} // namespace FlipFree

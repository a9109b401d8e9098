/**
 * One frame of a DICOM file: a file that is a slice has one, enhanced and other multi-frame images
 * have many. Says where the frame lies in the patient and which gray values its pixels mean, or
 * what the file leaves open.
 */
#ifndef FlipFreeDicomFrame_h
#define FlipFreeDicomFrame_h

#include "Exchange/DicomDataSet.h"
#include "Exchange/DicomPixels.h"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace FlipFree
{

struct DicomFrame
{
  std::size_t File = 0;   ///< its place in a list of files
  std::size_t Number = 0; ///< within the file, from 0
  DicomPixelFormat Format;
  DicomRescale Rescale;
  bool HasRescale = false; ///< said by the file
  /// Center of the first pixel, LPS millimeters.
  Eigen::Vector3d Position = Eigen::Vector3d::Zero();
  /// Unit axes: along a row and along a column.
  Eigen::Matrix<double, 3, 2> Axes = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector2d Spacing = Eigen::Vector2d::Zero(); ///< likewise, in millimeters
  bool HasPosition = false;                          ///< whatever it is
  bool IsLocalizer = false;
  std::string Instance; ///< SOP Instance UID
  /// What may tell frames at one place apart, in the order in which it is tried: stack, time,
  /// acquisition, echo and so on.
  std::vector<std::string> Keys;
  /// What is missing or wrong, as the end of the sentence "'file' ..."; empty where nothing is.
  std::string Problem;
  /// What was taken because the file does not say, likewise; empty where it says all.
  std::string Assumption;

  Eigen::Vector3d Normal() const
  {
    return Eigen::Vector3d(this->Axes.col(0))
      .cross(Eigen::Vector3d(this->Axes.col(1)))
      .normalized();
  }
};

/// The frames of a file whose pixels are gray and complete.
std::vector<DicomFrame> DicomFramesOf(const DicomDataSet& data, std::size_t file);

} // namespace FlipFree

#endif

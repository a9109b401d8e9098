#include "LabelSurface/GridFrame.h"

#include "Error.h"
#include "Guard/SinglePrecision.h"

#include <sstream>

namespace FlipFree
{
namespace
{

// Voxels, along an axis. Well below what vertices keep from the sides of their cells.
constexpr double MaximumRounding = 1e-3;

} // namespace

GridFrame::GridFrame(const ImageGeometry& image, const std::array<int, 3>& first)
  : Origin(image.ToPhysical(Eigen::Vector3d(first[0], first[1], first[2])))
  , Axes(image.Direction * image.Spacing.asDiagonal())
  , Inverse(this->Axes.inverse())
{
  double greatest = image.Origin.cwiseAbs().maxCoeff();
  for (int axis = 0; axis < 3; ++axis)
  {
    greatest += this->Axes.col(axis).cwiseAbs().maxCoeff() * image.Dimensions[axis];
  }
  // Rounding to 24 bits moves a coordinate x by at most 2^-24 |x|.
  const double rounding =
    greatest / (1 << 24) * this->Inverse.cwiseAbs().rowwise().sum().maxCoeff();
  if (!(rounding < MaximumRounding))
  {
    std::ostringstream message;
    message << "at coordinates of up to " << greatest
            << " mm, single precision, which files of surfaces have, is too coarse for voxels of "
            << image.Spacing.minCoeff() << " mm; move the origin of the label map";
    throw Error(ErrorCode::InvalidGeometry, message.str());
  }
}

Eigen::Vector3d GridFrame::RoundedPoint(const Eigen::Vector3d& index) const
{
  const Eigen::Vector3d point = this->Origin + this->Axes * index;
  return RoundToSingle(point.transpose(), this->Axes.norm()).transpose();
}

} // namespace FlipFree

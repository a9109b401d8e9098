#include "Image/PointCheck.h"

#include "Error.h"
#include "MessageText.h"

namespace FlipFree
{
namespace
{

bool IsWithin(const ImageGeometry& geometry, const Eigen::Vector3d& point)
{
  const Eigen::Array3d index = geometry.ToIndex(point);
  const auto& size = geometry.Dimensions;
  return (index >= -0.5).all() && (index <= Eigen::Array3d(size[0], size[1], size[2]) - 0.5).all();
}

} // namespace

void RequirePoint(const ImageGeometry& geometry, const Eigen::Vector3d& point,
  const std::string& what, const std::string& name)
{
  if (!point.allFinite())
  {
    throw Error(ErrorCode::NonFiniteValue,
      what + " has a coordinate that is not a finite number; set it to one");
  }
  if (IsWithin(geometry, point))
  {
    return;
  }
  const auto& size = geometry.Dimensions;
  const Eigen::Vector3d last(size[0] - 1, size[1] - 1, size[2] - 1);
  const bool isRas = IsWithin(geometry, Eigen::Vector3d(-point[0], -point[1], point[2]));
  throw Error(ErrorCode::OutOfRange,
    what + " lies outside " + name + ", which reaches from " +
      TextOf(geometry.ToPhysical(Eigen::Vector3d::Zero())) + " to " +
      TextOf(geometry.ToPhysical(last)) +
      " mm; give it in the image's physical coordinates, LPS for medical files" +
      (isRas ? ": with x and y negated it would lie inside, so it may be in RAS" : ""));
}

} // namespace FlipFree

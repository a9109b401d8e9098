#include "Image/PointCheck.h"

#include "Error.h"
#include "Image/SeedRegion.h"
#include "MessageText.h"

namespace FlipFree
{
namespace
{

// Of the box around all voxels, to a tenth of a millimeter.
std::string ExtentText(const ImageGeometry& geometry)
{
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d index;
    for (int axis = 0; axis < 3; ++axis)
    {
      index[axis] = (corner >> axis & 1 ? geometry.Dimensions[axis] : 0) - 0.5;
    }
    box.extend(geometry.ToPhysical(index));
  }
  const auto rounded = [](const Eigen::Vector3d& place)
  { return TextOf(((10 * place.array()).round() / 10).matrix()); };
  return rounded(box.min()) + " to " + rounded(box.max()) + " mm";
}

} // namespace

void RequirePoint(const ImageGeometry& geometry, const Eigen::Vector3d& point,
  const std::string& what, const std::string& name)
{
  if (!point.allFinite())
  {
    throw Error(ErrorCode::NonFiniteValue, what + " is not a place; give three finite numbers");
  }
  if (!ContainsSphere(geometry, { point, 0 }))
  {
    const bool isMirrored =
      ContainsSphere(geometry, { Eigen::Vector3d(-point[0], -point[1], point[2]), 0 });
    throw Error(ErrorCode::OutOfRange,
      what + " lies outside " + name + ", which spans " + ExtentText(geometry) +
        (isMirrored ? "; with x and y negated it would lie inside: check whether it is LPS or RAS"
                    : "; correct its physical coordinates (LPS)"));
  }
}

} // namespace FlipFree

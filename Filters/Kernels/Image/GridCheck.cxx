#include "Image/GridCheck.h"

#include "Error.h"

namespace FlipFree
{
namespace
{

[[noreturn]] void RefuseGeometry(const std::string& what, const Eigen::MatrixXd& ofOne,
  const std::string& one, const Eigen::MatrixXd& ofOther, const std::string& other)
{
  throw Error(ErrorCode::GeometryMismatch,
    "the " + what + " of " + one + " " + TextOf(ofOne) + " and of " + other + " " +
      TextOf(ofOther) + " differ; resample one onto the grid of the other");
}

Eigen::Vector3d Vector(const std::array<int, 3>& values)
{
  return { 1.0 * values[0], 1.0 * values[1], 1.0 * values[2] };
}

using CornerVoxels = std::array<Eigen::Vector3d, 8>;

// The one of least indices is the first.
CornerVoxels CornersOf(const ImageGeometry& geometry)
{
  CornerVoxels corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    corners[corner] =
      geometry.ToPhysical(Eigen::Vector3d(corner & 1, (corner >> 1) & 1, corner >> 2)
                            .cwiseProduct(Vector(geometry.Dimensions) - Eigen::Vector3d::Ones()));
  }
  return corners;
}

} // namespace

void RequireSameGeometry(const ImageGeometry& one, const ImageGeometry& other,
  const std::string& nameOfOne, const std::string& nameOfOther)
{
  const auto refuse =
    [&](const std::string& what, const Eigen::MatrixXd& ofOne, const Eigen::MatrixXd& ofOther)
  { RefuseGeometry(what, ofOne, nameOfOne, ofOther, nameOfOther); };
  if (one.Dimensions != other.Dimensions)
  {
    refuse("dimensions", Vector(one.Dimensions), Vector(other.Dimensions));
  }
  // Headers round their numbers, so compare where the corner voxels end up.
  const CornerVoxels corners = CornersOf(one);
  const CornerVoxels counterparts = CornersOf(other);
  for (int corner = 0; corner < 8; ++corner)
  {
    const double distance = (corners[corner] - counterparts[corner]).norm();
    if (distance <= 0.01 * other.Spacing.cwiseAbs().minCoeff())
    {
      continue;
    }
    if (corner == 0)
    {
      refuse("origins", one.Origin, other.Origin);
    }
    if (!one.Spacing.isApprox(other.Spacing, 1e-5))
    {
      refuse("spacings", one.Spacing, other.Spacing);
    }
    refuse("direction matrices", one.Direction, other.Direction);
  }
}

} // namespace FlipFree

/**
 * The checks that a voxel grid is valid, and that two grids are the same.
 */
#ifndef FlipFreeGridCheck_h
#define FlipFreeGridCheck_h

#include "Error.h"
#include "KernelTypes.h"
#include "MessageText.h"

#include <cmath>
#include <string>

namespace FlipFree
{

/// Of unit vectors along the axes. With a smaller one, an axis lies within about half a degree of
/// another one or of the plane of both others. No scanner or registration does that, and what is
/// searched within some millimeters has no bound in voxels.
constexpr double LeastDeterminant = 0.01;

/// Millimeters. No voxel of an organ is smaller, and lengths divided by a smaller spacing overflow.
constexpr double LeastSpacing = 1e-5;

/// Throws Error, naming the image by `name`, unless its voxels lie apart on three independent axes.
inline void RequireProperGrid(const ImageGeometry& geometry, const std::string& name)
{
  if (!(geometry.Spacing.minCoeff() >= LeastSpacing) || !geometry.Spacing.allFinite())
  {
    throw Error(ErrorCode::InvalidGeometry,
      name + " has a spacing of " + TextOf(geometry.Spacing) +
        " mm; make it positive on every axis, at least " + TextOf(LeastSpacing) +
        ", and turn axes by the direction matrix");
  }
  if (!(std::abs(geometry.Direction.determinant()) > LeastDeterminant) ||
    !geometry.Direction.allFinite() || !geometry.Origin.allFinite())
  {
    throw Error(ErrorCode::InvalidGeometry,
      name +
        " has a direction matrix that cannot be inverted, or an origin that is not finite; correct "
        "them");
  }
}

/// Throws Error, naming the image by `name`, unless it has voxels on a proper grid.
inline void RequireVoxels(const ImageGeometry& geometry, const std::string& name)
{
  if (geometry.NumberOfVoxels() == 0)
  {
    throw Error(ErrorCode::InvalidGeometry, name + " has no voxels; give one that has");
  }
  RequireProperGrid(geometry, name);
}

/// Throws Error, saying what differs between the two named so, unless the grids have the same
/// dimensions and each voxel lies within a hundredth of a voxel of its counterpart.
void RequireSameGeometry(const ImageGeometry& one, const ImageGeometry& other,
  const std::string& nameOfOne, const std::string& nameOfOther);

} // namespace FlipFree

#endif

/**
 * Where the voxels of a NIfTI file lie.
 */
#ifndef FlipFreeNiftiOrientation_h
#define FlipFreeNiftiOrientation_h

#include "Exchange/NiftiFields.h"
#include "Exchange/VolumeFileHeader.h"

#include <array>
#include <string>
#include <vector>

namespace FlipFree
{

/// Right, anterior, superior to left, posterior, superior, and back.
inline const Eigen::Vector3d MirroredAxes(-1, -1, 1);

/// The grid in LPS millimeters, and warnings of what was taken in its place where the file does not
/// say it, or says it twice.
ImageGeometry NiftiGrid(const std::string& name, const NiftiFields& fields,
  const std::array<int, 3>& size, std::vector<std::string>& warnings);

/// The greatest distance between the places that two grids of the same size give to a voxel. It is
/// reached in a corner.
double GreatestShift(const ImageGeometry& one, const ImageGeometry& other);

/// b, c and d of the quaternion of a rotation, the first part being positive.
Eigen::Vector3d QuaternionOf(const Eigen::Matrix3d& rotation);

/// The rotation; a part that rounding has made longer than 1 is of length 1.
Eigen::Matrix3d RotationOf(const Eigen::Vector3d& quaternion);

} // namespace FlipFree

#endif

/**
 * Where the indices of a grid are in space, and which of them single precision can hold there.
 */
#ifndef FlipFreeGridFrame_h
#define FlipFreeGridFrame_h

#include "KernelTypes.h"

namespace FlipFree
{

class GridFrame
{
public:
  /// Of a grid that begins at the voxel `first` of the image. Throws Error where single precision
  /// is too coarse for the voxels.
  GridFrame(const ImageGeometry& image, const std::array<int, 3>& first);

  /// The nearest position that single precision holds, in millimeters.
  Eigen::Vector3d RoundedPoint(const Eigen::Vector3d& index) const;
  /// The same as indices.
  Eigen::Vector3d Rounded(const Eigen::Vector3d& index) const
  {
    return this->Inverse * (this->RoundedPoint(index) - this->Origin);
  }
  /// The length of a vector of indices, in millimeters.
  double LengthOf(const Eigen::Vector3d& vector) const { return (this->Axes * vector).norm(); }
  bool IsLeftHanded() const { return this->Axes.determinant() < 0; }

private:
  Eigen::Vector3d Origin;
  Eigen::Matrix3d Axes; // columns are steps of a voxel
  Eigen::Matrix3d Inverse;
};

} // namespace FlipFree

#endif

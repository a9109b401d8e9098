/**
 * A box of voxels of a grid: what it covers of the grid, and how it is widened, joined and cropped.
 */
#ifndef FlipFreeVoxelBox_h
#define FlipFreeVoxelBox_h

#include "KernelTypes.h"

#include <algorithm>
#include <array>

namespace FlipFree
{

/// The first voxel on each axis, and the one behind the last.
struct VoxelBox
{
  std::array<int, 3> Begin{ { 0, 0, 0 } };
  std::array<int, 3> End{ { 0, 0, 0 } };

  int Size(int axis) const { return this->End[axis] - this->Begin[axis]; }
  bool IsEmpty() const { return this->Size(0) <= 0 || this->Size(1) <= 0 || this->Size(2) <= 0; }
  bool Holds(const VoxelBox& other) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && this->Begin[axis] <= other.Begin[axis] && other.End[axis] <= this->End[axis];
    }
    return holds || other.IsEmpty();
  }
  /// Some voxels more on either side of each axis, but none beyond the limits.
  VoxelBox Widened(const std::array<int, 3>& voxels, const VoxelBox& limits) const
  {
    VoxelBox result;
    for (int axis = 0; axis < 3; ++axis)
    {
      result.Begin[axis] = std::max(limits.Begin[axis], this->Begin[axis] - voxels[axis]);
      result.End[axis] = std::min(limits.End[axis], this->End[axis] + voxels[axis]);
    }
    return result;
  }
  /// The part of it within the limits; empty if there is none.
  VoxelBox Cropped(const VoxelBox& limits) const { return this->Widened({ { 0, 0, 0 } }, limits); }
  /// The smallest box that holds both.
  VoxelBox Joined(const VoxelBox& other) const
  {
    if (this->IsEmpty() || other.IsEmpty())
    {
      return this->IsEmpty() ? other : *this;
    }
    VoxelBox result;
    for (int axis = 0; axis < 3; ++axis)
    {
      result.Begin[axis] = std::min(this->Begin[axis], other.Begin[axis]);
      result.End[axis] = std::max(this->End[axis], other.End[axis]);
    }
    return result;
  }
  friend bool operator==(const VoxelBox& a, const VoxelBox& b)
  {
    return a.Begin == b.Begin && a.End == b.End;
  }
};

/// All voxels of the grid.
inline VoxelBox WholeBox(const ImageGeometry& geometry)
{
  return { { { 0, 0, 0 } }, geometry.Dimensions };
}

/// The voxels of the grid within `reach` millimeters of a point, whatever the angles between the
/// grid's axes. Never empty: for a point outside, the voxels at the rim next to it.
VoxelBox BoxAround(const ImageGeometry& geometry, const Eigen::Vector3d& point, double reach);

/// The smallest box that holds those around all of the points.
VoxelBox BoxAroundPoints(const ImageGeometry& geometry, const PointList& points, double reach);

/// A box with the voxels of the grid within `length` millimeters of it, whatever the angles between
/// the grid's axes, and some more on each side.
VoxelBox WidenedBy(const VoxelBox& box, double length, int more, const ImageGeometry& geometry);

/// The voxel whose center is nearest to a point.
std::array<int, 3> NearestVoxel(const ImageGeometry& geometry, const Eigen::Vector3d& point);

/// The geometry of a part of the grid.
ImageGeometry CropGeometry(const ImageGeometry& geometry, const VoxelBox& box);

} // namespace FlipFree

#endif

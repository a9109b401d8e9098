/**
 * Exact traversal of the voxels along a line: every voxel that the line touches, in order, none
 * twice (J. Amanatides, A. Woo: A fast voxel traversal algorithm for ray tracing, Eurographics
 * 1987). The traversal is done in index space, so any spacing and any direction matrix will do.
 */
#ifndef FlipFreeVoxelTraversal_h
#define FlipFreeVoxelTraversal_h

#include "KernelTypes.h"

#include <cmath>
#include <limits>

namespace FlipFree
{

/// A geometry with its inverse, computed once for many lines.
struct VoxelGrid
{
  explicit VoxelGrid(const ImageGeometry& geometry)
    : Geometry(geometry)
    , PhysicalToIndex((geometry.Direction * geometry.Spacing.asDiagonal()).inverse())
  {
  }

  Eigen::Vector3d ToIndex(const Eigen::Vector3d& point) const
  {
    return this->PhysicalToIndex * (point - this->Geometry.Origin);
  }

  ImageGeometry Geometry;
  Eigen::Matrix3d PhysicalToIndex;
};

class VoxelTraversal
{
public:
  /// Starts in the voxel that contains `start`; `direction` is a unit vector in physical space.
  VoxelTraversal(const VoxelGrid& grid, const Eigen::Vector3d& start,
    const Eigen::Vector3d& direction)
    : Dimensions(grid.Geometry.Dimensions)
  {
    const Eigen::Vector3d index = grid.ToIndex(start);
    const Eigen::Vector3d slope = grid.PhysicalToIndex * direction;
    for (int axis = 0; axis < 3; ++axis)
    {
      // Far outside the image an int would overflow; no line from there reaches the image anyway.
      const double cell = std::floor(index[axis] + 0.5);
      this->Voxel[axis] = static_cast<int>(std::max(-1e9, std::min(1e9, cell)));
      this->Sign[axis] = slope[axis] > 0 ? 1 : -1;
      if (slope[axis] == 0)
      {
        this->StepLength[axis] = std::numeric_limits<double>::infinity();
        this->NextFace[axis] = std::numeric_limits<double>::infinity();
      }
      else
      {
        this->StepLength[axis] = 1 / std::abs(slope[axis]);
        const double face = this->Voxel[axis] + 0.5 * this->Sign[axis];
        this->NextFace[axis] = (face - index[axis]) / slope[axis];
      }
    }
  }

  /// The current voxel.
  const std::array<int, 3>& GetVoxel() const { return this->Voxel; }

  bool IsInside() const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->Voxel[axis] < 0 || this->Voxel[axis] >= this->Dimensions[axis])
      {
        return false;
      }
    }
    return true;
  }

  /// Distance from the start, in millimeters, at which the line enters and leaves the voxel.
  double GetEntry() const { return this->Entry; }
  double GetExit() const
  {
    return std::min(this->NextFace[0], std::min(this->NextFace[1], this->NextFace[2]));
  }

  void Advance()
  {
    int axis = this->NextFace[1] < this->NextFace[0] ? 1 : 0;
    axis = this->NextFace[2] < this->NextFace[axis] ? 2 : axis;
    this->Entry = this->NextFace[axis];
    this->NextFace[axis] += this->StepLength[axis];
    this->Voxel[axis] += this->Sign[axis];
  }

private:
  std::array<int, 3> Dimensions;
  std::array<int, 3> Voxel{};
  std::array<int, 3> Sign{};
  std::array<double, 3> StepLength{};
  std::array<double, 3> NextFace{};
  double Entry = 0;
};

} // namespace FlipFree

#endif

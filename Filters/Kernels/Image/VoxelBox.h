/**
 * A box of voxels of a grid.
 */
#ifndef FlipFreeVoxelBox_h
#define FlipFreeVoxelBox_h

#include <algorithm>
#include <array>

namespace FlipFree
{

/// First and one behind the last voxel on each axis.
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
  /// So many voxels more on either side of each axis, but none beyond the limits.
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
  friend bool operator==(const VoxelBox& a, const VoxelBox& b)
  {
    return a.Begin == b.Begin && a.End == b.End;
  }
};

} // namespace FlipFree

#endif

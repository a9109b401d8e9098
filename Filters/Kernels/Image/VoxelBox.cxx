#include "Image/VoxelBox.h"

#include <cmath>

namespace FlipFree
{

VoxelBox BoxAround(const ImageGeometry& geometry, const Eigen::Vector3d& point, double reach)
{
  const Eigen::Vector3d index = geometry.ToIndex(point);
  const Eigen::Vector3d margin = geometry.IndexReach(reach);
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = geometry.Dimensions[axis] - 1.0;
    const auto inside = [last](double place)
    { return static_cast<int>(std::max(0.0, std::min(last, place))); };
    box.Begin[axis] = inside(std::floor(index[axis] - margin[axis]));
    box.End[axis] = inside(std::ceil(index[axis] + margin[axis])) + 1;
  }
  return box;
}

VoxelBox BoxAroundPoints(const ImageGeometry& geometry, const PointList& points, double reach)
{
  VoxelBox box;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    box = box.Joined(BoxAround(geometry, points.row(point).transpose(), reach));
  }
  return box;
}

VoxelBox WidenedBy(const VoxelBox& box, double length, int more, const ImageGeometry& geometry)
{
  const Eigen::Vector3d reach = geometry.IndexReach(length);
  std::array<int, 3> voxels;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxels[axis] = static_cast<int>(reach[axis]) + more;
  }
  return box.Widened(voxels, WholeBox(geometry));
}

std::array<int, 3> NearestVoxel(const ImageGeometry& geometry, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d index = geometry.ToIndex(point);
  std::array<int, 3> voxel;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = geometry.Dimensions[axis] - 1;
    voxel[axis] = static_cast<int>(std::floor(std::max(0.0, std::min(last, index[axis])) + 0.5));
  }
  return voxel;
}

ImageGeometry CropGeometry(const ImageGeometry& geometry, const VoxelBox& box)
{
  ImageGeometry result = geometry;
  result.Dimensions = { { box.Size(0), box.Size(1), box.Size(2) } };
  result.Origin = geometry.ToPhysical(Eigen::Vector3d(box.Begin[0], box.Begin[1], box.Begin[2]));
  return result;
}

} // namespace FlipFree

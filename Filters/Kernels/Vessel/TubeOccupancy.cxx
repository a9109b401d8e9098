#include "Vessel/TubeOccupancy.h"

#include "Vessel/VesselImage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

double RadiusAt(const VesselSections& sections, Eigen::Index section, double angle)
{
  const auto rays = sections.Radii.cols();
  const double place = angle / (2 * EIGEN_PI) * static_cast<double>(rays);
  const double floor = std::floor(place);
  const auto low = (static_cast<Eigen::Index>(floor) % rays + rays) % rays;
  const double part = place - floor;
  return (1 - part) * sections.Radii(section, low) +
    part * sections.Radii(section, (low + 1) % rays);
}

} // namespace

void MergeTubeDepth(const VesselSections& sections, double margin, bool openStart, bool openEnd,
  FloatImage& depth)
{
  const ImageGeometry& geometry = depth.Geometry;
  const auto count = static_cast<Eigen::Index>(sections.Frames.size());
  // Per voxel the nearest section.
  std::vector<float> distance(depth.Voxels.size(), std::numeric_limits<float>::infinity());
  std::vector<int> nearest(depth.Voxels.size(), -1);
  const double largest = sections.Radii.maxCoeff();
  for (Eigen::Index section = 0; section < count; ++section)
  {
    const Eigen::Vector3d& center = sections.Frames[section].Origin;
    const VoxelBox box = BoxAround(geometry, center, largest + margin + 2);
    for (int k = box.Begin[2]; k < box.End[2]; ++k)
    {
      for (int j = box.Begin[1]; j < box.End[1]; ++j)
      {
        for (int i = box.Begin[0]; i < box.End[0]; ++i)
        {
          const std::size_t voxel = geometry.Offset(i, j, k);
          const auto square = static_cast<float>(
            (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - center).squaredNorm());
          if (square < distance[voxel])
          {
            distance[voxel] = square;
            nearest[voxel] = static_cast<int>(section);
          }
        }
      }
    }
  }
  for (std::size_t voxel = 0; voxel < nearest.size(); ++voxel)
  {
    const Eigen::Index section = nearest[voxel];
    if (section < 0)
    {
      continue;
    }
    const Eigen::Vector3d point = geometry.ToPhysical(IndexOf(geometry, voxel));
    const SectionFrame& frame = sections.Frames[section];
    const Eigen::Vector3d offset = point - frame.Origin;
    const double along = offset.dot(frame.Tangent);
    const Eigen::Vector3d across = offset - along * frame.Tangent;
    const double angle = std::atan2(across.dot(frame.Second), across.dot(frame.First));
    double inside = RadiusAt(sections, section, angle) - across.norm();
    if (section == 0 && along < 0)
    {
      inside =
        openStart ? RadiusAt(sections, section, angle) - offset.norm() : std::min(inside, along);
    }
    if (section + 1 == count && along > 0)
    {
      inside =
        openEnd ? RadiusAt(sections, section, angle) - offset.norm() : std::min(inside, -along);
    }
    depth.Voxels[voxel] = std::max(depth.Voxels[voxel],
      static_cast<float>(std::max(-margin, std::min(margin, inside))));
  }
}

} // namespace FlipFree

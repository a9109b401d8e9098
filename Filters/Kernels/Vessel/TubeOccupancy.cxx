#include "Vessel/TubeOccupancy.h"

#include "Image/VoxelOffsets.h"
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

// The voxels of some slices by their nearest sections.
class Slab
{
public:
  Slab(const VesselSections& sections, double reach, std::ptrdiff_t first, std::ptrdiff_t last,
    const ImageGeometry& geometry)
    : Geometry(geometry)
    , Begin(geometry.Offset(0, 0, static_cast<int>(first)))
    , Nearest(geometry.Offset(0, 0, static_cast<int>(last)) - this->Begin, -1)
    , Distance(this->Nearest.size(), std::numeric_limits<float>::infinity())
  {
    for (std::size_t section = 0; section < sections.Frames.size(); ++section)
    {
      const Eigen::Vector3d& center = sections.Frames[section].Origin;
      const VoxelBox box = BoxAround(geometry, center, reach);
      for (int k = std::max(box.Begin[2], static_cast<int>(first));
           k < std::min(box.End[2], static_cast<int>(last)); ++k)
      {
        for (int j = box.Begin[1]; j < box.End[1]; ++j)
        {
          this->VisitRow(static_cast<int>(section), center, reach, j, k);
        }
      }
    }
  }

  /// Calls visit(offset, nearest section) for each voxel that has one.
  template <typename Visit>
  void ForEach(const Visit& visit) const
  {
    for (std::size_t voxel = 0; voxel < this->Nearest.size(); ++voxel)
    {
      if (this->Nearest[voxel] >= 0)
      {
        visit(this->Begin + voxel, this->Nearest[voxel]);
      }
    }
  }

private:
  // The part of a row within the reach of a section's center.
  void VisitRow(int section, const Eigen::Vector3d& center, double reach, int j, int k)
  {
    const Eigen::Vector3d begin = this->Geometry.ToPhysical(Eigen::Vector3d(0, j, k)) - center;
    const Eigen::Vector3d step = this->Geometry.Spacing[0] * this->Geometry.Direction.col(0);
    const double square = step.squaredNorm();
    const double nearest = -begin.dot(step) / square;
    const double least = (begin + nearest * step).squaredNorm();
    if (least > reach * reach)
    {
      return;
    }
    const double half = std::sqrt((reach * reach - least) / square);
    const int first = std::max(0, static_cast<int>(std::ceil(nearest - half)));
    const int last =
      std::min(this->Geometry.Dimensions[0] - 1, static_cast<int>(std::floor(nearest + half)));
    const std::size_t row = this->Geometry.Offset(0, j, k) - this->Begin;
    for (int i = first; i <= last; ++i)
    {
      const auto distance = static_cast<float>(least + square * (i - nearest) * (i - nearest));
      if (distance < this->Distance[row + i])
      {
        this->Distance[row + i] = distance;
        this->Nearest[row + i] = section;
      }
    }
  }

  const ImageGeometry& Geometry;
  std::size_t Begin;
  std::vector<int> Nearest;
  std::vector<float> Distance; // squared
};

// How far inside the tube a point is, given its nearest section.
double DepthAt(const VesselSections& sections, Eigen::Index section, bool openStart, bool openEnd,
  const Eigen::Vector3d& point)
{
  const SectionFrame& frame = sections.Frames[section];
  const Eigen::Vector3d offset = point - frame.Origin;
  const double along = offset.dot(frame.Tangent);
  const Eigen::Vector3d across = offset - along * frame.Tangent;
  const double angle = std::atan2(across.dot(frame.Second), across.dot(frame.First));
  const double radius = RadiusAt(sections, section, angle);
  double inside = radius - across.norm();
  if (section == 0 && along < 0)
  {
    inside = openStart ? radius - offset.norm() : std::min(inside, along);
  }
  if (section + 1 == static_cast<Eigen::Index>(sections.Frames.size()) && along > 0)
  {
    inside = openEnd ? radius - offset.norm() : std::min(inside, -along);
  }
  return inside;
}

} // namespace

void MergeTubeDepth(const VesselSections& sections, double margin, bool openStart, bool openEnd,
  const ParallelFor& parallelFor, FloatImage& depth)
{
  const ImageGeometry& geometry = depth.Geometry;
  const double reach = sections.Radii.maxCoeff() + margin + 2;
  parallelFor(0, geometry.Dimensions[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      Slab(sections, reach, first, last, geometry)
        .ForEach(
          [&](std::size_t voxel, int section)
          {
            const double inside =
              DepthAt(sections, section, openStart, openEnd, CenterOf(voxel, geometry));
            depth.Voxels[voxel] =
              std::max(depth.Voxels[voxel], static_cast<float>(std::max(-margin, inside)));
          });
    });
}

} // namespace FlipFree

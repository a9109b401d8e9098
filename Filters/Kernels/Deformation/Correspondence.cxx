#include "Deformation/Correspondence.h"

#include "Image/ImageInterpolation.h"
#include "Image/VoxelTraversal.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Lets a run of exactly the wanted length count in spite of rounding.
constexpr double RoundingSlack = 1 - 1e-9;

class LineSearch
{
public:
  LineSearch(const BitMask& foreground, const BitMask& noData, const ImageView<float>& edges,
    const CorrespondenceSettings& settings)
    : Foreground(foreground)
    , NoData(noData)
    , Edges(edges)
    , Settings(settings)
    , Grid(foreground.GetGeometry())
    , Step(0.5 * foreground.GetGeometry().Spacing.minCoeff())
    , Reach(static_cast<int>(std::ceil(2 * settings.EdgeWindow / this->Step)))
  {
    const double deviation = settings.EdgeWindow;
    for (int sample = -this->Reach; sample <= this->Reach; ++sample)
    {
      const double offset = sample * this->Step;
      this->Weights.push_back(std::exp(-0.5 * offset * offset / (deviation * deviation)));
    }
  }

  /// The signed distance along the normal at which the boundary lies; false if there is none.
  bool Find(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double& distance) const
  {
    const bool inside = this->IsForeground(VoxelTraversal(this->Grid, point, normal));
    if (!inside && !this->Settings.SearchInward)
    {
      // Eq. 2 read literally: the run of background begins at once.
      distance = 0;
      return this->Walk(point, normal, false, distance);
    }
    const double sign = inside ? 1 : -1;
    if (!this->Walk(point, sign * normal, !inside, distance))
    {
      return false;
    }
    distance *= sign;
    if (this->Settings.EdgeWindow > 0)
    {
      distance = this->StrongestEdge(point, normal, distance);
    }
    return true;
  }

private:
  bool IsForeground(const VoxelTraversal& walk) const
  {
    if (!walk.IsInside())
    {
      return false;
    }
    const auto& voxel = walk.GetVoxel();
    return this->Foreground(voxel[0], voxel[1], voxel[2]);
  }

  bool HasNoData(const VoxelTraversal& walk) const
  {
    if (!this->NoData.HasGrid() || !walk.IsInside())
    {
      return false;
    }
    const auto& voxel = walk.GetVoxel();
    return this->NoData(voxel[0], voxel[1], voxel[2]);
  }

  bool EndsAtImage(double distance) const
  {
    return this->Settings.ImageBoundaryDistance > 0 &&
      distance <= this->Settings.ImageBoundaryDistance;
  }

  // Walks to the first run of voxels that are foreground (or not, as `wanted` says) and gives the
  // distance at which the line enters it.
  bool Walk(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, bool wanted,
    double& distance) const
  {
    int run = 0;
    double entry = 0;
    bool beginsWithoutData = false; // the run
    VoxelTraversal walk(this->Grid, point, direction);
    for (; walk.GetEntry() <= this->Settings.SearchDistance; walk.Advance())
    {
      // An outward search ends where the image ends; an inward one may begin outside.
      if (!wanted && !walk.IsInside())
      {
        distance = run > 0 ? entry : walk.GetEntry();
        return this->EndsAtImage(distance);
      }
      if (this->IsForeground(walk) != wanted)
      {
        run = 0;
        continue;
      }
      if (run == 0)
      {
        entry = walk.GetEntry();
        beginsWithoutData = this->HasNoData(walk);
      }
      ++run;
      const bool complete = this->Settings.RunLength > 0
        ? walk.GetExit() - entry >= RoundingSlack * this->Settings.RunLength
        : run >= this->Settings.RunVoxels;
      if (complete)
      {
        distance = entry;
        return !beginsWithoutData || this->EndsAtImage(distance);
      }
    }
    return false;
  }

  // The steepest outward fall of the intensities along the line, weighted by a Gaussian around the
  // crossing.
  double StrongestEdge(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
    double crossing) const
  {
    double best = 0;
    double bestOffset = 0;
    double before = this->Edge(point + (crossing - (this->Reach + 0.5) * this->Step) * normal);
    for (int sample = -this->Reach; sample <= this->Reach; ++sample)
    {
      const double offset = sample * this->Step;
      const double after = this->Edge(point + (crossing + offset + 0.5 * this->Step) * normal);
      const double strength = this->Weights[sample + this->Reach] * (before - after);
      if (strength > best)
      {
        best = strength;
        bestOffset = offset;
      }
      before = after;
    }
    return crossing + bestOffset;
  }

  double Edge(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d index = this->Grid.ToIndex(point);
    if (this->Settings.Ramp.Width > 0)
    {
      return InterpolateClamped(this->Edges, index, this->Settings.Ramp);
    }
    return InterpolateClamped(this->Edges, index);
  }

  const BitMask& Foreground;
  const BitMask& NoData;
  const ImageView<float>& Edges;
  const CorrespondenceSettings& Settings;
  VoxelGrid Grid;
  double Step;                 // of samples around the crossing
  int Reach;                   // in steps
  std::vector<double> Weights; // of the samples
};

} // namespace

CorrespondenceField FindCorrespondences(const Eigen::Ref<const PointList>& points,
  const PointList& normals, const BitMask& foreground, const BitMask& noData,
  const ImageView<float>& edges, const CorrespondenceSettings& settings,
  const ParallelFor& parallelFor)
{
  CorrespondenceField field;
  field.Displacements = PointList::Zero(points.rows(), 3);
  field.States.assign(points.rows(), VertexState::Solitary);
  const LineSearch search(foreground, noData, edges, settings);
  parallelFor(0, points.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t vertex = first; vertex < last; ++vertex)
      {
        const Eigen::Vector3d normal = normals.row(vertex);
        double distance = 0;
        if (search.Find(points.row(vertex), normal, distance))
        {
          field.Displacements.row(vertex) = distance * normal;
          field.States[vertex] = VertexState::Matched;
        }
      }
    });
  return field;
}

} // namespace FlipFree

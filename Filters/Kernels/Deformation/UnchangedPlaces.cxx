#include "Deformation/UnchangedPlaces.h"

#include "Geometry/WindingNumber.h"
#include "Image/DistanceTransform.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// Nearer to a change, in millimeters, all may move.
constexpr double ChangeMargin = 6;

// The guard may let vertices go only part of the way.
constexpr int MaximumSteps = 4;
constexpr double Negligible = 1e-3; // millimeters

// What is no farther from the deep of a part than this part of the depth belongs to it.
constexpr double PartOfDepth = 1.25;

// Keeps the voxels that are farther than a distance from all of another set, or those that are not.
// False if the monitor stopped it.
bool KeepByDistance(const BitMask& other, double distance, bool isFarther,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  const std::vector<float> squared = SquaredDistance(other, true, parallelFor, monitor);
  if (squared.empty())
  {
    return false;
  }
  const ImageGeometry& geometry = mask.GetGeometry();
  BitMask kept(geometry);
  mask.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      for (int i = begin; i < end; ++i)
      {
        if ((squared[geometry.Offset(i, j, k)] > distance * distance) == isFarther)
        {
          kept.Insert(i, j, k);
        }
      }
    });
  mask = std::move(kept);
  return true;
}

} // namespace

bool FindDeepChange(const BitMask& before, const BitMask& after, double depth,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& deep)
{
  const BitMask changed = DifferenceOf(before, after);
  deep = BitMask(changed.GetGeometry());
  if (changed.Bounds().IsEmpty())
  {
    return true;
  }
  const VoxelBox box = WidenedBy(changed.Bounds(), depth, 1, changed.GetGeometry());
  BitMask same = before.Cropped(box);
  same.Intersect(after.Cropped(box));
  BitMask far = changed.Cropped(box);
  if (!KeepByDistance(same, depth, true, parallelFor, monitor, far))
  {
    return false;
  }
  std::vector<std::size_t> source;
  far.ForEach([&source](std::size_t voxel) { source.push_back(voxel); });
  if (source.empty())
  {
    return true;
  }
  // A sheet that is connected to a deep part does not belong to it: it may go all around an organ.
  BitMask part = changed.Cropped(box);
  if (!KeepByDistance(far, PartOfDepth * depth, false, parallelFor, monitor, part) ||
    !KeepConnected(part, source, monitor))
  {
    return false;
  }
  deep.Insert(part, box.Begin);
  return true;
}

UnchangedPlaces::UnchangedPlaces(BitMask changed, const ConstraintList& constraints)
  : Changed(std::move(changed))
  , Bounds(this->Changed.Bounds())
  , Constraints(constraints)
{
}

double UnchangedPlaces::WeightAt(const Eigen::Vector3d& place) const
{
  double least = ChangeReach;
  for (const PointConstraint& constraint : this->Constraints)
  {
    least = std::min(least, (constraint.Point - place).norm() - constraint.Radius);
  }
  const ImageGeometry& geometry = this->Changed.GetGeometry();
  const VoxelBox box = BoxAround(geometry, place, std::max(0.0, least)).Cropped(this->Bounds);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        if (this->Changed(i, j, k))
        {
          least = std::min(least, (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - place).norm());
        }
      }
    }
  }
  const double part = std::max(0.0, (least - ChangeMargin) / (ChangeReach - ChangeMargin));
  return part * part * (3 - 2 * part);
}

Eigen::VectorXd UnchangedPlaces::WeightsOf(const PointList& points,
  const ParallelFor& parallelFor) const
{
  Eigen::VectorXd weights(points.rows());
  parallelFor(0, points.rows(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t point = first; point < last; ++point)
      {
        weights[point] = this->WeightAt(points.row(point).transpose());
      }
    });
  return weights;
}

bool Attract(const DeformableSurface& surface, const Eigen::VectorXd& weights,
  const PointList& obstacles, const GuardedStep& step, const ParallelFor& parallelFor,
  const Monitor& monitor, PointList& points)
{
  const PointList places =
    ClosestPlaces(surface.Points, surface.Mesh.Triangles, points, parallelFor);
  const PointList targets = points + weights.asDiagonal() * (places - points);
  for (int round = 0; round < MaximumSteps; ++round)
  {
    PointList motion = targets - points;
    if (motion.rowwise().norm().maxCoeff() < Negligible)
    {
      break;
    }
    if (!monitor(static_cast<double>(round) / MaximumSteps))
    {
      return false;
    }
    points = step(obstacles, points, motion);
  }
  return true;
}

} // namespace FlipFree

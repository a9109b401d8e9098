#include "Deformation/UnchangedPlaces.h"

#include "Geometry/WindingNumber.h"
#include "Image/DistanceTransform.h"
#include "Image/SeedRegion.h"
#include "Image/VoxelOffsets.h"
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

// Until none is near another.
std::vector<BitMask> UniteNear(std::vector<BitMask> parts)
{
  std::vector<BitMask> apart;
  while (!parts.empty())
  {
    BitMask part = std::move(parts.back());
    parts.pop_back();
    const VoxelBox box =
      WidenedBy(part.Bounds(), 2 * UnchangedPlaces::ChangeReach, 1, part.GetGeometry());
    const auto near = std::find_if(apart.begin(), apart.end(),
      [&](const BitMask& other) { return !box.Cropped(other.Bounds()).IsEmpty(); });
    if (near == apart.end())
    {
      apart.push_back(std::move(part));
      continue;
    }
    part.Unite(*near);
    apart.erase(near);
    parts.push_back(std::move(part));
  }
  return apart;
}

} // namespace

bool FindDeepParts(const BitMask& before, const BitMask& after, double depth,
  const ParallelFor& parallelFor, const Monitor& monitor, std::vector<BitMask>& deep)
{
  deep.clear();
  const BitMask changed = DifferenceOf(before, after);
  const ImageGeometry& whole = changed.GetGeometry();
  if (changed.Bounds().IsEmpty())
  {
    return true;
  }
  const VoxelBox box = WidenedBy(changed.Bounds(), depth, 1, whole);
  BitMask same = before.Cropped(box);
  same.Intersect(after.Cropped(box));
  const ImageGeometry& geometry = same.GetGeometry();
  const std::vector<float> squared =
    SquaredDistance(BytesOf(same), geometry, 1, parallelFor, monitor);
  if (squared.empty())
  {
    return false;
  }
  // What hangs on a deep part as a sheet is none: a sheet may go all around an organ.
  const BitMask all = changed.Cropped(box);
  std::vector<std::size_t> far;
  std::vector<unsigned char> isFar(squared.size(), 0);
  all.ForEach(
    [&](std::size_t voxel)
    {
      if (squared[voxel] > depth * depth)
      {
        far.push_back(voxel);
        isFar[voxel] = 1;
      }
    });
  if (far.empty())
  {
    return true;
  }
  const std::vector<float> toFar = SquaredDistance(isFar, geometry, 1, parallelFor, monitor);
  if (toFar.empty())
  {
    return false;
  }
  const double reach = PartOfDepth * depth;
  BitMask candidates(geometry);
  all.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      for (int i = begin; i < end; ++i)
      {
        if (toFar[geometry.Offset(i, j, k)] <= reach * reach)
        {
          candidates.Insert(i, j, k);
        }
      }
    });
  std::vector<BitMask> parts;
  BitMask found(geometry);
  for (const std::size_t voxel : far)
  {
    const std::array<int, 3> index = IndexOf(voxel, geometry);
    if (found(index[0], index[1], index[2]))
    {
      continue;
    }
    BitMask part = candidates;
    if (!KeepConnected(part, { voxel }, monitor))
    {
      return false;
    }
    found.Unite(part);
    parts.push_back(std::move(part));
  }
  for (BitMask& part : UniteNear(std::move(parts)))
  {
    deep.emplace_back(whole);
    deep.back().Insert(part, box.Begin);
  }
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

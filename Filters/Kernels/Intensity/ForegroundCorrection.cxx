#include "Intensity/ForegroundCorrection.h"

#include "Intensity/BoundaryShift.h"
#include "Intensity/CorrectionCut.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// What is looked at around a point to see how far it looks alike, in millimeters.
constexpr double GreatestReachInside = 40;
constexpr double GreatestReachOutside = 20;
constexpr double LeastNeighborhood = 5;

// The radius of what leads to a point that nothing else connects with the seed, in millimeters.
constexpr double BridgeRadius = 3;

// A correction is certain around its point by a little more than a voxel, but where slices are
// thick by no more than so many millimeters, or than its distance from the right side.
constexpr double CertainVoxels = 1.01;
constexpr double CertainBall = 3;

struct NearestPlace
{
  double Distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d Center = Eigen::Vector3d::Zero(); ///< of the voxel
};

// The voxel of a mask nearest to a point, as far as whole rows tell; none in an empty mask.
NearestPlace NearestIn(const BitMask& mask, const Eigen::Vector3d& point)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  const double place = geometry.ToIndex(point)[0];
  NearestPlace nearest;
  mask.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const double i = std::round(std::max<double>(begin, std::min(place, end - 1.0)));
      const Eigen::Vector3d center = geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      const double distance = (center - point).norm();
      if (distance < nearest.Distance)
      {
        nearest = { distance, center };
      }
    });
  return nearest;
}

// The distance from a point to the nearest voxel center on a side of the mask.
double DistanceTo(const BitMask& mask, bool side, const Eigen::Vector3d& point)
{
  if (side)
  {
    return NearestIn(mask, point).Distance;
  }
  BitMask other = mask;
  other.Complement();
  return NearestIn(other, point).Distance;
}

// The voxels within a distance of a point, and the point's own.
void SetBall(BitMask& mask, bool inside, const Eigen::Vector3d& point, double radius)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  const std::array<int, 3> own = NearestVoxel(geometry, point);
  mask.SetRun(inside, own[0], own[0] + 1, own[1], own[2]);
  const VoxelBox box = BoxAround(geometry, point, radius);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm() <= radius)
        {
          mask.SetRun(inside, i, i + 1, j, k);
        }
      }
    }
  }
}

// Leads from a point to the nearest voxel of the part that holds the seed.
void SetBridge(const BitMask& part, const Eigen::Vector3d& point, double radius, BitMask& mask)
{
  const NearestPlace nearest = NearestIn(part, point);
  if (!std::isfinite(nearest.Distance))
  {
    return;
  }
  const int steps = std::max(1,
    static_cast<int>(std::ceil(nearest.Distance / mask.GetGeometry().Spacing.minCoeff())));
  for (int step = 0; step <= steps; ++step)
  {
    const double along = static_cast<double>(step) / steps;
    SetBall(mask, true, point + along * (nearest.Center - point), radius);
  }
}

bool IsOnSide(const PointConstraint& constraint)
{
  return constraint.Kind != ConstraintKind::Boundary;
}

bool IsInside(const PointConstraint& constraint)
{
  return constraint.Kind == ConstraintKind::Inside || constraint.Kind == ConstraintKind::Seed;
}

bool IsObeyed(const PointConstraint& constraint, const BitMask& mask)
{
  const auto voxel = NearestVoxel(mask.GetGeometry(), constraint.Point);
  return !IsOnSide(constraint) || mask(voxel[0], voxel[1], voxel[2]) == IsInside(constraint);
}

// What is certain around a point.
double BallOf(const PointConstraint& constraint, const ImageGeometry& geometry)
{
  const double least = std::max(CertainBall, CertainVoxels * geometry.Spacing.minCoeff());
  return std::max(constraint.Radius, std::min(least, CertainVoxels * geometry.Spacing.maxCoeff()));
}

// Where balls overlap, those outside count, but for the points' own voxels.
void SetBalls(const ConstraintList& constraints, const SeedSphere& seed, BitMask& mask)
{
  SetBall(mask, true, seed.Center, seed.Radius);
  for (const bool inside : { true, false })
  {
    for (const PointConstraint& constraint : constraints)
    {
      if (IsOnSide(constraint) && IsInside(constraint) == inside)
      {
        SetBall(mask, inside, constraint.Point, BallOf(constraint, mask.GetGeometry()));
      }
    }
  }
  for (const PointConstraint& constraint : constraints)
  {
    if (IsOnSide(constraint))
    {
      SetBall(mask, IsInside(constraint), constraint.Point, 0);
    }
  }
}

class ForegroundCorrector
{
public:
  ForegroundCorrector(const ImageView<float>& smooth, const ImageMaker& make,
    const SeedSphere& seed, const ConstraintList& constraints, double noise, Modality modality,
    const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground)
    : Smooth(smooth)
    , Make(make)
    , Seed(seed)
    , Constraints(SortedConstraints(constraints))
    , Noise(noise)
    , Kind(modality)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Foreground(foreground)
  {
  }

  bool Execute()
  {
    this->Corrected[1].push_back(this->Seed);
    ConstraintList open = this->Constraints;
    while (true)
    {
      const auto [next, away] = this->FarthestOnWrongSide(open);
      if (next == open.end())
      {
        break;
      }
      if (!this->Correct(*next, away))
      {
        return false;
      }
      open.erase(next);
    }
    SetBalls(this->Constraints, this->Seed, this->Foreground);
    if (!FillHoles(this->Foreground, this->Ask))
    {
      return false;
    }
    SetBalls(this->Constraints, this->Seed, this->Foreground);
    return this->Connect();
  }

private:
  std::pair<ConstraintList::iterator, double> FarthestOnWrongSide(ConstraintList& open) const
  {
    auto next = open.end();
    double farthest = -1;
    for (auto constraint = open.begin(); constraint != open.end(); ++constraint)
    {
      if (!IsObeyed(*constraint, this->Foreground))
      {
        const double away = DistanceTo(this->Foreground, IsInside(*constraint), constraint->Point);
        if (away > farthest)
        {
          farthest = away;
          next = constraint;
        }
      }
    }
    return { next, farthest };
  }

  bool Correct(const PointConstraint& constraint, double away)
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    Correction correction;
    correction.Point = constraint.Point;
    correction.IsInside = IsInside(constraint);
    correction.Away = away;
    correction.Kept = this->Corrected[correction.IsInside ? 0 : 1];
    const double limit =
      std::min(away, correction.IsInside ? GreatestReachInside : GreatestReachOutside);
    if (!this->Make(BoxAround(geometry, constraint.Point, std::max(limit, LeastNeighborhood))))
    {
      return false;
    }
    correction.Reach = std::max({ GrayValueSimilarity(this->Noise, this->Kind)
                                    .ReachOfLikeness(this->Smooth, constraint.Point, limit),
      std::min(geometry.Spacing.maxCoeff(), std::max(away, CertainBall)), constraint.Radius });
    const VoxelBox box = this->BoxOf(correction);
    if (!this->Make(box))
    {
      return false;
    }
    const ImagePart image{ this->Smooth, box.Begin };
    const BitMask before = this->Foreground.Cropped(box);
    BitMask part = before;
    if (!CutCorrection(image, this->Seed, correction, this->Noise, this->Kind, this->Parallel,
          this->Ask, part) ||
      !ShiftBoundary(image, correction, this->Noise, this->Kind, this->Parallel, this->Ask, before,
        part))
    {
      return false;
    }
    this->Replace(part, box);
    this->Corrected[correction.IsInside ? 1 : 0].push_back({ constraint.Point, correction.Reach });
    return true;
  }

  VoxelBox BoxOf(const Correction& correction) const
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    const VoxelBox seed = BoxAround(geometry, this->Seed.Center, this->Seed.Radius);
    if (correction.IsInside)
    {
      return BoxAround(geometry, correction.Point, DomainOf(correction)).Joined(seed);
    }
    return this->Foreground.Bounds()
      .Widened({ { 1, 1, 1 } }, WholeBox(geometry))
      .Joined(BoxAround(geometry, correction.Point, LeastNeighborhood))
      .Joined(seed);
  }

  void Replace(const BitMask& part, const VoxelBox& box)
  {
    for (int k = box.Begin[2]; k < box.End[2]; ++k)
    {
      for (int j = box.Begin[1]; j < box.End[1]; ++j)
      {
        this->Foreground.RemoveRun(box.Begin[0], box.End[0], j, k);
      }
    }
    this->Foreground.Insert(part, box.Begin);
  }

  // Keeps what is connected with the seed, and connects the inside points.
  bool Connect()
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    const std::vector<std::size_t> source = VoxelsInSphere(geometry, this->Seed);
    if (source.empty())
    {
      return true;
    }
    BitMask part = this->Foreground;
    if (!KeepConnected(part, source, this->Ask))
    {
      return false;
    }
    bool isWhole = true;
    for (const PointConstraint& constraint : this->Constraints)
    {
      if (IsInside(constraint) && !IsObeyed(constraint, part))
      {
        SetBridge(part, constraint.Point, std::max(BridgeRadius, BallOf(constraint, geometry)),
          this->Foreground);
        isWhole = false;
      }
    }
    if (isWhole)
    {
      this->Foreground = std::move(part);
      return true;
    }
    SetBalls(this->Constraints, this->Seed, this->Foreground);
    return KeepConnected(this->Foreground, source, this->Ask);
  }

  const ImageView<float> Smooth;
  const ImageMaker& Make;
  const SeedSphere& Seed;
  const ConstraintList Constraints;
  const double Noise;
  const Modality Kind;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Foreground;
  // By side: what later corrections must not undo.
  std::vector<SeedSphere> Corrected[2];
};

} // namespace

bool CorrectForeground(const ImageView<float>& smooth, const ImageMaker& make,
  const SeedSphere& seed, const ConstraintList& constraints, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground)
{
  return ForegroundCorrector(smooth, make, seed, constraints, noise, modality, parallelFor, monitor,
    foreground)
    .Execute();
}

} // namespace FlipFree

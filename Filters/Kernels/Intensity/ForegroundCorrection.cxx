#include "Intensity/ForegroundCorrection.h"

#include "Intensity/BoundaryShift.h"
#include "Intensity/CorrectionCut.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace FlipFree
{
namespace
{

// What is looked at around a point to see how far it looks alike, in millimeters.
constexpr double GreatestReachInside = 40;
constexpr double GreatestReachOutside = 20;
constexpr double LeastNeighborhood = 5;

// Radius (mm) of the bridge to a point not otherwise connected to the seed.
constexpr double BridgeRadius = 3;

// A correction is certain around its point by a little more than a voxel, but where slices are
// thick by no more than this many millimeters, or than its distance from the right side.
constexpr double CertainVoxels = 1.01;
constexpr double CertainBall = 3;

// What a point changes is connected to what lies within this many millimeters of it, or within
// this many times its distance from the right side.
constexpr double LeastDomain = 30;
constexpr double DomainInAway = 2;

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
  ForegroundCorrector(const ForegroundImage& image, const SeedSphere& seed,
    const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
    BitMask& foreground)
    : Given(image)
    , Seed(seed)
    , Constraints(SortedConstraints(constraints))
    , Parallel(parallelFor)
    , Ask(monitor)
    , Foreground(foreground)
  {
  }

  bool Execute()
  {
    const BitMask before = this->Foreground;
    std::optional<BitMask> mayChange; // all
    this->Corrected[1].push_back(this->Seed);
    ConstraintList open = this->Constraints;
    while (true)
    {
      const auto wrong = std::stable_partition(open.begin(), open.end(),
        [this](const PointConstraint& constraint)
        { return IsObeyed(constraint, this->Foreground); });
      if (wrong == open.end())
      {
        break;
      }
      if (!this->Correct({ wrong, open.end() }, mayChange))
      {
        return false;
      }
      open.erase(wrong, open.end());
      // A point that was on the right side takes back what others have changed, nothing else.
      mayChange = DifferenceOf(before, this->Foreground);
    }
    SetBalls(this->Constraints, this->Seed, this->Foreground);
    if (!FillHoles(this->Foreground, this->Ask))
    {
      return false;
    }
    SetBalls(this->Constraints, this->Seed, this->Foreground);
    return this->Connect() && this->Restore(before);
  }

private:
  // Undoes what is not connected to a point's domain, such as holes that have been filled
  // elsewhere.
  bool Restore(const BitMask& before)
  {
    BitMask changed = DifferenceOf(before, this->Foreground);
    const ImageGeometry& geometry = before.GetGeometry();
    std::vector<std::size_t> sources;
    for (const PointConstraint& constraint : this->Constraints)
    {
      if (!IsOnSide(constraint))
      {
        continue;
      }
      const double domain = std::max({ LeastDomain, constraint.Radius,
        IsObeyed(constraint, before)
          ? 0.0
          : DomainInAway * DistanceTo(before, IsInside(constraint), constraint.Point) });
      const VoxelBox box = BoxAround(geometry, constraint.Point, domain);
      changed.Cropped(box).ForEachRun(0, box.Size(2),
        [&](int begin, int end, int j, int k)
        {
          for (int i = box.Begin[0] + begin; i < box.Begin[0] + end; ++i)
          {
            const Eigen::Vector3d place =
              geometry.ToPhysical(Eigen::Vector3d(i, box.Begin[1] + j, box.Begin[2] + k));
            if ((place - constraint.Point).norm() <= domain)
            {
              sources.push_back(geometry.Offset(i, box.Begin[1] + j, box.Begin[2] + k));
            }
          }
        });
    }
    BitMask kept = changed;
    if (!KeepConnected(kept, sources, this->Ask))
    {
      return false;
    }
    changed.Remove(kept);
    BitMask undone = before;
    undone.Intersect(changed);
    this->Foreground.Remove(changed);
    this->Foreground.Unite(undone);
    return true;
  }

  // Each by itself, from the same foreground: what one adds or removes does not depend on others of
  // its kind, so a further point never takes back what an earlier one has mended.
  bool Correct(const ConstraintList& wrong, const std::optional<BitMask>& mayChange)
  {
    std::vector<Correction> corrections(wrong.size());
    for (std::size_t number = 0; number < wrong.size(); ++number)
    {
      if (!this->Prepare(wrong[number], corrections[number]))
      {
        return false;
      }
    }
    for (const Correction& correction : corrections)
    {
      this->Corrected[correction.IsInside ? 1 : 0].push_back(
        { correction.Point, correction.Reach });
    }
    const BitMask before = this->Foreground;
    for (Correction& correction : corrections)
    {
      correction.Kept = this->Corrected[correction.IsInside ? 0 : 1];
      if (!this->Cut(correction, before, mayChange))
      {
        return false;
      }
    }
    return true;
  }

  bool Prepare(const PointConstraint& constraint, Correction& correction) const
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    correction.Point = constraint.Point;
    correction.IsInside = IsInside(constraint);
    correction.Away = DistanceTo(this->Foreground, correction.IsInside, constraint.Point);
    const double limit =
      std::min(correction.Away, correction.IsInside ? GreatestReachInside : GreatestReachOutside);
    if (!this->Given.Make(
          BoxAround(geometry, constraint.Point, std::max(limit, LeastNeighborhood))))
    {
      return false;
    }
    correction.Reach = std::max({ GrayValueSimilarity(this->Given.Noise, this->Given.Kind)
                                    .ReachOfLikeness(this->Given.Smooth, constraint.Point, limit),
      std::min(geometry.Spacing.maxCoeff(), std::max(correction.Away, CertainBall)),
      constraint.Radius });
    return true;
  }

  bool Cut(const Correction& correction, const BitMask& whole,
    const std::optional<BitMask>& mayChange)
  {
    const VoxelBox box = this->BoxOf(correction, whole);
    if (!this->Given.Make(box))
    {
      return false;
    }
    const ImagePart image{ this->Given.Smooth, box.Begin };
    const BitMask before = whole.Cropped(box);
    BitMask part = before;
    if (!CutCorrection(image, this->Seed, correction, this->Given.Noise, this->Given.Kind,
          this->Parallel, this->Ask, part) ||
      !ShiftBoundary(image, correction, this->Given.Noise, this->Given.Kind, this->Parallel,
        this->Ask, before, part))
    {
      return false;
    }
    BitMask changed(whole.GetGeometry());
    changed.Insert(DifferenceOf(before, part), box.Begin);
    if (mayChange)
    {
      changed.Intersect(*mayChange);
    }
    if (correction.IsInside)
    {
      this->Foreground.Unite(changed);
    }
    else
    {
      this->Foreground.Remove(changed);
    }
    return true;
  }

  VoxelBox BoxOf(const Correction& correction, const BitMask& whole) const
  {
    const ImageGeometry& geometry = whole.GetGeometry();
    const VoxelBox seed = BoxAround(geometry, this->Seed.Center, this->Seed.Radius);
    if (correction.IsInside)
    {
      return BoxAround(geometry, correction.Point, DomainOf(correction)).Joined(seed);
    }
    return whole.Bounds()
      .Widened({ { 1, 1, 1 } }, WholeBox(geometry))
      .Joined(BoxAround(geometry, correction.Point, LeastNeighborhood))
      .Joined(seed);
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

  const ForegroundImage& Given;
  const SeedSphere& Seed;
  const ConstraintList Constraints;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Foreground;
  // By side: what later corrections must not undo.
  std::vector<SeedSphere> Corrected[2];
};

} // namespace

bool CorrectForeground(const ForegroundImage& image, const SeedSphere& seed,
  const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& foreground)
{
  return ForegroundCorrector(image, seed, constraints, parallelFor, monitor, foreground).Execute();
}

} // namespace FlipFree

#include "Evidence/ForegroundCorrection.h"

#include "Evidence/BoundaryShift.h"
#include "Evidence/CorrectionCut.h"
#include "Evidence/OrganCarving.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// A correction is certain around its point by a little more than a voxel, but where slices are
// thick by no more than this many millimeters.
constexpr double CertainVoxels = 1.01;
constexpr double CertainBall = 3;

// How far a point changes its surroundings: in millimeters, in distances from its side, and in
// radii of a ball of the foreground's volume.
constexpr double LeastDomainInside = 14;
constexpr double LeastDomainOutside = 30;
constexpr double DomainInAway = 2;
constexpr double DomainInOrganRadii = 2;
constexpr double LeastDomainInAway = 1.25;

// In millimeters: an inside point so deep outside the foreground may stand for tissue that was not
// expected in the organ.
constexpr double DeepInNewTissue = 10;

// How far from the foreground's box missed parts are looked for, in millimeters.
constexpr double MissedReach = 15;

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

// What is certain around a point.
double BallOf(const PointCorrection& correction, const ImageGeometry& geometry)
{
  const double least = std::max(CertainBall, CertainVoxels * geometry.Spacing.minCoeff());
  return std::max(correction.Radius, std::min(least, CertainVoxels * geometry.Spacing.maxCoeff()));
}

class ForegroundCorrector
{
public:
  ForegroundCorrector(const ForegroundImage& image, const SeedSphere& seed,
    const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
    BitMask& foreground)
    : Given(image)
    , Seed(seed)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Foreground(foreground)
  {
    for (const PointConstraint& constraint : SortedConstraints(constraints))
    {
      if (constraint.Kind != ConstraintKind::Boundary)
      {
        this->Corrections.push_back(CorrectionBy(constraint));
      }
    }
    const double greatestDomain = DomainInOrganRadii * RadiusOf(foreground, seed);
    BitMask outside = foreground;
    outside.Complement();
    for (PointCorrection& correction : this->Corrections)
    {
      correction.Opposite = this->OppositeOf(correction);
      const auto voxel = NearestVoxel(foreground.GetGeometry(), correction.Point);
      if (foreground(voxel[0], voxel[1], voxel[2]) != correction.IsInside)
      {
        const NearestPlace nearest =
          NearestIn(correction.IsInside ? foreground : outside, correction.Point);
        correction.Away = nearest.Distance;
        correction.NearestOnSide = nearest.Center;
      }
      correction.Domain = std::min(greatestDomain,
        std::max(correction.IsInside ? LeastDomainInside : LeastDomainOutside,
          DomainInAway * std::max(correction.Away, correction.Radius)));
      correction.Domain = std::max(correction.Domain, LeastDomainInAway * correction.Away);
    }
  }

  bool Execute()
  {
    if (this->Given.Growth && !this->FindTissues())
    {
      return false;
    }
    this->Box = this->FindBox();
    if (!this->Given.Make(this->Box))
    {
      return false;
    }
    const CorrectionEvidence evidence{ { this->Given.Smooth, this->Box.Begin },
      this->Foreground.Cropped(this->Box), this->CandidateNearby(), this->Given.Others, this->Seed,
      this->Given.Noise, this->Given.Kind };
    std::array<BitMask, 2> changed;
    return this->FindApart() &&
      CutCorrections(evidence, this->Corrections, this->Parallel, this->Ask, changed) &&
      this->ShiftBoundaries(evidence, changed) && this->Change(evidence.Before, changed) &&
      this->KeepPiece();
  }

private:
  static PointCorrection CorrectionBy(const PointConstraint& constraint)
  {
    PointCorrection correction;
    correction.Point = constraint.Point;
    correction.IsInside = constraint.Kind != ConstraintKind::Outside;
    correction.Radius = constraint.Radius;
    return correction;
  }

  std::vector<Eigen::Vector3d> OppositeOf(const PointCorrection& correction) const
  {
    std::vector<Eigen::Vector3d> opposite;
    for (const PointCorrection& other : this->Corrections)
    {
      if (other.IsInside != correction.IsInside)
      {
        opposite.push_back(other.Point);
      }
    }
    if (!correction.IsInside)
    {
      opposite.push_back(this->Seed.Center);
    }
    return opposite;
  }

  // What grows back to the seed is no new tissue: carving has decided about it.
  bool FindTissues()
  {
    const BitMask& candidate = this->Given.Candidate;
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    for (PointCorrection& correction : this->Corrections)
    {
      const std::array<int, 3> voxel = NearestVoxel(geometry, correction.Point);
      if (!correction.IsInside || correction.Away < DeepInNewTissue ||
        (candidate.HasGrid() && candidate(voxel[0], voxel[1], voxel[2])))
      {
        continue;
      }
      std::shared_ptr<const MaskPart> tissue =
        this->Given.Growth->From(correction.Point, this->Ask);
      if (!tissue)
      {
        return false;
      }
      if (!tissue->Holds(NearestVoxel(geometry, this->Seed.Center)))
      {
        correction.Tissue = std::move(tissue);
      }
    }
    return true;
  }

  // Where missed parts are looked for. It must not depend on the points.
  VoxelBox MissedBox() const
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    return WidenedBy(
      this->Foreground.Bounds().Joined(BoxAround(geometry, this->Seed.Center, this->Seed.Radius)),
      MissedReach, 1, geometry);
  }

  // With all that points may bring, and in whole blocks: neither may depend on the points.
  VoxelBox FindBox() const
  {
    const ImageGeometry& geometry = this->Foreground.GetGeometry();
    VoxelBox box = this->MissedBox();
    for (const OtherPart& other : this->Given.Others)
    {
      box = box.Joined(other.Box);
    }
    for (const PointCorrection& correction : this->Corrections)
    {
      box = box.Joined(BoxAround(geometry, correction.Point, correction.Domain));
      if (correction.Tissue)
      {
        box = box.Joined(correction.Tissue->Box);
      }
    }
    const BlockGrid grid = CorrectionGrid(this->Foreground, this->Seed);
    std::array<int, 3> margin{};
    for (int axis = 0; axis < 3; ++axis)
    {
      margin[axis] = 2 * grid.Factor[axis] + box.Begin[axis] % grid.Factor[axis];
    }
    return box.Widened(margin, WholeBox(geometry));
  }

  BitMask CandidateNearby() const
  {
    if (!this->Given.Candidate.HasGrid())
    {
      return {};
    }
    BitMask within(this->Foreground.GetGeometry());
    const VoxelBox box = this->MissedBox();
    within.Insert(this->Given.Candidate.Cropped(box), box.Begin);
    return within.Cropped(this->Box);
  }

  bool ShiftBoundaries(const CorrectionEvidence& evidence, std::array<BitMask, 2>& changed)
  {
    for (const PointCorrection& correction : this->Corrections)
    {
      if (correction.Away > 0)
      {
        BitMask shifted;
        if (!ShiftBoundary(evidence.Image, correction, this->Given.Noise, this->Given.Kind,
              this->Parallel, this->Ask, evidence.Before, shifted))
        {
          return false;
        }
        changed[correction.IsInside ? 1 : 0].Unite(shifted);
      }
    }
    return true;
  }

  // Fills the holes that come by it, but for outside points.
  bool Change(const BitMask& before, std::array<BitMask, 2>& changed)
  {
    BitMask both = changed[0];
    both.Intersect(changed[1]);
    for (BitMask& mask : changed)
    {
      mask.Remove(both);
    }
    BitMask part = before;
    part.Remove(changed[0]);
    part.Unite(changed[1]);
    this->FindCertain(before.GetGeometry());
    for (const bool inside : { false, true })
    {
      this->SetCertain(inside, part);
    }
    BitMask former = before;
    BitMask filled = part;
    if (!FillHoles(former, this->Ask) || !FillHoles(filled, this->Ask))
    {
      return false;
    }
    former.Remove(before);
    filled.Remove(former);
    part.Unite(filled);
    this->SetCertain(false, part);
    this->Foreground = BitMask(this->Foreground.GetGeometry());
    this->Foreground.Insert(part, this->Box.Begin);
    return true;
  }

  // Around each point a ball, but for what one of the other kind holds.
  void FindCertain(const ImageGeometry& geometry)
  {
    for (const PointCorrection& correction : this->Corrections)
    {
      std::vector<std::array<int, 3>>& certain = this->Certain[correction.IsInside ? 1 : 0];
      for (const std::size_t voxel :
        VoxelsInSphere(geometry, { correction.Point, BallOf(correction, geometry) }))
      {
        if (!correction.IsHeld(CenterOf(voxel, geometry)))
        {
          certain.push_back(IndexOf(voxel, geometry));
        }
      }
      certain.push_back(NearestVoxel(geometry, correction.Point));
    }
  }

  void SetCertain(bool inside, BitMask& mask) const
  {
    for (const std::array<int, 3>& index : this->Certain[inside ? 1 : 0])
    {
      mask.SetRun(inside, index[0], index[0] + 1, index[1], index[2]);
    }
  }

  // A label that is filled may have several pieces.
  bool FindApart()
  {
    const std::vector<std::size_t> source =
      VoxelsInSphere(this->Foreground.GetGeometry(), this->Seed);
    BitMask piece = this->Foreground;
    if (!source.empty() && !KeepConnected(piece, source, this->Ask))
    {
      return false;
    }
    this->Apart = this->Foreground;
    this->Apart.Remove(piece);
    return true;
  }

  bool KeepPiece()
  {
    std::vector<std::size_t> source = VoxelsInSphere(this->Foreground.GetGeometry(), this->Seed);
    this->Apart.Intersect(this->Foreground);
    this->Apart.ForEach([&source](std::size_t voxel) { source.push_back(voxel); });
    if ((!source.empty() && !KeepConnected(this->Foreground, source, this->Ask)) ||
      !CutAtNoData(this->Given.Read, this->Seed, this->Parallel, this->Ask, this->Foreground))
    {
      return false;
    }
    this->Foreground.Unite(this->Apart);
    return true;
  }

  const ForegroundImage& Given;
  const SeedSphere& Seed;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Foreground;
  std::vector<PointCorrection> Corrections; // in one order for the same set

  BitMask Apart; // of the foreground, from the seed's piece
  VoxelBox Box;  // what follows is on its grid
  std::array<std::vector<std::array<int, 3>>, 2> Certain; // outside, inside
};

} // namespace

bool CorrectForeground(const ForegroundImage& image, const SeedSphere& seed,
  const ConstraintList& constraints, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& foreground)
{
  return ForegroundCorrector(image, seed, constraints, parallelFor, monitor, foreground).Execute();
}

bool DecideOtherParts(const ForegroundImage& image, const SeedSphere& seed,
  const std::vector<DoubtfulPart>& decided, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<OtherPart>& others, BitMask& foreground)
{
  const auto isToChange = [&decided](const DoubtfulPart& doubt)
  {
    return doubt.Margin < 0 &&
      std::none_of(decided.begin(), decided.end(),
        [&doubt](const DoubtfulPart& part) { return part.IsSame(doubt); });
  };
  ConstraintList answers;
  std::vector<DoubtfulPart*> changed;
  for (OtherPart& other : others)
  {
    if (isToChange(other.Doubt))
    {
      answers.push_back({ other.Doubt.IsIncluded ? ConstraintKind::Outside : ConstraintKind::Inside,
        other.Doubt.Place });
      changed.push_back(&other.Doubt);
    }
  }
  if (!answers.empty() &&
    !CorrectForeground(image, seed, answers, parallelFor, monitor, foreground))
  {
    return false;
  }
  for (DoubtfulPart* doubt : changed) // not before: the answers mean the parts as they were
  {
    doubt->IsIncluded = !doubt->IsIncluded;
    doubt->Margin = -doubt->Margin;
  }
  return true;
}

} // namespace FlipFree

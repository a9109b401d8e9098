#include "Evidence/OrganDivision.h"

#include "Evidence/RegionCut.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace FlipFree
{
namespace
{

// What a voxel is worth, per mm3, that looks like one organ's seed and not at all like the other's;
// and one that is nearer to one seed than to the other by the radius of its own.
constexpr double LikenessWorth = 0.1;
constexpr double NearnessWorth = 0.02;
// What a cut costs per mm2 and millimeter of the smaller organ's radius (RegionLinks).
constexpr double SmoothnessOfDivision = 0.2;
// Voxels: what is certain around an inside point.
constexpr double CertainOrganVoxels = 1.01;

// A box of the volume in the voxels of a claim's region.
VoxelBox InRegion(const VoxelBox& box, const OrganClaim& claim)
{
  VoxelBox own = box;
  for (int axis = 0; axis < 3; ++axis)
  {
    own.Begin[axis] -= claim.First[axis];
    own.End[axis] -= claim.First[axis];
  }
  return own;
}

VoxelBox BoundsInVolume(const OrganClaim& claim)
{
  VoxelBox bounds = claim.Mask.Bounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds.Begin[axis] += claim.First[axis];
    bounds.End[axis] += claim.First[axis];
  }
  return bounds;
}

bool IsKept(const PointConstraint& constraint)
{
  return constraint.Kind == ConstraintKind::Inside || constraint.Kind == ConstraintKind::Seed;
}

class Division
{
public:
  Division(const OrganClaim& one, const OrganClaim& two, const VoxelBox& box, Modality modality,
    const ParallelFor& parallelFor)
    : Claims{ &one, &two }
    , Masks{ one.Mask.Cropped(InRegion(box, one)), two.Mask.Cropped(InRegion(box, two)) }
    , Image{ one.Smooth, InRegion(box, one).Begin }
    , Similarity(std::max(one.Noise, two.Noise), modality)
    , Noise(std::max(one.Noise, two.Noise))
    , Parallel(parallelFor)
    , Grid(Masks[0].GetGeometry(), 0)
  {
  }

  // What goes to the second and to the first claim, on the grid of the box. False if stopped.
  bool Execute(const Monitor& monitor, BitMask (&lost)[2])
  {
    BitMask common = this->Masks[0];
    common.Intersect(this->Masks[1]);
    lost[0] = BitMask(common.GetGeometry());
    lost[1] = lost[0];
    this->Nodes = BlockNodes(common.GetGeometry().NumberOfVoxels(), common);
    RegionCut cut = this->MakeCut();
    if (!cut.Execute(this->Parallel, monitor))
    {
      return false;
    }
    common.ForEach([&](std::size_t voxel) { lost[cut.IsInside(voxel) ? 1 : 0].Insert(voxel); });
    return true;
  }

private:
  RegionCut MakeCut() const
  {
    const std::vector<float> smooth = SmoothBlockMeans(this->Image, this->Grid, this->Parallel);
    const RobustStatistics of[2] = { this->StatisticsOf(0), this->StatisticsOf(1) };
    double smallest = std::numeric_limits<double>::max();
    for (const OrganClaim* claim : this->Claims)
    {
      const double volume =
        static_cast<double>(claim->Mask.Count()) * claim->Mask.GetGeometry().VoxelVolume();
      smallest = std::min<double>(smallest, std::cbrt(volume * 3 / (4 * EIGEN_PI)));
    }
    const BlockLinks links = RegionLinks(SmoothnessOfDivision, smallest,
      std::max(
        { of[0].StandardDeviation, of[1].StandardDeviation, 0.5 * this->Noise, LeastDeviation }));
    const auto worth = [&](std::size_t voxel)
    {
      const double value = smooth[voxel];
      const double likeness =
        this->Similarity.LikenessOf(value, of[0]) - this->Similarity.LikenessOf(value, of[1]);
      const Eigen::Vector3d place = this->Grid.CenterOf(voxel);
      const double nearer = this->DistanceFrom(1, place) - this->DistanceFrom(0, place);
      return LikenessWorth * likeness + NearnessWorth * std::max(-1.0, std::min(1.0, nearer));
    };
    const auto side = [&](std::size_t voxel) {
      return static_cast<double>(this->Masks[0](voxel)) -
        static_cast<double>(this->Masks[1](voxel));
    };
    RegionCut cut(
      MakeBlockNetwork(this->Grid.Blocks, this->Nodes, smooth, links, worth, side, this->Parallel),
      CapacityUnit(this->Grid.Blocks, links), this->Nodes);
    const BitMask ofSecond = this->CertainOf(1);
    BitMask ofFirst = this->CertainOf(0);
    ofFirst.Remove(ofSecond);
    cut.Fix(this->NodesIn(ofFirst), true);
    cut.Fix(this->NodesIn(ofSecond), false);
    return cut;
  }

  RobustStatistics StatisticsOf(int claim) const
  {
    // In the claim's own smoothed image, which has values at the seed.
    const OrganClaim& own = *this->Claims[claim];
    return StatisticsInBall({ own.Smooth, { { 0, 0, 0 } } }, own.Smooth.Geometry, own.Seed);
  }

  // In radii.
  double DistanceFrom(int claim, const Eigen::Vector3d& place) const
  {
    const SeedSphere& seed = this->Claims[claim]->Seed;
    return ((place - seed.Center).norm() - seed.Radius) / seed.Radius;
  }

  BitMask CertainOf(int claim) const
  {
    BitMask certain(this->Grid.Voxels);
    const auto add = [&certain](const SeedSphere& ball)
    {
      for (const std::size_t voxel : VoxelsInSphere(certain.GetGeometry(), ball))
      {
        certain.Insert(voxel);
      }
    };
    add(this->Claims[claim]->Seed);
    for (const PointConstraint& constraint : this->Claims[claim]->Constraints)
    {
      if (IsKept(constraint))
      {
        add({ constraint.Point,
          std::max(constraint.Radius, CertainOrganVoxels * this->Grid.Voxels.Spacing.maxCoeff()) });
      }
    }
    return certain;
  }

  std::vector<std::size_t> NodesIn(const BitMask& mask) const
  {
    std::vector<std::size_t> nodes;
    mask.ForEach(
      [&](std::size_t voxel)
      {
        if (this->Nodes.IsNode(voxel))
        {
          nodes.push_back(voxel);
        }
      });
    return nodes;
  }

  const OrganClaim* const Claims[2];
  const BitMask Masks[2];
  const ImagePart Image;
  const GrayValueSimilarity Similarity;
  const double Noise;
  const ParallelFor& Parallel;
  const BlockGrid Grid; // of blocks of one voxel
  BlockNodes Nodes;
};

// The box of what both claim, with a voxel around it, as far as both reach; empty if nothing.
VoxelBox BoxInCommon(const OrganClaim& one, const OrganClaim& two)
{
  const VoxelBox both = BoundsInVolume(one).Cropped(BoundsInVolume(two));
  if (both.IsEmpty())
  {
    return {};
  }
  BitMask common = one.Mask.Cropped(InRegion(both, one));
  common.Intersect(two.Mask.Cropped(InRegion(both, two)));
  VoxelBox bounds = common.Bounds();
  if (bounds.IsEmpty())
  {
    return {};
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds.Begin[axis] += both.Begin[axis];
    bounds.End[axis] += both.Begin[axis];
  }
  return bounds.Widened({ { 1, 1, 1 } }, both);
}

// The other's mask on the grid of a claim's region.
BitMask InRegionOf(const OrganClaim& claim, const OrganClaim& other)
{
  BitMask mask(claim.Mask.GetGeometry());
  VoxelBox region = WholeBox(mask.GetGeometry());
  for (int axis = 0; axis < 3; ++axis)
  {
    region.Begin[axis] += claim.First[axis];
    region.End[axis] += claim.First[axis];
  }
  const VoxelBox box = BoundsInVolume(other).Cropped(region);
  if (!box.IsEmpty())
  {
    mask.Insert(other.Mask.Cropped(InRegion(box, other)), InRegion(box, claim).Begin);
  }
  return mask;
}

void RemoveInVolume(const BitMask& part, const VoxelBox& box, OrganClaim& claim)
{
  const VoxelBox own = InRegion(box, claim);
  part.ForEachRun(0, part.GetGeometry().Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      claim.Mask.RemoveRun(own.Begin[0] + begin, own.Begin[0] + end, own.Begin[1] + j,
        own.Begin[2] + k);
    });
}

bool IsFixed(const OrganClaim& claim)
{
  return claim.Fixed.HasGrid();
}

bool KeepPieceOfSeed(OrganClaim& claim, const Monitor& monitor)
{
  claim.IsCut = true;
  return KeepConnected(claim.Mask, VoxelsInSphere(claim.Mask.GetGeometry(), claim.Seed), monitor);
}

// What lies in fixed surfaces is theirs.
bool CutFixed(OrganClaim& claim, const Monitor& monitor)
{
  const std::size_t before = claim.Mask.Count();
  claim.Mask.Remove(claim.Fixed);
  return claim.Mask.Count() == before || KeepPieceOfSeed(claim, monitor);
}

// Fills the holes of claims that were cut, but for what belongs to another. A hole may hold another
// claim with a hole of its own, which is left to the inner one, the smaller.
bool FillClaims(std::vector<OrganClaim>& claims, const Monitor& monitor)
{
  if (std::none_of(claims.begin(), claims.end(),
        [](const OrganClaim& claim) { return claim.IsCut; }))
  {
    return true;
  }
  std::vector<OrganClaim> filled = claims;
  std::vector<std::pair<std::size_t, std::size_t>> order; // voxels, index
  for (OrganClaim& claim : filled)
  {
    if (!FillHoles(claim.Mask, monitor))
    {
      return false;
    }
    order.emplace_back(claim.Mask.Count(), order.size());
  }
  std::sort(order.begin(), order.end());
  for (const auto& [voxels, index] : order)
  {
    OrganClaim& own = claims[index];
    if (!own.IsCut)
    {
      continue;
    }
    own.Mask = filled[index].Mask;
    if (IsFixed(own))
    {
      own.Mask.Remove(own.Fixed);
    }
    for (const auto& [othersVoxels, other] : order)
    {
      if (other != index)
      {
        own.Mask.Remove(InRegionOf(own, othersVoxels < voxels ? filled[other] : claims[other]));
      }
    }
  }
  return true;
}

bool DividePair(OrganClaim& one, OrganClaim& two, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  const VoxelBox both = BoxInCommon(one, two);
  if (both.IsEmpty())
  {
    return true;
  }
  BitMask lost[2];
  if (!Division(one, two, both, modality, parallelFor).Execute(monitor, lost))
  {
    return false;
  }
  OrganClaim* const claims[2] = { &one, &two };
  for (const int claim : { 0, 1 })
  {
    if (!lost[claim].Bounds().IsEmpty())
    {
      RemoveInVolume(lost[claim], both, *claims[claim]);
      if (!KeepPieceOfSeed(*claims[claim], monitor))
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace

bool DivideClaims(std::vector<OrganClaim>& claims, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  for (OrganClaim& claim : claims)
  {
    claim.IsCut = false;
    if (IsFixed(claim) && !CutFixed(claim, monitor))
    {
      return false;
    }
  }
  for (std::size_t one = 0; one < claims.size(); ++one)
  {
    for (std::size_t two = one + 1; two < claims.size(); ++two)
    {
      if (!DividePair(claims[one], claims[two], modality, parallelFor, monitor))
      {
        return false;
      }
    }
  }
  return FillClaims(claims, monitor);
}

} // namespace FlipFree

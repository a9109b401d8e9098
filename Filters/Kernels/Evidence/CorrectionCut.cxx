#include "Evidence/CorrectionCut.h"

#include "Evidence/NestedParts.h"
#include "Evidence/PointWorth.h"
#include "Evidence/RegionCut.h"
#include "Evidence/SeveredParts.h"
#include "Image/BallInside.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/GrayValueSimilarity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

// What a cut costs per mm2 and millimeter of the organ's depth.
constexpr double Smoothness = 0.1;
// What it is worth, per mm3, that a part changes sides which a point proposes.
constexpr double WorthOfPart = 0.7;

// A point lies on top of a part if it is so deep in it, of the part's depth.
constexpr double OnTopOfLeak = 0.6;
constexpr double OnTopOfMissedPart = 0.5;
// A point is as deep as the organ if it is so deep in the mask, in radii of the ball around the
// seed.
constexpr double DeepInOrganRadii = 1.3;
// A neck is narrow below this fraction of the part behind it. The part behind a narrow neck leaves
// in any case; behind a wider one it stays where the image shows that it is the organ's own. An
// inside point brings nothing from beyond a narrow neck; in tissue that was not expected in the
// organ, only narrower necks count.
constexpr double NarrowNeck = 0.6;
constexpr double NeckOfTissue = 0.5;

// What is missed is opened by this part of its depth, and no more than that many millimeters:
// sheets may go all around the organ.
constexpr double OpeningPart = 0.5;
constexpr double GreatestOpening = 5;

// Of a bridge to a point not otherwise connected with the mask, in millimeters.
constexpr double BridgeRadius = 3;

// The organ's gray values are those in the mask within this many seed radii of the seed's center,
// such as both the cortex and the medulla of a kidney; fewer voxels tell nothing.
constexpr double OrganInSeedRadii = 2.5;
constexpr std::size_t LeastOrganVoxels = 30;

class CorrectionCutter
{
public:
  CorrectionCutter(const CorrectionEvidence& evidence,
    const std::vector<PointCorrection>& corrections, const ParallelFor& parallelFor,
    const Monitor& monitor)
    : Known(evidence)
    , Corrections(corrections)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Grid(CorrectionGrid(evidence.Before, evidence.Seed))
    , Ball(BallInside(evidence.Before, evidence.Seed))
    , Similarity(evidence.Noise, evidence.Kind)
    , Smooth(SmoothBlockMeans(evidence.Image, Grid, parallelFor))
    , Links(RegionLinks(Smoothness, Ball.Radius, FindSpread()))
    , Fill(Grid.CountVoxels(evidence.Before, parallelFor))
    , Worth(Fill.size(), Stays)
    , IsCertain(Fill.size(), false)
  {
    this->IsIn.reserve(this->Fill.size());
    for (const std::size_t count : this->Fill)
    {
      this->IsIn.push_back(this->Grid.AreHalf(count) ? 1 : 0);
    }
  }

  bool Execute(std::array<BitMask, 2>& changed)
  {
    this->OfSeed = StatisticsInBall(this->Known.Image, this->Grid.Voxels, this->Known.Seed);
    this->FindOrgan();
    for (const PointCorrection& correction : this->Corrections)
    {
      if (correction.Away > 0)
      {
        if (!this->ProposeSurroundings(correction) || !this->ProposePart(correction))
        {
          return false;
        }
        this->ProposeOtherPart(correction);
      }
    }
    for (BitMask& mask : changed)
    {
      mask = BitMask(this->Known.Before.GetGeometry());
    }
    return this->Cut(changed);
  }

private:
  bool IsRight(std::size_t block, const PointCorrection& correction) const
  {
    return (this->IsIn[block] != 0) == correction.IsInside;
  }

  // Finds what the mask holds around the seed.
  void FindOrgan()
  {
    const ImageGeometry& voxels = this->Grid.Voxels;
    const SeedSphere& seed = this->Known.Seed;
    for (const std::size_t voxel :
      VoxelsInSphere(voxels, { seed.Center, OrganInSeedRadii * seed.Radius }))
    {
      const std::array<int, 3> index = IndexOf(voxel, voxels);
      if (this->Known.Before(index[0], index[1], index[2]))
      {
        this->Organ.push_back(
          { CenterOf(voxel, voxels), this->Known.Image.Row(index[1], index[2])[index[0]] });
      }
    }
    this->OfOrgan = this->StatisticsOfOrgan([](const OrganVoxel&) { return true; });
  }

  template <typename Counts>
  RobustStatistics StatisticsOfOrgan(const Counts& counts) const
  {
    std::vector<float> values;
    for (const OrganVoxel& voxel : this->Organ)
    {
      if (counts(voxel))
      {
        values.push_back(voxel.Value);
      }
    }
    return values.size() < LeastOrganVoxels ? this->OfSeed : RobustStatisticsOf(values);
  }

  // But for what is as near to an outside point as its side: that is no organ. An inside point is
  // nearer to all of it.
  RobustStatistics StatisticsOfOrganBeside(const PointCorrection& correction) const
  {
    return correction.IsInside
      ? this->OfOrgan
      : this->StatisticsOfOrgan([&](const OrganVoxel& voxel)
          { return (voxel.Center - correction.Point).norm() > correction.Away; });
  }

  PointWorth WorthOf(const PointCorrection& correction) const
  {
    return { this->Known.Image, this->Grid.Voxels, correction, this->Similarity,
      { this->OfSeed, this->StatisticsOfOrganBeside(correction) } };
  }

  bool ProposeSurroundings(const PointCorrection& correction)
  {
    const PointWorth worth = this->WorthOf(correction);
    std::vector<std::size_t> gaining;
    for (const std::size_t block :
      VoxelsAround(this->Grid.Blocks, { correction.Point, correction.Domain }))
    {
      if (this->IsRight(block, correction))
      {
        continue;
      }
      const Eigen::Vector3d place = this->Grid.CenterOf(block);
      const auto gain = static_cast<float>(worth.Of(this->Smooth[block], place));
      if (worth.IsCertain(place) && correction.IsOwn(place))
      {
        gaining.push_back(block);
        this->MakeCertain(block, correction);
      }
      else if (gain > 0)
      {
        gaining.push_back(block);
      }
      if (!correction.IsHeld(place))
      {
        this->Worth[block] = std::max(this->Worth[block], gain);
      }
    }
    if (correction.IsInside && !this->LeadsToMask(correction.Point, gaining))
    {
      this->MakeBridge(correction);
    }
    return this->Ask(0.5);
  }

  void MakeCertain(std::size_t block, const PointCorrection& correction)
  {
    if (!correction.IsHeld(this->Grid.CenterOf(block)))
    {
      this->Worth[block] = std::max(this->Worth[block], 0.0F);
      this->IsCertain[block] = true;
    }
  }

  // Whether blocks, in ascending order, connect a point with the mask.
  bool LeadsToMask(const Eigen::Vector3d& point, const std::vector<std::size_t>& blocks) const
  {
    std::vector<bool> isReached(blocks.size(), false);
    std::vector<std::size_t> front{ this->Grid.BlockAt(point) };
    bool leads = false;
    for (std::size_t next = 0; next < front.size() && !leads; ++next)
    {
      VisitNeighbors(front[next], this->Grid.Blocks,
        [&](std::size_t other)
        {
          leads = leads || this->IsIn[other] != 0;
          const auto found = std::lower_bound(blocks.begin(), blocks.end(), other);
          if (found != blocks.end() && *found == other && !isReached[found - blocks.begin()])
          {
            isReached[found - blocks.begin()] = true;
            front.push_back(other);
          }
        });
    }
    return leads;
  }

  // An organ is one piece: the shortest way from an inside point to the mask belongs to it.
  void MakeBridge(const PointCorrection& correction)
  {
    const Eigen::Vector3d way = correction.NearestOnSide - correction.Point;
    const int steps =
      std::max(1, static_cast<int>(std::ceil(way.norm() / this->Grid.Blocks.Spacing.minCoeff())));
    for (int step = 0; step <= steps; ++step)
    {
      const Eigen::Vector3d place = correction.Point + way * step / steps;
      for (const std::size_t block : VoxelsAround(this->Grid.Blocks, { place, BridgeRadius }))
      {
        if (!this->IsIn[block])
        {
          this->MakeCertain(block, correction);
        }
      }
    }
  }

  // False if the monitor stopped it.
  bool ProposePart(const PointCorrection& correction)
  {
    const std::size_t own = this->Grid.BlockAt(correction.Point);
    if (this->IsRight(own, correction))
    {
      return true;
    }
    if (!correction.IsInside)
    {
      if (!this->Leaks &&
        !this->FindParts(this->IsIn, VoxelsAround(this->Grid.Blocks, this->Known.Seed), NarrowNeck,
          this->Leaks))
      {
        return false;
      }
      const NestedPart part = this->Leaks->PartAround(own, {}, OnTopOfLeak);
      if (part.Voxels.empty() && this->IsAsDeepAsOrgan(correction))
      {
        this->FreeWhatIsNearer(correction);
      }
      if (part.NeckRatio <= NarrowNeck || !this->IsOwn(part.Voxels))
      {
        this->Propose(part.Voxels, *this->Leaks, correction);
      }
      return true;
    }
    if (correction.Tissue)
    {
      return this->ProposeTissue(correction);
    }
    if (!this->Missed && !this->FindMissed())
    {
      return false;
    }
    const std::vector<std::size_t> part =
      this->Missed->PartAround(own, {}, OnTopOfMissedPart).Voxels;
    if (part != this->MissedPart)
    {
      this->OpenedPart = part;
      if (!this->OpenMissed(this->OpenedPart))
      {
        return false;
      }
      this->MissedPart = part;
    }
    this->Propose(this->OpenedPart, *this->Missed, correction);
    return true;
  }

  // Whether the gray values of the mask go on unchanged into a part of it.
  bool IsOwn(const std::vector<std::size_t>& part) const
  {
    if (this->Known.Kind == Modality::MR)
    {
      return false; // the coil's field hides it
    }
    const std::vector<SeveredPart> severed = FindSeveredParts(this->Grid.Blocks,
      BlockNodes(this->IsIn.size(), [this](std::size_t block) { return this->IsIn[block] != 0; }),
      this->Smooth, this->Leaks->GetSquaredDistances(), this->Links.EdgeContrast,
      [&part](std::size_t block) { return !std::binary_search(part.begin(), part.end(), block); });
    return std::all_of(severed.begin(), severed.end(),
      [&](const SeveredPart& one) { return EvidenceOfNeighbor(one).value_or(1) < 1; });
  }

  // Of what is not in the mask, the part around the point.
  bool ProposeTissue(const PointCorrection& correction)
  {
    std::optional<NestedParts> parts;
    if (!this->FindParts(
          this->NotInMask(this->CountVoxels(correction.Tissue->Voxels, correction.Tissue->Box)), {},
          NeckOfTissue, parts))
    {
      return false;
    }
    this->Propose(
      parts->PartAround(this->Grid.BlockAt(correction.Point), {}, OnTopOfMissedPart).Voxels, *parts,
      correction);
    return true;
  }

  // A leak as deep as the organ has no neck before it: what is nearer to the point than to the
  // organ may leave, but for what looks like the organ rather than like the point. The cut finds
  // the edge.
  void FreeWhatIsNearer(const PointCorrection& correction)
  {
    const PointWorth worth = this->WorthOf(correction);
    for (std::size_t block = 0; block < this->IsIn.size(); ++block)
    {
      const Eigen::Vector3d place = this->Grid.CenterOf(block);
      const double away = (place - correction.Point).norm();
      const bool isNearer =
        away < (place - this->Known.Seed.Center).norm() - this->Known.Seed.Radius &&
        std::all_of(correction.Opposite.begin(), correction.Opposite.end(),
          [&](const Eigen::Vector3d& inside) { return away < (place - inside).norm(); });
      if (this->IsIn[block] && isNearer && !correction.IsHeld(place))
      {
        const auto gain = static_cast<float>(std::min(0.0, worth.OutsideOf(this->Smooth[block])));
        this->Worth[block] = std::max(this->Worth[block], gain);
      }
    }
  }

  // Of the parts of other opinions that the point means, the most doubtful one. Which one that is
  // must not depend on other points.
  void ProposeOtherPart(const PointCorrection& correction)
  {
    const auto other = std::find_if(this->Known.Others.begin(), this->Known.Others.end(),
      [&](const OtherPart& part) { return this->Means(correction, part); });
    if (other != this->Known.Others.end())
    {
      this->Gain(this->BlocksOf(*other, correction), correction);
    }
  }

  // A point at a part's place does. So does an outside point anywhere in a part that does not hold
  // the seed, if it is as deep as the organ: in a leak as large as that.
  bool Means(const PointCorrection& correction, const OtherPart& other) const
  {
    if (other.Doubt.IsIncluded == correction.IsInside)
    {
      return false;
    }
    if ((other.Doubt.Place - correction.Point).norm() <= this->Grid.Blocks.Spacing.maxCoeff())
    {
      return true;
    }
    const ImageGeometry& voxels = this->Known.Image.Image.Geometry;
    return !correction.IsInside && this->IsAsDeepAsOrgan(correction) &&
      other.Holds(NearestVoxel(voxels, correction.Point)) &&
      !other.Holds(NearestVoxel(voxels, this->Known.Seed.Center));
  }

  bool IsAsDeepAsOrgan(const PointCorrection& correction) const
  {
    return correction.Away > DeepInOrganRadii * this->Ball.Radius;
  }

  // Those that would change sides, ascending: by half, and around the part's place.
  std::vector<std::size_t> BlocksOf(const OtherPart& other, const PointCorrection& correction) const
  {
    const std::vector<std::size_t> counts = this->CountVoxels(other.Voxels, other.Box);
    const std::size_t place = this->Grid.BlockAt(other.Doubt.Place);
    std::vector<std::size_t> part;
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      if ((block == place || this->Grid.AreHalf(counts[block])) &&
        !this->IsRight(block, correction))
      {
        part.push_back(block);
      }
    }
    return part;
  }

  // Of a box of the image, in each block.
  std::vector<std::size_t> CountVoxels(const BitMask& voxels, const VoxelBox& box) const
  {
    std::array<int, 3> first{};
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = box.Begin[axis] - this->Known.Image.First[axis];
    }
    BitMask all(this->Grid.Voxels);
    all.Insert(voxels, first);
    return this->Grid.CountVoxels(all, this->Parallel);
  }

  // Which blocks are not in the mask and have most of their voxels counted.
  std::vector<unsigned char> NotInMask(const std::vector<std::size_t>& counts) const
  {
    std::vector<unsigned char> blocks(this->IsIn.size(), 0);
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      blocks[block] = !this->IsIn[block] && 2 * counts[block] > this->Grid.VoxelsPerBlock();
    }
    return blocks;
  }

  // The parts of the candidate that are not in the mask.
  bool FindMissed()
  {
    const BitMask& candidate = this->Known.Candidate;
    return this->FindParts(this->NotInMask(candidate.HasGrid()
                               ? this->Grid.CountVoxels(candidate, this->Parallel)
                               : std::vector<std::size_t>()),
      {}, NarrowNeck, this->Missed);
  }

  // False if the monitor stopped it.
  bool FindParts(const std::vector<unsigned char>& inside, const std::vector<std::size_t>& seed,
    double narrowest, std::optional<NestedParts>& parts) const
  {
    std::vector<float> depth =
      SquaredDistance(inside, this->Grid.Blocks, 0, this->Parallel, this->Ask);
    if (!depth.empty())
    {
      parts.emplace(std::move(depth), this->Grid.Blocks, seed, narrowest);
    }
    return parts.has_value();
  }

  bool OpenMissed(std::vector<std::size_t>& part) const
  {
    const std::vector<float>& depth = this->Missed->GetSquaredDistances();
    float peak = 0;
    for (const std::size_t block : part)
    {
      peak = std::max(peak, depth[block]);
    }
    const double radius = std::min(GreatestOpening, OpeningPart * std::sqrt(peak));
    std::vector<unsigned char> isDeep(this->IsIn.size(), 0);
    for (const std::size_t block : part)
    {
      isDeep[block] = depth[block] >= radius * radius ? 1 : 0;
    }
    const std::vector<float> toDeep =
      SquaredDistance(isDeep, this->Grid.Blocks, 1, this->Parallel, this->Ask);
    const double reach = radius + this->Grid.Blocks.Spacing.maxCoeff();
    if (!toDeep.empty())
    {
      part.erase(std::remove_if(part.begin(), part.end(),
                   [&](std::size_t block) { return toDeep[block] > reach * reach; }),
        part.end());
    }
    return !toDeep.empty();
  }

  // But for the parts of it on top of which points of the other kind lie, and what they hold.
  void Propose(std::vector<std::size_t> part, const NestedParts& parts,
    const PointCorrection& correction)
  {
    const std::size_t own = this->Grid.BlockAt(correction.Point);
    for (const Eigen::Vector3d& point : correction.Opposite)
    {
      const std::size_t other = this->Grid.BlockAt(point);
      if (std::binary_search(part.begin(), part.end(), other))
      {
        const std::vector<std::size_t> back =
          parts.PartAround(other, { own }, OnTopOfMissedPart).Voxels;
        std::vector<std::size_t> rest;
        std::set_difference(part.begin(), part.end(), back.begin(), back.end(),
          std::back_inserter(rest));
        part = std::move(rest);
      }
    }
    this->Gain(part, correction);
  }

  void Gain(const std::vector<std::size_t>& part, const PointCorrection& correction)
  {
    for (const std::size_t block : part)
    {
      if (!correction.IsHeld(this->Grid.CenterOf(block)))
      {
        this->Worth[block] = std::max(this->Worth[block], static_cast<float>(WorthOfPart));
      }
    }
  }

  bool Cut(std::array<BitMask, 2>& changed)
  {
    const BlockNodes nodes(this->Worth.size(),
      [this](std::size_t block) { return this->Worth[block] > Stays; });
    RegionCut cut(MakeBlockNetwork(
                    this->Grid.Blocks, nodes, this->Smooth, this->Links,
                    [this](std::size_t block)
                    { return this->IsIn[block] ? -this->Worth[block] : this->Worth[block]; },
                    [this](std::size_t block) { return this->IsIn[block] ? 1 : -1; },
                    this->Parallel),
      CapacityUnit(this->Grid.Blocks, this->Links), nodes);
    for (std::size_t block = 0; block < this->IsCertain.size(); ++block)
    {
      if (this->IsCertain[block])
      {
        cut.Fix({ block }, !this->IsIn[block]);
      }
    }
    if (!cut.Execute(this->Parallel, this->Ask))
    {
      return false;
    }
    const auto isNow = [&](std::size_t block)
    { return nodes.IsNode(block) ? cut.IsInside(block) : this->IsIn[block] != 0; };
    for (std::size_t block = 0; block < this->IsIn.size(); ++block)
    {
      const bool isNode = nodes.IsNode(block);
      const bool changes = isNode ? isNow(block) != (this->IsIn[block] != 0)
                                  : this->IsRim(block) && this->LosesRim(block, isNow);
      if (changes)
      {
        this->Grid.SetBlock(true, block, changed[isNode && isNow(block) ? 1 : 0]);
      }
    }
    return true;
  }

  // Of the blocks' gray values around the seed, in which edges are looked for.
  double FindSpread() const
  {
    std::vector<float> values;
    for (const std::size_t block : VoxelsAround(this->Grid.Blocks, this->Ball))
    {
      values.push_back(this->Smooth[block]);
    }
    return std::max(
      { RobustStatisticsOf(values).StandardDeviation, 0.5 * this->Known.Noise, LeastDeviation });
  }

  // Whether a block holds a little of the mask.
  bool IsRim(std::size_t block) const { return !this->IsIn[block] && this->Fill[block] > 0; }

  // Whether most of the blocks around that were in the mask leave it.
  template <typename IsNow>
  bool LosesRim(std::size_t block, const IsNow& isNow) const
  {
    int balance = 0;
    VisitSurroundings(IndexOf(block, this->Grid.Blocks), this->Grid.Blocks,
      [&](std::size_t other) { balance += !this->IsIn[other] ? 0 : (isNow(other) ? 1 : -1); });
    return balance < 0;
  }

  static constexpr float Stays = -1e6F;

  const CorrectionEvidence& Known;
  const std::vector<PointCorrection>& Corrections;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const BlockGrid Grid;
  const SeedSphere Ball; // around the seed
  const GrayValueSimilarity Similarity;

  // Of the blocks.
  const std::vector<float> Smooth;     // gray values
  const BlockLinks Links;              // what cuts between them cost
  const std::vector<std::size_t> Fill; // voxels in the mask
  std::vector<unsigned char> IsIn;     // half of the block is in the mask
  std::vector<float> Worth;            // of its changing sides, per mm3
  std::vector<bool> IsCertain;         // that it does
  std::optional<NestedParts> Leaks;
  std::optional<NestedParts> Missed;

  // The last missed part, which other points of a stroke are likely to mean, too, and what is left
  // of it once opened.
  std::vector<std::size_t> MissedPart;
  std::vector<std::size_t> OpenedPart;

  struct OrganVoxel
  {
    Eigen::Vector3d Center;
    float Value;
  };
  std::vector<OrganVoxel> Organ; // in the mask around the seed
  RobustStatistics OfOrgan;
  RobustStatistics OfSeed;
};

} // namespace

BlockGrid CorrectionGrid(const BitMask& mask, const SeedSphere& seed)
{
  return RegionGrid(mask, BallInside(mask, seed).Radius);
}

bool CutCorrections(const CorrectionEvidence& evidence,
  const std::vector<PointCorrection>& corrections, const ParallelFor& parallelFor,
  const Monitor& monitor, std::array<BitMask, 2>& changed)
{
  return CorrectionCutter(evidence, corrections, parallelFor, monitor).Execute(changed);
}

} // namespace FlipFree

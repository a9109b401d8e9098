#include "Intensity/CorrectionCut.h"

#include "Image/BallInside.h"
#include "Image/BlockNetwork.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakDepth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

// Of the reach: what changes sides in any case.
constexpr double CertainPart = 0.8;

// What a voxel is worth that looks like the point's ball or like the organ (inside), or more like
// the ball than like the organ (outside).
constexpr double InsideGain = 0.3;
constexpr double OutsideGain = 0.1;
// And what it loses for each reach that it is farther away than the reach. A point in the depth of
// the wrong side, this many millimeters from the right one, stands for something large; one near
// the right side may lie in a bump, and a region that spreads from it would take too much.
constexpr double DecayOfDeepPoint = 0.1;
constexpr double DeepAway = 10;
constexpr double DecayOfNearPoint = 0.3;
constexpr double NearAway = 4;
// A correction is local: within this many times the point's distance from the right side, which is
// at least this many millimeters.
constexpr double LocalPart = 2;
constexpr double LeastLocal = 15;
// What a cut costs per mm2 and millimeter of reach, of which these count.
constexpr double InsideSmoothness = 0.2;
constexpr double OutsideSmoothness = 0.1;
constexpr double LeastReach = 3;
constexpr double GreatestReach = 40;

constexpr double NeckBase = 0.3;
constexpr double NeckGain = 0.3;
constexpr double NeckSmoothness = 0.2;

// A point in the depth of what looks like the seed: its reach is at most this part of the way to
// the seed; what is nearer to it than to the seed is worth this much, and loses this much for each
// reach beyond twice the reach.
constexpr double LikeSeedDeviations = 2.5;
constexpr double PartOfWayToSeed = 0.6;
constexpr double NearerGain = 0.2;
constexpr double NearerDecay = 0.1;

// What looks like the organ around an inside point is the organ's for this part of the way to it,
// and loses as much with distance as around a point near the right side: a neighbor may look so.
constexpr double PartOfWayToOrgan = 0.6;

// The ball whose gray values stand for the point's surroundings, in reaches and millimeters.
constexpr double BallPart = 0.7;
constexpr double LeastBall = 2;
constexpr double GreatestBall = 8;

// A point's ball counts as at most this many times as varied as the seed: one that reaches across
// the boundary holds gray values of both sides, and would look like either.
constexpr double VarietyInSeedSpreads = 1.5;

// What the mask holds within this many seed radii of the seed's center shows more of the organ than
// the seed does, such as both the cortex and the medulla of a kidney; fewer voxels tell nothing.
constexpr double OrganInSeedRadii = 2.5;
constexpr std::size_t LeastOrganVoxels = 30;

// How many reaches farther away than the reach.
double Beyond(double away, double reach)
{
  return std::max(0.0, (away - reach) / std::max(1.0, reach));
}

// Of what the mask holds around the seed, but for what is as near to the point as the right side.
RobustStatistics StatisticsOfOrgan(const ImagePart& image, const BitMask& mask,
  const SeedSphere& seed, const Correction& correction)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  std::vector<float> values;
  for (const std::size_t voxel :
    VoxelsInSphere(geometry, { seed.Center, OrganInSeedRadii * seed.Radius }))
  {
    const std::array<int, 3> index = IndexOf(voxel, geometry);
    const Eigen::Vector3d center =
      geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
    if (mask(index[0], index[1], index[2]) && (center - correction.Point).norm() > correction.Away)
    {
      values.push_back(image.Row(index[1], index[2])[index[0]]);
    }
  }
  return values.size() < LeastOrganVoxels ? StatisticsInBall(image, geometry, seed)
                                          : RobustStatisticsOf(values);
}

class Cut
{
public:
  Cut(const ImagePart& image, const SeedSphere& seed, const Correction& correction, double noise,
    Modality modality, const ParallelFor& parallelFor, BitMask& mask)
    : Image(image)
    , Seed(seed)
    , Wanted(correction)
    , Reach(correction.Reach)
    , Noise(noise)
    , Similarity(noise, modality)
    , Parallel(parallelFor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), std::max(1.0, std::min(2.0, correction.Reach / 4)))
    , OfPoint(StatisticsInBall(image, Grid.Voxels,
        { correction.Point,
          std::max(LeastBall, std::min(GreatestBall, BallPart * correction.Reach)) }))
    , OfSeed(StatisticsInBall(image, Grid.Voxels, seed))
    , OfOrgan(StatisticsOfOrgan(image, mask, seed, correction))
    , OwnBlock(Grid.BlockAt(correction.Point))
  {
  }

  bool Execute(const Monitor& monitor)
  {
    this->MarkBlocks();
    if (this->Wanted.IsInside)
    {
      this->OrganReach = this->ReachOfOrgan();
      this->Reach = std::max(LeastReach, std::min(this->Reach, this->OrganReach));
    }
    else if (!this->LookForDepth(monitor))
    {
      return false;
    }
    const std::vector<unsigned char> switched =
      SourceSide(this->MakeNetwork(), this->Parallel, monitor);
    if (switched.empty())
    {
      return false;
    }
    this->Apply(switched);
    return true;
  }

private:
  // Which blocks are on the wrong side and near enough to change it.
  void MarkBlocks()
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    std::vector<std::size_t> counts(blocks.NumberOfVoxels(), 0);
    this->Grid.ForEachRun(this->Mask, this->Parallel,
      [&](std::size_t block, int begin, int end, int, int) { counts[block] += end - begin; });
    this->IsRight.assign(counts.size(), 0);
    const std::size_t half = (this->Grid.VoxelsPerBlock() + 1) / 2;
    const double domain = DomainOf(this->Wanted);
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      this->IsRight[block] =
        block != this->OwnBlock && (counts[block] >= half) == this->Wanted.IsInside ? 1 : 0;
    }
    this->Nodes = BlockNodes(counts.size(),
      [&](std::size_t block)
      {
        return !this->IsRight[block] &&
          (block == this->OwnBlock ||
            (this->Grid.CenterOf(block) - this->Wanted.Point).norm() <= domain);
      });
  }

  // Of an outside point. False if the monitor stopped it.
  bool LookForDepth(const Monitor& monitor)
  {
    std::vector<unsigned char> wrong(this->Nodes.NumberOfBlocks());
    for (std::size_t block = 0; block < wrong.size(); ++block)
    {
      wrong[block] = this->Nodes.IsNode(block) ? 1 : 0;
    }
    const double spread =
      std::max(this->Similarity.SpreadOf(this->OfPoint), this->Similarity.SpreadOf(this->OfSeed));
    const bool looksLikeSeed =
      std::abs(this->OfPoint.Median - this->OfSeed.Median) < LikeSeedDeviations * spread;
    if (!FindLeakDepth(wrong, this->Grid, this->Wanted.Point, this->Seed, looksLikeSeed,
          this->Parallel, monitor, this->Depth))
    {
      return false;
    }
    if (this->Depth.IsDeep)
    {
      const double way = (this->Wanted.Point - this->Seed.Center).norm() - 0.5 * this->Seed.Radius;
      this->Reach = std::min(std::max(this->Reach, this->Wanted.Away), PartOfWayToSeed * way);
    }
    return true;
  }

  // How far around an inside point most voxels look like it or like the organ, for a part of the
  // way to the organ. A ball across the boundary would look like anything.
  double ReachOfOrgan() const
  {
    const double away = this->Wanted.Away;
    const double limit =
      std::min({ GreatestReach, away, std::max(DeepAway, PartOfWayToOrgan * away) });
    const RobustStatistics point = this->PointWithoutVariety();
    const ImageGeometry& voxels = this->Grid.Voxels;
    AlikeShells shells(voxels.Spacing.maxCoeff(), limit);
    for (const std::size_t voxel : VoxelsInSphere(voxels, { this->Wanted.Point, limit }))
    {
      const std::array<int, 3> index = IndexOf(voxel, voxels);
      const Eigen::Vector3d place =
        voxels.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
      const float value = this->Image.Row(index[1], index[2])[index[0]];
      shells.Add((place - this->Wanted.Point).norm(),
        this->Similarity.LikenessOf(value, point) > 0 ||
          this->Similarity.LikenessOf(value, this->OfOrgan) > 0);
    }
    return shells.Reach();
  }

  double Decay() const
  {
    const double depth = (this->Wanted.Away - NearAway) / (DeepAway - NearAway);
    const double part = std::max(0.0, std::min(1.0, depth));
    return DecayOfNearPoint + part * (DecayOfDeepPoint - DecayOfNearPoint);
  }

  // The point's surroundings, as varied as the seed's: a small ball does not show how much the gray
  // values of an organ vary.
  RobustStatistics PointAsOrgan() const
  {
    RobustStatistics organ = this->OfPoint;
    organ.StandardDeviation = std::max(organ.StandardDeviation, this->OfSeed.StandardDeviation);
    return organ;
  }

  RobustStatistics PointWithoutVariety() const
  {
    RobustStatistics point = this->OfPoint;
    point.StandardDeviation = std::min(point.StandardDeviation,
      VarietyInSeedSpreads * this->Similarity.SpreadOf(this->OfSeed));
    return point;
  }

  double Smoothness() const
  {
    const auto clamped = [](double length, double least)
    { return std::max(least, std::min(GreatestReach, length)); };
    if (this->Depth.HasNeck)
    {
      constexpr double least = 5;
      return NeckSmoothness * clamped(BallInside(this->Mask, this->Seed).Radius, least);
    }
    return (this->Wanted.IsInside ? InsideSmoothness : OutsideSmoothness) *
      clamped(this->Reach, LeastReach);
  }

  double WorthOf(double value, const Eigen::Vector3d& place) const
  {
    const double away = (place - this->Wanted.Point).norm();
    if (this->Wanted.IsInside)
    {
      return std::max(InsideGain * this->Similarity.LikenessOf(value, this->PointAsOrgan()) -
          this->Decay() * Beyond(away, this->Reach),
        InsideGain * this->Similarity.LikenessOf(value, this->OfOrgan) -
          DecayOfNearPoint * Beyond(away, this->OrganReach));
    }
    const double beyond = Beyond(away, this->Reach);
    const double likeness = this->Similarity.LikenessOf(value, this->PointWithoutVariety());
    const double likeOrgan = std::max(this->Similarity.LikenessOf(value, this->OfSeed),
      this->Similarity.LikenessOf(value, this->OfOrgan));
    if (this->Depth.HasNeck)
    {
      return -NeckBase - NeckGain * likeOrgan;
    }
    const double unlike = OutsideGain * (likeness - likeOrgan);
    if (!this->Depth.IsDeep)
    {
      // Farther away nothing gains by going.
      return away > LocalPart * std::max(LeastLocal, this->Wanted.Away)
        ? std::min(0.0, unlike - this->Decay() * beyond)
        : unlike - this->Decay() * beyond;
    }
    double toKept = (place - this->Seed.Center).norm() - this->Seed.Radius;
    for (const SeedSphere& ball : this->Wanted.Kept)
    {
      toKept = std::min(toKept, (place - ball.Center).norm() - ball.Radius);
    }
    const double nearer = (toKept - (away - this->Reach)) / std::max(1.0, this->Reach);
    return unlike + NearerGain * std::max(-1.0, std::min(1.0, nearer)) -
      NearerDecay * std::max(0.0, beyond - 1);
  }

  CutNetwork MakeNetwork() const
  {
    const std::vector<float> smooth = SmoothBlockMeans(this->Image, this->Grid, this->Parallel);
    BlockLinks links;
    links.PerArea = this->Smoothness();
    links.EdgeContrast =
      3 * std::max({ this->OfPoint.StandardDeviation, 0.5 * this->Noise, LeastDeviation });
    CutNetwork network = MakeBlockNetwork(
      this->Grid.Blocks, this->Nodes, smooth, links,
      [&](std::size_t block) { return this->WorthOf(smooth[block], this->Grid.CenterOf(block)); },
      [this](std::size_t block) { return this->IsRight[block] ? 1 : -1; }, this->Parallel);
    for (std::size_t block = 0; block < this->Nodes.NumberOfBlocks(); ++block)
    {
      if (this->Nodes.IsNode(block))
      {
        this->SetCertain(block, network[this->Nodes[block]].Terminal);
      }
    }
    network[this->Nodes[this->OwnBlock]].Terminal = CutNode::Infinite;
    return network;
  }

  void SetCertain(std::size_t block, std::int32_t& terminal) const
  {
    const Eigen::Vector3d place = this->Grid.CenterOf(block);
    const Eigen::Vector3d& point = this->Wanted.Point;
    if ((place - point).norm() <= CertainPart * this->Reach ||
      (this->Depth.HasNeck && this->Depth.IsCore[block]))
    {
      terminal = CutNode::Infinite;
    }
    for (const SeedSphere& ball : this->Wanted.Kept)
    {
      const double radius = std::min(CertainPart * ball.Radius, 0.5 * (ball.Center - point).norm());
      if ((place - ball.Center).norm() <= radius)
      {
        terminal = -CutNode::Infinite;
      }
    }
  }

  // Blocks at the rim that were mostly right follow their neighbors.
  void Apply(const std::vector<unsigned char>& switched)
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    const auto isSwitched = [&](int i, int j, int k)
    {
      const int node =
        blocks.Contains(i, j, k) ? this->Nodes[blocks.Offset(i, j, k)] : CutNode::NoNeighbor;
      return node >= 0 && switched[node] != 0;
    };
    for (int k = 0; k < blocks.Dimensions[2]; ++k)
    {
      for (int j = 0; j < blocks.Dimensions[1]; ++j)
      {
        for (int i = 0; i < blocks.Dimensions[0]; ++i)
        {
          const bool changes = this->IsRight[blocks.Offset(i, j, k)]
            ? isSwitched(i - 1, j, k) || isSwitched(i + 1, j, k) || isSwitched(i, j - 1, k) ||
              isSwitched(i, j + 1, k) || isSwitched(i, j, k - 1) || isSwitched(i, j, k + 1)
            : isSwitched(i, j, k);
          if (changes)
          {
            this->Grid.SetBlock(this->Wanted.IsInside, i, j, k, this->Mask);
          }
        }
      }
    }
  }

  const ImagePart Image;
  const SeedSphere& Seed;
  const Correction& Wanted;
  double Reach;
  double OrganReach = 0; // of an inside point
  const double Noise;
  const GrayValueSimilarity Similarity;
  const ParallelFor& Parallel;
  BitMask& Mask;
  const BlockGrid Grid;
  const RobustStatistics OfPoint;
  const RobustStatistics OfSeed;
  const RobustStatistics OfOrgan;
  const std::size_t OwnBlock; // the point's

  std::vector<unsigned char> IsRight;
  BlockNodes Nodes;
  LeakDepth Depth;
};

} // namespace

double DomainOf(const Correction& correction)
{
  return correction.IsInside
    ? LocalPart * std::max({ LeastLocal, correction.Away, correction.Reach })
    : std::numeric_limits<double>::infinity();
}

bool CutCorrection(const ImagePart& image, const SeedSphere& seed, const Correction& correction,
  double noise, Modality modality, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask)
{
  return Cut(image, seed, correction, noise, modality, parallelFor, mask).Execute(monitor);
}

} // namespace FlipFree

#include "Intensity/CorrectionCut.h"

#include "Image/BallInside.h"
#include "Image/BlockNetwork.h"
#include "Image/DepthHill.h"
#include "Image/DistanceTransform.h"
#include "Intensity/RobustStatistics.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Of the reach: what changes sides in any case.
constexpr double CertainPart = 0.8;

// What a voxel is worth that looks like the point's ball (inside), or more so than like the seed's
// (outside); and what it loses for each reach that it is farther away than the reach.
constexpr double InsideGain = 0.3;
constexpr double InsideDecay = 0.3;
constexpr double OutsideGain = 0.1;
constexpr double OutsideDecay = 0.3;
// Gray values look alike within this many standard deviations.
constexpr double AlikeDeviations = 2;
// What a cut costs per mm2 and millimeter of reach, of which these count.
constexpr double InsideSmoothness = 0.2;
constexpr double OutsideSmoothness = 0.1;
constexpr double LeastReach = 3;
constexpr double GreatestReach = 40;

// A neck is narrower than this part of the hill's depth, whose core is deeper than the other part.
constexpr double NeckRatio = 0.85;
constexpr double CoreDepth = 0.6;
constexpr double NeckBase = 0.3;
constexpr double NeckGain = 0.3;
constexpr double NeckSmoothness = 0.2;

// A point in the depth of what looks like the seed: no deeper place is farther away than this part
// of its depth, or it is deeper than an organ is by so many seed radii. Its reach is at most this
// part of the way to the seed; what is nearer to it than to the seed is worth so much, and loses so
// much for each reach beyond twice the reach.
constexpr double LikeSeedDeviations = 2.5;
constexpr double PeakPart = 0.5;
constexpr double DeepInSeedRadii = 1.5;
constexpr double PartOfWayToSeed = 0.6;
constexpr double NearerGain = 0.2;
constexpr double NearerDecay = 0.1;

// The ball whose gray values stand for the point's surroundings, in reaches and millimeters.
constexpr double BallPart = 0.7;
constexpr double LeastBall = 2;
constexpr double GreatestBall = 8;

// Shells about a point look like it as long as this part of their voxels lies within so many
// deviations of the innermost ball's median; the ball in millimeters and voxels.
constexpr double AlikePart = 0.5;
constexpr double ShellDeviations = 2.5;
constexpr double FirstBall = 3;
constexpr double FirstBallVoxels = 1.5;

// The least standard deviation that gray values are compared by.
double LeastSpread(const RobustStatistics& of, double noise, bool isMR)
{
  constexpr double ofMR = 0.03; // of the median
  constexpr double ofCT = 5;    // Hounsfield units
  return std::max({ 0.5 * noise, isMR ? ofMR * std::abs(of.Median) : ofCT, 1e-12 });
}

double SpreadOf(const RobustStatistics& of, double noise, bool isMR)
{
  return std::max(of.StandardDeviation, LeastSpread(of, noise, isMR));
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
    , IsMR(modality == Modality::MR)
    , Parallel(parallelFor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), std::max(1.0, std::min(2.0, correction.Reach / 4)))
    , OfPoint(this->MeasureBall(correction.Point,
        std::max(LeastBall, std::min(GreatestBall, BallPart * correction.Reach))))
    , OfSeed(this->MeasureBall(seed.Center, seed.Radius))
  {
  }

  bool Execute(const Monitor& monitor)
  {
    this->MarkBlocks();
    if (!this->Wanted.IsInside && !this->LookForDepth(monitor))
    {
      return false;
    }
    const std::vector<unsigned char> switched = SourceSide(this->MakeNetwork(), monitor);
    if (switched.empty())
    {
      return false;
    }
    this->Apply(switched);
    return true;
  }

private:
  RobustStatistics MeasureBall(const Eigen::Vector3d& center, double radius) const
  {
    const ImageGeometry& geometry = this->Mask.GetGeometry();
    std::vector<float> values;
    const auto add = [&](const std::array<int, 3>& voxel)
    { values.push_back(this->Image.Row(voxel[1], voxel[2])[voxel[0]]); };
    for (const std::size_t voxel : VoxelsInSphere(geometry, { center, radius }))
    {
      const auto& size = geometry.Dimensions;
      const std::size_t row = voxel / size[0];
      add({ { static_cast<int>(voxel % size[0]), static_cast<int>(row % size[1]),
        static_cast<int>(row / size[1]) } });
    }
    if (values.empty())
    {
      add(NearestVoxel(geometry, center));
    }
    return RobustStatisticsOf(values);
  }

  std::size_t BlockOf(const Eigen::Vector3d& point) const
  {
    const std::array<int, 3> voxel = NearestVoxel(this->Mask.GetGeometry(), point);
    const std::array<int, 3>& factor = this->Grid.Factor;
    return this->Grid.Blocks.Offset(voxel[0] / factor[0], voxel[1] / factor[1],
      voxel[2] / factor[2]);
  }

  Eigen::Vector3d CenterOf(std::size_t block) const
  {
    const auto& size = this->Grid.Blocks.Dimensions;
    const std::size_t row = block / size[0];
    const std::array<std::size_t, 3> index{ { block % size[0], row % size[1], row / size[1] } };
    return this->Grid.Blocks.ToPhysical(Eigen::Vector3d(static_cast<double>(index[0]),
      static_cast<double>(index[1]), static_cast<double>(index[2])));
  }

  // Which blocks are on the wrong side and near enough to change it.
  void MarkBlocks()
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    std::vector<std::size_t> counts(blocks.NumberOfVoxels(), 0);
    this->Grid.ForEachRun(this->Mask, this->Parallel,
      [&](std::size_t block, int begin, int end, int, int) { counts[block] += end - begin; });
    this->IsRight.assign(counts.size(), 0);
    this->Nodes.assign(counts.size(), CutNode::NoNeighbor);
    const std::size_t half = (this->Grid.VoxelsPerBlock() + 1) / 2;
    const double domain = DomainOf(this->Wanted);
    const std::size_t own = this->BlockOf(this->Wanted.Point);
    int nodes = 0;
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      this->IsRight[block] =
        block != own && (counts[block] >= half) == this->Wanted.IsInside ? 1 : 0;
      if (!this->IsRight[block] &&
        (block == own || (this->CenterOf(block) - this->Wanted.Point).norm() <= domain))
      {
        this->Nodes[block] = nodes++;
      }
    }
  }

  // Of an outside point: what it lies in, a part that hangs on by a neck or the depth of what looks
  // like the seed. False if the monitor stopped it.
  bool LookForDepth(const Monitor& monitor)
  {
    std::vector<unsigned char> wrong(this->Nodes.size());
    std::transform(this->Nodes.begin(), this->Nodes.end(), wrong.begin(),
      [](int node) { return static_cast<unsigned char>(node >= 0); });
    const std::vector<float> depth =
      SquaredDistance(wrong, this->Grid.Blocks, 0, this->Parallel, monitor);
    if (depth.empty())
    {
      return false;
    }
    const double spread = std::max(SpreadOf(this->OfPoint, this->Noise, this->IsMR),
      SpreadOf(this->OfSeed, this->Noise, this->IsMR));
    this->IsDeep =
      std::abs(this->OfPoint.Median - this->OfSeed.Median) < LikeSeedDeviations * spread &&
      (this->IsTooDeep(depth) || this->IsOnTop(depth));
    if (this->IsDeep)
    {
      const double way = (this->Wanted.Point - this->Seed.Center).norm() - 0.5 * this->Seed.Radius;
      this->Reach = std::max(this->Reach, std::min(this->Wanted.Away, PartOfWayToSeed * way));
    }
    const std::size_t own = this->BlockOf(this->Wanted.Point);
    const DepthHill hill =
      FindDepthHill(depth, this->Grid.Blocks, own, this->BlockOf(this->Seed.Center));
    this->HasNeck = !hill.Holds.empty() && this->IsOnTop(depth) &&
      std::sqrt(hill.Saddle) < NeckRatio * std::sqrt(hill.Peak);
    this->IsCore.assign(depth.size(), false);
    if (this->HasNeck)
    {
      const double least = std::max<double>(hill.Saddle, CoreDepth * CoreDepth * hill.Peak);
      for (std::size_t block = 0; block < depth.size(); ++block)
      {
        this->IsCore[block] = hill.Holds[block] && depth[block] >= least;
      }
    }
    return true;
  }

  // Deeper than the organ can be, as far as the seed tells.
  bool IsTooDeep(const std::vector<float>& squaredDepth) const
  {
    return std::sqrt(squaredDepth[this->BlockOf(this->Wanted.Point)]) >
      DeepInSeedRadii * this->Seed.Radius;
  }

  // Else the point lies on the slope of some other depth, such as the organ's own.
  bool IsOnTop(const std::vector<float>& squaredDepth) const
  {
    const double depth = std::sqrt(squaredDepth[this->BlockOf(this->Wanted.Point)]);
    double most = 0;
    double away = 0;
    for (std::size_t block = 0; block < squaredDepth.size(); ++block)
    {
      if (squaredDepth[block] > most)
      {
        const double distance = (this->CenterOf(block) - this->Wanted.Point).norm();
        if (distance <= depth)
        {
          most = squaredDepth[block];
          away = distance;
        }
      }
    }
    return away < PeakPart * depth;
  }

  double Smoothness() const
  {
    const auto clamped = [](double length, double least)
    { return std::max(least, std::min(GreatestReach, length)); };
    if (this->HasNeck)
    {
      constexpr double least = 5;
      return NeckSmoothness * clamped(BallInside(this->Mask, this->Seed).Radius, least);
    }
    return (this->Wanted.IsInside ? InsideSmoothness : OutsideSmoothness) *
      clamped(this->Reach, LeastReach);
  }

  // From -1, nothing like it, to 1.
  double LikenessOf(double value, const RobustStatistics& of) const
  {
    const double deviations = (value - of.Median) / SpreadOf(of, this->Noise, this->IsMR);
    const double fit = (AlikeDeviations * AlikeDeviations - deviations * deviations) / 4;
    return std::max(-1.0, std::min(1.0, fit));
  }

  double WorthOf(double value, const Eigen::Vector3d& place) const
  {
    const double away = (place - this->Wanted.Point).norm();
    const double beyond = std::max(0.0, (away - this->Reach) / std::max(1.0, this->Reach));
    const double likeness = this->LikenessOf(value, this->OfPoint);
    if (this->Wanted.IsInside)
    {
      return InsideGain * likeness - InsideDecay * beyond;
    }
    const double likeSeed = this->LikenessOf(value, this->OfSeed);
    if (this->HasNeck)
    {
      return -NeckBase - NeckGain * likeSeed;
    }
    const double unlike = OutsideGain * (likeness - likeSeed);
    if (!this->IsDeep)
    {
      return unlike - OutsideDecay * beyond;
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
      3 * std::max({ this->OfPoint.StandardDeviation, 0.5 * this->Noise, 1e-12 });
    CutNetwork network = MakeBlockNetwork(
      this->Grid.Blocks, this->Nodes, smooth, links,
      [&](std::size_t block) { return this->WorthOf(smooth[block], this->CenterOf(block)); },
      [this](std::size_t block) { return this->IsRight[block] ? 1 : -1; }, this->Parallel);
    for (std::size_t block = 0; block < this->Nodes.size(); ++block)
    {
      if (this->Nodes[block] >= 0)
      {
        this->SetCertain(block, network[this->Nodes[block]].Terminal);
      }
    }
    network[this->Nodes[this->BlockOf(this->Wanted.Point)]].Terminal = CutNode::Infinite;
    return network;
  }

  void SetCertain(std::size_t block, std::int32_t& terminal) const
  {
    const Eigen::Vector3d place = this->CenterOf(block);
    const Eigen::Vector3d& point = this->Wanted.Point;
    if ((place - point).norm() <= CertainPart * this->Reach ||
      (this->HasNeck && this->IsCore[block]))
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
            this->SetBlock(i, j, k);
          }
        }
      }
    }
  }

  void SetBlock(int i, int j, int k)
  {
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const std::array<int, 3>& factor = this->Grid.Factor;
    const int end = std::min(size[0], (i + 1) * factor[0]);
    for (int z = k * factor[2]; z < std::min(size[2], (k + 1) * factor[2]); ++z)
    {
      for (int y = j * factor[1]; y < std::min(size[1], (j + 1) * factor[1]); ++y)
      {
        this->Mask.SetRun(this->Wanted.IsInside, i * factor[0], end, y, z);
      }
    }
  }

  const ImagePart Image;
  const SeedSphere& Seed;
  const Correction& Wanted;
  double Reach;
  const double Noise;
  const bool IsMR;
  const ParallelFor& Parallel;
  BitMask& Mask;
  const BlockGrid Grid;
  const RobustStatistics OfPoint;
  const RobustStatistics OfSeed;

  std::vector<unsigned char> IsRight;
  std::vector<int> Nodes;
  bool IsDeep = false;
  bool HasNeck = false;
  std::vector<bool> IsCore;
};

} // namespace

double DomainOf(const Correction& correction)
{
  constexpr double least = 30;
  return correction.IsInside ? std::max(least, 2 * correction.Reach)
                             : std::numeric_limits<double>::infinity();
}

double ReachOfLikeness(const ImageView<float>& image, const Eigen::Vector3d& point, double limit,
  double noise, Modality modality)
{
  const ImageGeometry& geometry = image.Geometry;
  const double step = geometry.Spacing.maxCoeff();
  const double first = std::max(FirstBall, FirstBallVoxels * geometry.Spacing.minCoeff());
  const VoxelBox box = BoxAround(geometry, point, std::max(limit, first));
  std::vector<float> inner;
  std::vector<std::vector<float>> shells(static_cast<std::size_t>(limit / step) + 2);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        const double away = (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm();
        if (away <= first)
        {
          inner.push_back(image(i, j, k));
        }
        const auto shell = static_cast<std::size_t>(away / step);
        if (shell < shells.size())
        {
          shells[shell].push_back(image(i, j, k));
        }
      }
    }
  }
  const RobustStatistics of = RobustStatisticsOf(inner);
  const double spread = SpreadOf(of, noise, modality == Modality::MR);
  double reach = step;
  for (std::size_t shell = 0; shell < shells.size(); ++shell)
  {
    const auto alike = std::count_if(shells[shell].begin(), shells[shell].end(),
      [&](float value) { return std::abs(value - of.Median) < ShellDeviations * spread; });
    if (static_cast<double>(alike) < AlikePart * static_cast<double>(shells[shell].size()))
    {
      break;
    }
    reach = static_cast<double>(shell + 1) * step;
  }
  return std::min(reach, limit);
}

bool CutCorrection(const ImagePart& image, const SeedSphere& seed, const Correction& correction,
  double noise, Modality modality, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask)
{
  return Cut(image, seed, correction, noise, modality, parallelFor, mask).Execute(monitor);
}

} // namespace FlipFree

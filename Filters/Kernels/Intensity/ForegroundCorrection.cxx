#include "Intensity/ForegroundCorrection.h"

#include "Image/BallInside.h"
#include "Image/BlockGrid.h"
#include "Image/DistanceTransform.h"
#include <numeric>
#include "Image/GaussianSmoothing.h"
#include "Image/ImagePart.h"
#include "Image/MinimumCut.h"
#include "Intensity/LeakControl.h"
#include "Intensity/RobustStatistics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstdio>
#include <limits>
#include <string>

namespace FlipFree
{
// DEBUG
double PeakRule = 0, PeakPart = 0.5, VGain = 0, VDecay = 0.3, VHalf = 0.6, LikeSeed = 1.5, Bridge = 1, InLike = 1, OutLike = 1, InMax = 40, DepthScale = 0, NeckLimit = 0, Base = 0, Gain = 0.3, Decay = 0.3, Area = 0.2, HardPart = 0.8, DomainScale = 2, DomainLeast = 30, MinBlock = 2,
       SpreadFloor = 5, ZCut = 2, Links = 1, OutBase = 0, OutGain = 0.2, OutDecay = 0.3, CoreDepth = 0.6, OutArea = 0.1, OutSeedR = 1, DecayLength = 1, NeckRatio = 0.85, NeckBase = 0.3, NeckGain = 0.3, NeckArea = 0.2, MaxReach = 20, ShellPart = 0.5, ShellZ = 2.5, FirstBall = 3;
namespace
{
const double EdgeSmoothing = 1;
constexpr double GreatestCapacity = 1 << 20;
constexpr double GreatestJump = 24;

// The squared distance from a point to the nearest voxel center on a side of the mask; infinite
// without any.
double SquaredDistanceTo(const BitMask& mask, bool side, const Eigen::Vector3d& point)
{
  BitMask sought = mask;
  if (!side)
  {
    sought.Complement();
  }
  const ImageGeometry& geometry = mask.GetGeometry();
  const Eigen::Vector3d center = geometry.ToIndex(point);
  double least = std::numeric_limits<double>::infinity();
  sought.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const double i = std::max<double>(begin, std::min(center[0], end - 1.0));
      const Eigen::Vector3d away = Eigen::Vector3d(i, j, k) - center;
      least = std::min(least, away.cwiseProduct(geometry.Spacing).squaredNorm());
    });
  return least;
}

std::array<int, 3> VoxelOf(const ImageGeometry& geometry, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d index = geometry.ToIndex(point);
  std::array<int, 3> voxel;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = std::max(0,
      std::min(geometry.Dimensions[axis] - 1, static_cast<int>(std::floor(index[axis] + 0.5))));
  }
  return voxel;
}

void Set(BitMask& mask, bool inside, int begin, int end, int j, int k)
{
  if (inside)
  {
    mask.InsertRun(begin, end, j, k);
    return;
  }
  for (int i = begin; i < end; ++i)
  {
    mask.Row(j, k)[i / BitMask::BitsOfWord] &= ~(BitMask::Word(1) << (i % BitMask::BitsOfWord));
  }
}

// The voxels within a distance of a point, and the point's own.
void SetBall(BitMask& mask, bool inside, const Eigen::Vector3d& point, double radius)
{
  const ImageGeometry& geometry = mask.GetGeometry();
  const VoxelBox box = BoxAround(geometry, point, radius);
  const std::array<int, 3> own = VoxelOf(geometry, point);
  Set(mask, inside, own[0], own[0] + 1, own[1], own[2]);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm() <= radius)
        {
          Set(mask, inside, i, i + 1, j, k);
        }
      }
    }
  }
}

// One point's.
class Correction
{
public:
  Correction(const ImagePart& image, const SeedSphere& seed, const PointConstraint& constraint, double reach, double away,
    double domain, const std::vector<SeedSphere>& balls, double noise, Modality modality,
    const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
    : Image(image)
    , Seed(seed)
    , Point(constraint.Point)
    , Reach(reach)
    , Away(away)
    , Domain(domain)
    , IsInside(constraint.Kind != ConstraintKind::Outside)
    , Protected(balls)
    , Noise(noise)
    , IsMR(modality == Modality::MR)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), std::max(1.0, std::min(MinBlock, reach / 4)))
    , Size(Grid.Blocks.Dimensions)
  {
  }

  bool Execute()
  {
    this->OfBall = this->MeasureBall(this->Point, std::max(2.0, std::min(8.0, 0.7 * this->Reach)));
    this->OfSeed = this->MeasureBall(this->Seed.Center, this->Seed.Radius);
    const double ofBoth = std::max({ this->OfBall.StandardDeviation, this->OfSeed.StandardDeviation, 0.5 * this->Noise, this->IsMR ? 0.03 * std::abs(this->OfSeed.Median) : SpreadFloor, 1e-12 });
    this->IsLikeSeed = !this->IsInside && VGain > 0 && std::abs(this->OfBall.Median - this->OfSeed.Median) < LikeSeed * ofBoth;
    this->MarkBlocks();
    if (this->IsLikeSeed && PeakRule > 0)
    {
      this->IsLikeSeed = this->IsAtPeak();
    }
    if (this->IsLikeSeed)
    {
      this->Reach = std::max(this->Reach, std::min(this->Away, VHalf * ((this->Point - this->Seed.Center).norm() - 0.5 * this->Seed.Radius)));
    }
    this->FindCore();
    CutNetwork network = this->MakeNetwork();
    const std::vector<unsigned char> switched = SourceSide(network, this->Ask);
    if (switched.empty())
    {
      return false;
    }
    this->Apply(switched);
    if (std::getenv("DBG")) std::fprintf(stderr, "  %s reach %.1f nodes %d switched %d block %.1f\n", this->IsInside ? "in" : "out", this->Reach, this->NumberOfNodes, (int)std::count(switched.begin(), switched.end(), 1), std::cbrt(this->Grid.Blocks.VoxelVolume()));
    return true;
  }

private:
  bool IsAtPeak() const
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    const auto own = this->BlockOf(this->Point);
    const double depth = std::sqrt(this->Depth[blocks.Offset(own[0], own[1], own[2])]);
    double most = 0;
    Eigen::Vector3d peak = this->Point;
    for (int k = 0; k < this->Size[2]; ++k)
      for (int j = 0; j < this->Size[1]; ++j)
        for (int i = 0; i < this->Size[0]; ++i)
        {
          const Eigen::Vector3d at = blocks.ToPhysical(Eigen::Vector3d(i, j, k));
          const double value = this->Depth[blocks.Offset(i, j, k)];
          if (value > most && (at - this->Point).norm() <= depth)
          {
            most = value;
            peak = at;
          }
        }
    const double away = (peak - this->Point).norm();
    if (PeakRule > 2.5) return away < (peak - this->Seed.Center).norm() && away < PeakPart * depth;
    if (PeakRule > 1.5) return away < (peak - this->Seed.Center).norm();
    return away < PeakPart * depth;
  }

  // What hangs together with the point at a depth at which it does not hang together with the seed.
  void FindCore()
  {
    this->IsCore.assign(this->Nodes.size(), 0);
    if (this->IsInside)
    {
      return;
    }
    std::vector<unsigned char> wrong(this->Nodes.size());
    std::transform(this->Nodes.begin(), this->Nodes.end(), wrong.begin(), [](int node) { return node >= 0; });
    const ImageGeometry& blocks = this->Grid.Blocks;
    const std::vector<float> depth = SquaredDistance(wrong, blocks, 0, this->Parallel, NeverStop);
    std::vector<std::size_t> order;
    for (std::size_t block = 0; block < wrong.size(); ++block)
    {
      if (wrong[block])
      {
        order.push_back(block);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    std::vector<int> root(wrong.size(), -1);
    std::vector<float> peak(wrong.size(), 0);
    const auto find = [&](int block)
    {
      while (root[block] != block)
      {
        root[block] = root[root[block]];
        block = root[block];
      }
      return block;
    };
    const auto at = [&](const Eigen::Vector3d& point) { const auto b = this->BlockOf(point); return static_cast<int>(blocks.Offset(b[0], b[1], b[2])); };
    const int own = at(this->Point);
    const int seed = at(this->Seed.Center);
    const std::array<std::ptrdiff_t, 3> step{ { 1, this->Size[0], static_cast<std::ptrdiff_t>(this->Size[0]) * this->Size[1] } };
    std::vector<int> before; // of the point's component, before a block was added
    float saddle = 0;
    int kept = -1;
    for (const std::size_t block : order)
    {
      const int b = static_cast<int>(block);
      root[b] = b;
      peak[b] = depth[b];
      const int ownBefore = root[own] >= 0 && b != own ? find(own) : -1;
      const std::array<int, 3> index{ { b % this->Size[0], b / this->Size[0] % this->Size[1], b / this->Size[0] / this->Size[1] } };
      std::vector<int> joined;
      for (int way = 0; way < 6; ++way)
      {
        const int axis = way / 2;
        const bool up = way % 2 == 1;
        if (up ? index[axis] + 1 >= this->Size[axis] : index[axis] == 0)
        {
          continue;
        }
        const std::ptrdiff_t other = b + (up ? step[axis] : -step[axis]);
        if (root[other] >= 0)
        {
          joined.push_back(find(static_cast<int>(other)));
        }
      }
      const int seedRoot = root[seed] >= 0 ? find(seed) : -1;
      const bool meets = ownBefore >= 0 && seedRoot >= 0 && ownBefore != seedRoot &&
        std::find(joined.begin(), joined.end(), ownBefore) != joined.end() && std::find(joined.begin(), joined.end(), seedRoot) != joined.end();
      if (meets)
      {
        saddle = depth[b];
        kept = ownBefore;
        break;
      }
      for (int other : joined)
      {
        const int r = find(b), o = find(other);
        if (r != o)
        {
          const float most = std::max(peak[r], peak[o]);
          root[r] = o;
          peak[o] = most;
        }
      }
      if (root[own] >= 0 && root[seed] >= 0 && find(own) == find(seed))
      {
        break;
      }
    }
    if (kept < 0)
    {
      if (std::getenv("DBG")) std::fprintf(stderr, "no hill: own %d (%d) depth %.1f seed %d (%d) depth %.1f\n", own, root[own], std::sqrt(depth[own]), seed, root[seed], std::sqrt(depth[seed]));
      return;
    }
    if (std::getenv("DBG")) std::fprintf(stderr, "hill: reach %.1f saddle %.1f peak %.1f seed depth %.1f\n", this->Reach, std::sqrt(saddle), std::sqrt(peak[kept]), std::sqrt(depth[seed]));
    this->HasNeck = std::sqrt(saddle) < NeckRatio * std::sqrt(peak[kept]);
    if (!this->HasNeck)
    {
      return;
    }
    const double least = std::max<double>(saddle, CoreDepth * CoreDepth * peak[kept]);
    for (const std::size_t block : order)
    {
      if (depth[block] < saddle || root[block] < 0)
      {
        break;
      }
      if (find(static_cast<int>(block)) == kept && depth[block] >= least)
      {
        this->IsCore[block] = 1;
      }
    }
  }

  RobustStatistics MeasureBall(const Eigen::Vector3d& center, double radius) const
  {
    std::vector<float> values;
    const auto& size = this->Mask.GetGeometry().Dimensions;
    for (const std::size_t voxel : VoxelsInSphere(this->Mask.GetGeometry(), { center, radius }))
    {
      const std::size_t row = voxel / size[0];
      values.push_back(this->Image.Row(static_cast<int>(row % size[1]),
        static_cast<int>(row / size[1]))[voxel % size[0]]);
    }
    if (values.empty())
    {
      const auto own = VoxelOf(this->Mask.GetGeometry(), center);
      values.push_back(this->Image.Row(own[1], own[2])[own[0]]);
    }
    return RobustStatisticsOf(values);
  }

  // Which blocks are on the wrong side and near enough to change it.
  void MarkBlocks()
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    std::vector<std::size_t> counts(blocks.NumberOfVoxels(), 0);
    this->Grid.ForEachRun(this->Mask, this->Parallel,
      [&](std::size_t block, int begin, int end, int, int) { counts[block] += end - begin; });
    this->IsRight.assign(counts.size(), 0);
    this->Nodes.assign(counts.size(), CutNetwork::NoNeighbor);
    const std::size_t half = (this->Grid.VoxelsPerBlock() + 1) / 2;
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          const std::size_t block = blocks.Offset(i, j, k);
          this->IsRight[block] = (counts[block] >= half) == this->IsInside ? 1 : 0;
          const double away = (blocks.ToPhysical(Eigen::Vector3d(i, j, k)) - this->Point).norm();
          if (!this->IsRight[block] && away <= this->Domain)
          {
            this->Nodes[block] = this->NumberOfNodes++;
          }
        }
      }
    }
    if (DepthScale > 0 || PeakRule > 0)
    {
      std::vector<unsigned char> wrong(this->Nodes.size());
      std::transform(this->IsRight.begin(), this->IsRight.end(), wrong.begin(), [](auto right) { return !right; });
      this->Depth = SquaredDistance(wrong, blocks, 0, this->Parallel, NeverStop);
    }
    const auto own = this->BlockOf(this->Point);
    const std::size_t block = blocks.Offset(own[0], own[1], own[2]);
    if (this->Nodes[block] < 0)
    {
      this->IsRight[block] = 0;
      this->Nodes[block] = this->NumberOfNodes++;
    }
  }

  std::array<int, 3> BlockOf(const Eigen::Vector3d& point) const
  {
    std::array<int, 3> block = VoxelOf(this->Mask.GetGeometry(), point);
    for (int axis = 0; axis < 3; ++axis)
    {
      block[axis] /= this->Grid.Factor[axis];
    }
    return block;
  }

  std::vector<float> SmoothBlocks() const
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    std::vector<float> sums(blocks.NumberOfVoxels(), 0.0F);
    std::vector<float> weights(sums.size(), 0.0F);
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const auto& factor = this->Grid.Factor;
    for (int k = 0; k < size[2]; ++k)
    {
      for (int j = 0; j < size[1]; ++j)
      {
        const float* const row = this->Image.Row(j, k);
        const std::size_t first = blocks.Offset(0, j / factor[1], k / factor[2]);
        for (int i = 0; i < size[0]; ++i)
        {
          sums[first + i / factor[0]] += row[i];
          weights[first + i / factor[0]] += 1;
        }
      }
    }
    for (std::size_t block = 0; block < sums.size(); ++block)
    {
      sums[block] /= weights[block];
      weights[block] = 1;
    }
    SmoothGaussian(sums, blocks, EdgeSmoothing, this->Parallel);
    SmoothGaussian(weights, blocks, EdgeSmoothing, this->Parallel);
    for (std::size_t block = 0; block < sums.size(); ++block)
    {
      sums[block] /= weights[block];
    }
    return sums;
  }

  CutNetwork MakeNetwork()
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    CutNetwork network;
    network.Neighbors.resize(this->NumberOfNodes);
    network.Capacities.resize(this->NumberOfNodes);
    network.Terminals.resize(this->NumberOfNodes);
    const std::vector<float> smooth = this->SmoothBlocks();
    const double perArea = this->HasNeck ? NeckArea * std::max(5.0, std::min(40.0, BallInside(this->Mask, this->Seed).Radius)) : (this->IsInside ? Area : OutArea) *
      std::max(3.0, std::min(40.0, this->Reach));
    const double spread = std::max({ this->OfBall.StandardDeviation, 0.5 * this->Noise,
      this->IsMR ? 0.03 * std::abs(this->OfBall.Median) : SpreadFloor, 1e-12 });
    const double spreadSeed = std::max({ this->OfSeed.StandardDeviation, 0.5 * this->Noise,
      this->IsMR ? 0.03 * std::abs(this->OfSeed.Median) : SpreadFloor, 1e-12 });
    const double edge = 3 * std::max({ this->OfBall.StandardDeviation, 0.5 * this->Noise, 1e-12 });
    const double volume = blocks.VoxelVolume();
    const std::array<double, 3> area{ { volume / blocks.Spacing[0], volume / blocks.Spacing[1],
      volume / blocks.Spacing[2] } };
    const double unit = perArea * *std::max_element(area.begin(), area.end()) / GreatestCapacity;
    constexpr std::int32_t greatest = CutNetwork::Infinite / 4;
    const std::array<std::ptrdiff_t, 3> step{ { 1, this->Size[0],
      static_cast<std::ptrdiff_t>(this->Size[0]) * this->Size[1] } };
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          const std::size_t block = blocks.Offset(i, j, k);
          const int node = this->Nodes[block];
          if (node < 0)
          {
            continue;
          }
          const std::array<int, 3> index{ { i, j, k } };
          const double away = (blocks.ToPhysical(Eigen::Vector3d(i, j, k)) - this->Point).norm();
          const double z = (smooth[block] - this->OfBall.Median) / spread;
          const double fit = std::max(-2.0, std::min(2.0, (ZCut * ZCut - z * z) / 2)) / 2;
          const double zs = (smooth[block] - this->OfSeed.Median) / spreadSeed;
          const double fitSeed = std::max(-2.0, std::min(2.0, (ZCut * ZCut - zs * zs) / 2)) / 2;
          const double unary = this->IsInside
            ? Base + Gain * fit - Decay * std::max(0.0, (away - this->Reach) / std::max(DecayLength, this->Reach))
            : this->HasNeck ? -NeckBase - NeckGain * fitSeed : OutBase + OutGain * 0.5 * (fit - fitSeed) + this->Prior(blocks.ToPhysical(Eigen::Vector3d(i, j, k)), away);
          double terminal = unary * volume / unit;
          for (int way = 0; way < 6; ++way)
          {
            const int axis = way / 2;
            const bool up = way % 2 == 1;
            network.Neighbors[node][way] = CutNetwork::NoNeighbor;
            network.Capacities[node][way] = 0;
            if (up ? index[axis] + 1 >= this->Size[axis] : index[axis] == 0)
            {
              continue;
            }
            const std::size_t other = block + (up ? step[axis] : -step[axis]);
            const double jump = (smooth[block] - smooth[other]) / edge;
            const double square = jump * jump < GreatestJump ? jump * jump : GreatestJump;
            const double capacity = perArea * area[axis] / unit * std::exp(-0.5 * square);
            if (this->Nodes[other] >= 0)
            {
              network.Neighbors[node][way] = this->Nodes[other];
              network.Capacities[node][way] = static_cast<std::int32_t>(std::lround(capacity));
            }
            else
            {
              terminal += this->IsRight[other] ? Links * capacity : -capacity;
            }
          }
          const double cap = DepthScale * this->Away + blocks.Spacing.maxCoeff();
          if (DepthScale > 0 && !this->HasNeck && this->Depth[block] > cap * cap)
          {
            terminal = -greatest;
          }
          network.Terminals[node] = away <= HardPart * this->Reach || this->IsCore[block]
            ? CutNetwork::Infinite
            : static_cast<std::int32_t>(
                std::lround(std::max<double>(-greatest, std::min<double>(greatest, terminal))));
        }
      }
    }
    for (const SeedSphere& ball : this->Protected)
    {
      const double radius =
        std::min(HardPart * ball.Radius, 0.5 * (ball.Center - this->Point).norm());
      for (int node = 0, block = 0; block < static_cast<int>(this->Nodes.size()); ++block)
      {
        node = this->Nodes[block];
        if (node >= 0)
        {
          const int i = block % this->Size[0];
          const int j = block / this->Size[0] % this->Size[1];
          const int k = block / this->Size[0] / this->Size[1];
          if ((blocks.ToPhysical(Eigen::Vector3d(i, j, k)) - ball.Center).norm() <= radius)
          {
            network.Terminals[node] = -CutNetwork::Infinite;
          }
        }
      }
    }
    const auto own = this->BlockOf(this->Point);
    network.Terminals[this->Nodes[blocks.Offset(own[0], own[1], own[2])]] = CutNetwork::Infinite;
    return network;
  }

  double Prior(const Eigen::Vector3d& at, double away) const
  {
    const double beyond = std::max(0.0, (away - this->Reach) / std::max(DecayLength, this->Reach));
    if (!this->IsLikeSeed)
    {
      return -OutDecay * beyond;
    }
    double toInside = (at - this->Seed.Center).norm() - this->Seed.Radius;
    for (const SeedSphere& ball : this->Protected)
    {
      toInside = std::min(toInside, (at - ball.Center).norm() - ball.Radius);
    }
    const double nearer = (toInside - (away - this->Reach)) / std::max(DecayLength, this->Reach);
    return VGain * std::max(-1.0, std::min(1.0, nearer)) - VDecay * std::max(0.0, beyond - 1);
  }

  void Apply(const std::vector<unsigned char>& switched)
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const auto& factor = this->Grid.Factor;
    const auto isSwitched = [&](int i, int j, int k)
    {
      if (!blocks.Contains(i, j, k))
      {
        return false;
      }
      const int node = this->Nodes[blocks.Offset(i, j, k)];
      return node >= 0 && switched[node] != 0;
    };
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          const bool changes = this->IsRight[blocks.Offset(i, j, k)]
            ? isSwitched(i - 1, j, k) || isSwitched(i + 1, j, k) || isSwitched(i, j - 1, k) ||
              isSwitched(i, j + 1, k) || isSwitched(i, j, k - 1) || isSwitched(i, j, k + 1)
            : isSwitched(i, j, k);
          if (!changes)
          {
            continue;
          }
          const int end = std::min(size[0], (i + 1) * factor[0]);
          for (int z = k * factor[2]; z < std::min(size[2], (k + 1) * factor[2]); ++z)
          {
            for (int y = j * factor[1]; y < std::min(size[1], (j + 1) * factor[1]); ++y)
            {
              Set(this->Mask, this->IsInside, i * factor[0], end, y, z);
            }
          }
        }
      }
    }
  }

  const ImagePart Image;
  const SeedSphere& Seed;
  const Eigen::Vector3d Point;
  double Reach;
  const double Away;
  const double Domain;
  const bool IsInside;
  const std::vector<SeedSphere>& Protected;
  const double Noise;
  const bool IsMR;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Mask;
  const BlockGrid Grid;
  const std::array<int, 3> Size;

  RobustStatistics OfBall;
  RobustStatistics OfSeed;
  std::vector<unsigned char> IsCore;
  std::vector<float> Depth;
  bool HasNeck = false;
  bool IsLikeSeed = false;
  int NumberOfNodes = 0;
  std::vector<unsigned char> IsRight;
  std::vector<int> Nodes;
};

// How far around a point the image looks like it, at most `limit`.
double LikeReach(const ImageView<float>& image, const Eigen::Vector3d& point, double limit,
  double noise, bool isMR)
{
  const ImageGeometry& geometry = image.Geometry;
  const double step = geometry.Spacing.maxCoeff();
  const double first = std::max(FirstBall, 1.5 * geometry.Spacing.minCoeff());
  const VoxelBox box = BoxAround(geometry, point, std::max(limit, first));
  std::vector<float> inner;
  std::vector<std::vector<float>> shells(static_cast<std::size_t>(std::max(0.0, limit / step)) + 2);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        const double away = (geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - point).norm();
        const auto shell = static_cast<std::size_t>(away / step);
        if (away <= first)
        {
          inner.push_back(image(i, j, k));
        }
        if (shell < shells.size())
        {
          shells[shell].push_back(image(i, j, k));
        }
      }
    }
  }
  const RobustStatistics of = RobustStatisticsOf(inner);
  const double spread = std::max({ of.StandardDeviation, 0.5 * noise,
    isMR ? 0.03 * std::abs(of.Median) : SpreadFloor, 1e-12 });
  double reach = step;
  for (const auto& shell : shells)
  {
    const auto like = std::count_if(shell.begin(), shell.end(),
      [&](float value) { return std::abs(value - of.Median) < ShellZ * spread; });
    if (static_cast<double>(like) < ShellPart * static_cast<double>(shell.size()))
    {
      break;
    }
    reach = (&shell - shells.data() + 1) * step;
  }
  return std::min(reach, limit);
}

// Leads from a point to the nearest voxel of a mask, as wide as a ball.
void SetBridge(const BitMask& main, const Eigen::Vector3d& point, double radius, BitMask& mask)
{
  const ImageGeometry& geometry = main.GetGeometry();
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nearest = point;
  main.ForEachRun(0, geometry.Dimensions[2],
    [&](int begin, int end, int j, int k)
    {
      const double i = std::max<double>(begin, std::min<double>(geometry.ToIndex(point)[0], end - 1.0));
      const Eigen::Vector3d at = geometry.ToPhysical(Eigen::Vector3d(std::round(i), j, k));
      const double square = (at - point).squaredNorm();
      if (square < least)
      {
        least = square;
        nearest = at;
      }
    });
  const int steps = static_cast<int>(std::ceil(std::sqrt(least) / geometry.Spacing.minCoeff()));
  for (int step = 0; step <= steps; ++step)
  {
    SetBall(mask, true, point + (nearest - point) * (static_cast<double>(step) / std::max(1, steps)), radius);
  }
}

bool IsObeyed(const PointConstraint& constraint, const BitMask& mask)
{
  const auto voxel = VoxelOf(mask.GetGeometry(), constraint.Point);
  return constraint.Kind == ConstraintKind::Boundary ||
    mask(voxel[0], voxel[1], voxel[2]) == (constraint.Kind != ConstraintKind::Outside);
}

// What is certain around a point.
double BallOf(const PointConstraint& constraint, const ImageGeometry& geometry)
{
  return std::max(constraint.Radius, 1.01 * geometry.Spacing.maxCoeff());
}

void SetBalls(const ConstraintList& constraints, const SeedSphere& seed, BitMask& mask)
{
  SetBall(mask, true, seed.Center, seed.Radius);
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Inside || constraint.Kind == ConstraintKind::Seed)
    {
      SetBall(mask, true, constraint.Point, BallOf(constraint, mask.GetGeometry()));
    }
  }
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Outside)
    {
      SetBall(mask, false, constraint.Point, BallOf(constraint, mask.GetGeometry()));
    }
  }
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind != ConstraintKind::Boundary)
    {
      SetBall(mask, constraint.Kind != ConstraintKind::Outside, constraint.Point, 0);
    }
  }
}

} // namespace

bool CorrectForeground(const ImageView<float>& smooth, const ImageMaker& make,
  const SeedSphere& seed, const ConstraintList& constraints, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground)
{
  const ImageGeometry& geometry = foreground.GetGeometry();
  ConstraintList open = SortedConstraints(constraints);
  // What has been corrected, so that what follows does not undo it.
  std::vector<SeedSphere> balls[2];
  balls[1].push_back(seed);
  while (true)
  {
    double farthest = -1;
    auto next = open.end();
    for (auto constraint = open.begin(); constraint != open.end(); ++constraint)
    {
      if (!IsObeyed(*constraint, foreground))
      {
        const double square = SquaredDistanceTo(foreground,
          constraint->Kind != ConstraintKind::Outside, constraint->Point);
        if (square > farthest)
        {
          farthest = square;
          next = constraint;
        }
      }
    }
    if (next == open.end())
    {
      break;
    }
    const double limit = std::min(std::sqrt(farthest), next->Kind == ConstraintKind::Outside ? MaxReach : InMax);
    if (!make(BoxAround(geometry, next->Point, std::max(limit, 5.0))))
    {
      return false;
    }
    const double reach = std::max({ (next->Kind == ConstraintKind::Outside ? OutLike : InLike) < 1 ? limit : LikeReach(smooth, next->Point, limit, noise, modality == Modality::MR),
      geometry.Spacing.maxCoeff(), next->Radius });
    const bool isOutside = next->Kind == ConstraintKind::Outside;
    const double domain = isOutside ? 1e4 : std::max(DomainLeast, DomainScale * reach);
    VoxelBox box = BoxAround(geometry, next->Point, isOutside ? 5 : domain)
                     .Joined(BoxAround(geometry, seed.Center, seed.Radius));
    if (isOutside)
    {
      box = box.Joined(foreground.Bounds().Widened({ { 1, 1, 1 } }, WholeBox(geometry)));
    }
    if (!make(box))
    {
      return false;
    }
    BitMask part = foreground.Cropped(box);
    if (!Correction(ImagePart{ smooth, box.Begin }, seed, *next, reach, std::sqrt(farthest), domain, balls[next->Kind == ConstraintKind::Outside ? 1 : 0], noise,
          modality, parallelFor, monitor, part)
           .Execute())
    {
      return false;
    }
    // Replaced.
    BitMask hole(part.GetGeometry());
    hole.Complement();
    BitMask all(geometry);
    all.Insert(hole, box.Begin);
    foreground.Remove(all);
    foreground.Insert(part, box.Begin);
    balls[next->Kind == ConstraintKind::Outside ? 0 : 1].push_back({ next->Point, reach });
    open.erase(next);
  }
  const std::vector<std::size_t> source = VoxelsInSphere(geometry, seed);
  SetBalls(constraints, seed, foreground);
  if (!FillHoles(foreground, monitor))
  {
    return false;
  }
  SetBalls(constraints, seed, foreground);
  if (Bridge > 0)
  {
    BitMask main = foreground;
    if (!source.empty() && !KeepConnected(main, source, monitor)) return false;
    const ConstraintList sorted = SortedConstraints(constraints);
    bool added = false;
    for (const PointConstraint& constraint : sorted)
    {
      const auto at = VoxelOf(geometry, constraint.Point);
      if ((constraint.Kind == ConstraintKind::Inside || constraint.Kind == ConstraintKind::Seed) && !main(at[0], at[1], at[2]))
      {
        SetBridge(main, constraint.Point, std::max(3.0, BallOf(constraint, geometry)), foreground);
        added = true;
      }
    }
    if (added)
    {
      SetBalls(constraints, seed, foreground);
    }
  }
  return source.empty() || KeepConnected(foreground, source, monitor);
}

} // namespace FlipFree

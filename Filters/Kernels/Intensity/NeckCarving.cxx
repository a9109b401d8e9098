#include "Intensity/NeckCarving.h"

#include "Image/BallInside.h"
#include "Image/BlockNetwork.h"
#include "Image/DistanceParts.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"
#include "Intensity/UnaryTerms.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{
namespace
{

// The seed's part that is never cut off, in seed radii.
constexpr double SourceRadius = 0.6;
// Organs in which smaller balls fit are slender (kidneys), and so are their own necks.
constexpr double SmallBall = 12;
// Cores are what lies deeper than this part of the peak's depth; flatter parts are no parts.
constexpr double CoreDepth = 0.6;
constexpr double MinimumPeak = 3;

void Insert(const std::vector<std::size_t>& voxels, BitMask& mask)
{
  for (const std::size_t voxel : voxels)
  {
    const std::array<int, 3> index = IndexOf(voxel, mask.GetGeometry());
    mask.Insert(index[0], index[1], index[2]);
  }
}

class Carving
{
public:
  Carving(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
    const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
    : Image(image)
    , Seed(seed)
    , Ball(BallInside(mask, seed))
    , Noise(noise)
    , IsMR(modality == Modality::MR)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), std::max(1.2, std::min(2.5, this->Ball.Radius / 8)))
    , Size(Grid.Blocks.Dimensions)
    , OfBall(StatisticsInBall(image, Grid.Voxels, Ball))
  {
  }

  bool Execute()
  {
    this->FillBlocks();
    this->SourceBlocks =
      VoxelsAround(this->Grid.Blocks, { this->Seed.Center, SourceRadius * this->Seed.Radius });
    for (const std::size_t block : this->SourceBlocks)
    {
      this->Inside[block] = 1;
    }
    if (!this->FindUnariesAndCores())
    {
      return false;
    }
    const std::vector<unsigned char> kept =
      SourceSide(this->MakeNetwork(), this->Parallel, this->Ask);
    if (kept.empty())
    {
      return false;
    }
    this->RemoveBlocks(kept);
    return true;
  }

private:
  // Which blocks are in the mask, and the sums of their gray values there.
  void FillBlocks()
  {
    const std::size_t count = this->Grid.Blocks.NumberOfVoxels();
    this->Inside.assign(count, 0);
    this->IsTouched.assign(count, false);
    this->Sums = SumInBlocks(this->Image, this->Mask, this->Grid, this->Parallel);
    const auto half = 0.5F * static_cast<float>(this->Grid.VoxelsPerBlock());
    for (std::size_t block = 0; block < count; ++block)
    {
      this->Inside[block] = this->Sums.Weights[block] >= half ? 1 : 0;
      this->IsTouched[block] = this->Sums.Weights[block] > 0;
    }
  }

  // Cores are found by one thread; meanwhile the others find the terms, which do not need them.
  bool FindUnariesAndCores()
  {
    const std::vector<float> distance =
      SquaredDistance(this->Inside, this->Grid.Blocks, 0, this->Parallel, this->Ask);
    if (distance.empty())
    {
      return false;
    }
    this->Parallel(0, 2,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        if (first == 0)
        {
          this->Unaries = FindUnaryTerms(std::move(this->Sums), this->Inside, this->Grid.Blocks,
            { this->Seed.Center, this->Ball.Radius }, this->OfBall.StandardDeviation, this->IsMR,
            this->Parallel);
        }
        if (last == 2)
        {
          this->FindCores(distance);
        }
      });
    return true;
  }

  void FindCores(const std::vector<float>& distance)
  {
    const double ratio = this->Ball.Radius < SmallBall ? 0.5 : 0.7;
    const DistanceParts parts =
      FindDistanceParts(distance, this->Grid.Blocks, this->SourceBlocks, ratio);
    this->IsCore.assign(distance.size(), false);
    for (std::size_t block = 0; block < distance.size(); ++block)
    {
      const int part = parts.PartOf[block];
      this->IsCore[block] = part >= 0 && !parts.HoldsSeed[part] &&
        parts.Peaks[part] >= MinimumPeak * MinimumPeak &&
        distance[block] > CoreDepth * CoreDepth * parts.Peaks[part];
    }
  }

  CutNetwork MakeNetwork()
  {
    this->Nodes = BlockNodes(this->Inside.size(),
      [this](std::size_t block) { return this->Inside[block] != 0; });
    this->KeepUnariesOfNodes();
    BlockLinks links;
    // The smoothness wanted grows with the organ, else small organs collapse.
    links.PerArea = 0.2 * std::max(5.0, std::min(40.0, this->Ball.Radius));
    links.EdgeContrast =
      3 * std::max({ this->OfBall.StandardDeviation, 0.5 * this->Noise, LeastDeviation });
    CutNetwork network = MakeBlockNetwork(
      this->Grid.Blocks, this->Nodes, SmoothBlockMeans(this->Image, this->Grid, this->Parallel),
      links, [this](std::size_t block) { return this->Unaries[this->Nodes[block]]; },
      [](std::size_t) { return -1; }, this->Parallel);
    for (std::size_t block = 0; block < this->IsCore.size(); ++block)
    {
      if (this->IsCore[block] && this->Nodes.IsNode(block))
      {
        network[this->Nodes[block]].Terminal = -CutNode::Infinite;
      }
    }
    for (const std::size_t block : this->SourceBlocks)
    {
      network[this->Nodes[block]].Terminal = CutNode::Infinite;
    }
    std::vector<float>().swap(this->Unaries);
    return network;
  }

  // Numbers the terms as the nodes, and frees what the network does not need.
  void KeepUnariesOfNodes()
  {
    std::vector<float> unaries;
    unaries.reserve(this->Nodes.NumberOfNodes());
    for (std::size_t block = 0; block < this->Unaries.size(); ++block)
    {
      if (this->Nodes.IsNode(block))
      {
        unaries.push_back(this->Unaries[block]);
      }
    }
    this->Unaries.swap(unaries);
    std::vector<unsigned char>().swap(this->Inside);
  }

  // Voxels at the mask's rim whose block is not in the network follow the blocks around.
  void RemoveBlocks(const std::vector<unsigned char>& kept)
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    const auto isRemoved = [&](int i, int j, int k)
    {
      const int own = this->Nodes[blocks.Offset(i, j, k)];
      if (own >= 0)
      {
        return kept[own] == 0;
      }
      int balance = 0;
      for (int z = std::max(0, k - 1); z <= std::min(this->Size[2] - 1, k + 1); ++z)
      {
        for (int y = std::max(0, j - 1); y <= std::min(this->Size[1] - 1, j + 1); ++y)
        {
          for (int x = std::max(0, i - 1); x <= std::min(this->Size[0] - 1, i + 1); ++x)
          {
            const int node = this->Nodes[blocks.Offset(x, y, z)];
            balance += node < 0 ? 0 : (kept[node] ? 1 : -1);
          }
        }
      }
      return balance < 0;
    };
    this->Parallel(0, this->Size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (int k = static_cast<int>(first); k < last; ++k)
        {
          for (int j = 0; j < this->Size[1]; ++j)
          {
            for (int i = 0; i < this->Size[0]; ++i)
            {
              if (this->IsTouched[blocks.Offset(i, j, k)] && isRemoved(i, j, k))
              {
                this->Grid.SetBlock(false, i, j, k, this->Mask);
              }
            }
          }
        }
      });
  }

  const ImagePart Image;
  const SeedSphere& Seed;
  const SeedSphere Ball;
  const double Noise;
  const bool IsMR;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Mask;
  const BlockGrid Grid;
  const std::array<int, 3> Size;
  const RobustStatistics OfBall;

  std::vector<std::size_t> SourceBlocks;
  std::vector<unsigned char> Inside; // half of the block is in the mask
  std::vector<bool> IsTouched;       // a voxel is
  std::vector<bool> IsCore;
  BlockSums Sums;
  std::vector<float> Unaries; // of the blocks, later of the nodes
  BlockNodes Nodes;
};

} // namespace

bool CarveNecks(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  const ImageGeometry geometry = mask.GetGeometry();
  // The edges at the mask's rim need what lies around it.
  constexpr double margin = 6;
  const VoxelBox box = WidenedBy(
    mask.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)), margin, 2, geometry);
  BitMask part = mask.Cropped(box);
  mask = BitMask(); // its memory is needed
  Insert(VoxelsAround(part.GetGeometry(), seed), part);
  const std::vector<std::size_t> source =
    VoxelsAround(part.GetGeometry(), { seed.Center, SourceRadius * seed.Radius });
  if (!FillHoles(part, monitor) || !KeepConnected(part, source, monitor) ||
    !Carving(image.Cropped(box), seed, noise, modality, parallelFor, monitor, part).Execute() ||
    !KeepConnected(part, source, monitor) || !FillHoles(part, monitor))
  {
    return false;
  }
  mask = BitMask(geometry);
  mask.Insert(part, box.Begin);
  return true;
}

} // namespace FlipFree

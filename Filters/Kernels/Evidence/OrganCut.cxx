#include "Evidence/OrganCut.h"

#include "Evidence/RegionCut.h"
#include "Evidence/SeveredParts.h"
#include "Evidence/UnaryTerms.h"
#include "Image/BallInside.h"
#include "Image/DistanceParts.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/GrayValueSimilarity.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace FlipFree
{
namespace
{

// What an entire part is worth to the cut where its gray values are the organ's, per mm3; what a
// proposal weighs per mm3 and unit of evidence.
constexpr double WorthOfOrgan = 0.7;
// Of what the first cut keeps: parts that are smaller are not worth a doubt.
constexpr double LeastDoubt = 0.06;

class OrganCutter
{
public:
  OrganCutter(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
    const OrganCutSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
    BitMask& mask, OrganCutState& state)
    : Image(image)
    , Seed(seed)
    , Ball(BallInside(mask, seed))
    , Kind(modality)
    , Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Mask(mask)
    , State(state)
    , Grid(RegionGrid(mask, Ball.Radius))
    , Size(Grid.Blocks.Dimensions)
    , OfBall(StatisticsInBall(image, Grid.Voxels, Ball))
    , Spread(std::max({ OfBall.StandardDeviation, 0.5 * noise, LeastDeviation }))
  {
  }

  bool Execute()
  {
    this->FillBlocks();
    this->SourceBlocks = VoxelsAround(this->Grid.Blocks,
      { this->Seed.Center, this->Settings.SourceRadius * this->Seed.Radius });
    for (const std::size_t block : this->SourceBlocks)
    {
      this->Inside[block] = 1;
    }
    if (!this->FindUnariesAndCores())
    {
      return false;
    }
    this->Smooth = SmoothBlockMeans(this->Image, this->Grid, this->Parallel);
    RegionCut cut = this->MakeCut();
    // At first as if all that lies behind necks were certain: that shows where the organ may end.
    cut.Fix(this->Cores, false);
    if (!cut.Execute(this->Parallel, this->Ask))
    {
      return false;
    }
    std::vector<SeveredPart> parts = this->FindParts(cut);
    if (!parts.empty())
    {
      this->Propose(parts, cut);
      if (!cut.Execute(this->Parallel, this->Ask) ||
        (this->Settings.FindsDoubts && !this->FindDoubts(parts, cut)))
      {
        return false;
      }
      this->RememberOwn(parts, cut);
    }
    this->RemoveBlocks(cut);
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
    for (std::size_t block = 0; block < count; ++block)
    {
      const auto voxels = static_cast<std::size_t>(this->Sums.Weights[block]);
      this->Inside[block] = this->Grid.AreHalf(voxels) ? 1 : 0;
      this->IsTouched[block] = this->Sums.Weights[block] > 0;
    }
  }

  // Cores are found by one thread; meanwhile the others find the terms, which do not need them.
  bool FindUnariesAndCores()
  {
    this->SquaredDepth =
      SquaredDistance(this->Inside, this->Grid.Blocks, 0, this->Parallel, this->Ask);
    if (this->SquaredDepth.empty())
    {
      return false;
    }
    this->Parallel(0, 2,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        if (first == 0)
        {
          this->Unaries = FindUnaryTerms(std::move(this->Sums), this->Inside, this->Grid.Blocks,
            { this->Seed.Center, this->Ball.Radius }, this->OfBall.StandardDeviation,
            this->Kind == Modality::MR, this->Parallel);
          this->WeakenUnsupported();
        }
        if (last == 2)
        {
          this->FindCores();
        }
      });
    return true;
  }

  // By the part of its voxels that are unsupported.
  void WeakenUnsupported()
  {
    if (!this->State.Supported.HasGrid())
    {
      return;
    }
    const double perVoxel = this->Settings.UnsupportedLoss / this->Grid.VoxelsPerBlock();
    BitMask unsupported = this->Mask;
    unsupported.Remove(this->State.Supported);
    this->Grid.ForEachRun(unsupported, SerialFor,
      [&](std::size_t block, int begin, int end, int, int)
      { this->Unaries[block] -= static_cast<float>(perVoxel * (end - begin)); });
  }

  void FindCores()
  {
    const OrganCutSettings& settings = this->Settings;
    const double ratio =
      this->Ball.Radius < settings.SlenderRadius ? settings.NeckRatioOfSlender : settings.NeckRatio;
    const std::vector<float>& depth = this->SquaredDepth;
    const DistanceParts parts =
      FindDistanceParts(depth, this->Grid.Blocks, this->SourceBlocks, ratio);
    for (std::size_t block = 0; block < depth.size(); ++block)
    {
      const int part = parts.PartOf[block];
      if (part >= 0 && this->Inside[block] && !parts.HoldsSeed[part] &&
        depth[block] > settings.CoreDepth * settings.CoreDepth * parts.Peaks[part])
      {
        this->Cores.push_back(block);
      }
    }
  }

  RegionCut MakeCut()
  {
    this->Nodes = BlockNodes(this->Inside.size(),
      [this](std::size_t block) { return this->Inside[block] != 0; });
    this->KeepUnariesOfNodes();
    const BlockLinks links =
      RegionLinks(this->Settings.Smoothness, this->Ball.Radius, this->Spread);
    this->EdgeContrast = links.EdgeContrast;
    RegionCut cut(MakeBlockNetwork(
                    this->Grid.Blocks, this->Nodes, this->Smooth, links,
                    [this](std::size_t block) { return this->Unaries[this->Nodes[block]]; },
                    [](std::size_t) { return -1; }, this->Parallel),
      CapacityUnit(this->Grid.Blocks, links), this->Nodes);
    std::vector<float>().swap(this->Unaries);
    cut.Fix(this->SourceBlocks, true);
    return cut;
  }

  std::vector<SeveredPart> FindParts(const RegionCut& cut)
  {
    std::size_t kept = 0;
    for (std::size_t block = 0; block < this->Inside.size(); ++block)
    {
      kept += this->Nodes.IsNode(block) && cut.IsInside(block) ? 1 : 0;
    }
    this->Kept = static_cast<double>(kept) * this->Grid.Blocks.VoxelVolume();
    return FindSeveredParts(this->Grid.Blocks, this->Nodes, this->Smooth, this->SquaredDepth,
      this->EdgeContrast, [&cut](std::size_t block) { return cut.IsInside(block); });
  }

  // In place of the certainty about the parts' cores, a proposal about each part.
  void Propose(const std::vector<SeveredPart>& parts, RegionCut& cut) const
  {
    std::vector<bool> isCore(this->Inside.size(), false);
    for (const std::size_t block : this->Cores)
    {
      isCore[block] = true;
    }
    for (const SeveredPart& part : parts)
    {
      std::vector<std::size_t> cores;
      std::copy_if(part.Blocks.begin(), part.Blocks.end(), std::back_inserter(cores),
        [&](std::size_t block) { return isCore[block]; });
      cut.Fix(cores, true);
      const double evidence = this->EvidenceOf(part);
      const bool isOwn = evidence < 1;
      cut.Add(
        { part.Blocks, isOwn, WorthOfOrgan * part.Volume * (isOwn ? 1 - evidence : evidence) });
    }
  }

  // That a part is a neighbor of the organ: 1 and above. A part is one where gray values cannot be
  // compared, and in MR, where the coil's field hides the difference.
  double EvidenceOf(const SeveredPart& part) const
  {
    if (this->IsKnownToBeOwn(part))
    {
      return 0;
    }
    return this->Kind == Modality::MR ? 1 : EvidenceOfNeighbor(part).value_or(1);
  }

  // Most of its blocks, by their first voxels.
  bool IsKnownToBeOwn(const SeveredPart& part) const
  {
    return this->State.Own.HasGrid() &&
      2 *
        std::count_if(part.Blocks.begin(), part.Blocks.end(),
          [this](std::size_t block)
          {
            const std::array<int, 3> index = IndexOf(block, this->Grid.Blocks);
            const std::array<int, 3>& factor = this->Grid.Factor;
            return this->State.Own(index[0] * factor[0], index[1] * factor[1],
              index[2] * factor[2]);
          }) >
      static_cast<std::ptrdiff_t>(part.Blocks.size());
  }

  void RememberOwn(const std::vector<SeveredPart>& parts, const RegionCut& cut)
  {
    if (!this->State.Own.HasGrid())
    {
      this->State.Own = BitMask(this->Mask.GetGeometry());
    }
    for (const SeveredPart& part : parts)
    {
      if (this->EvidenceOf(part) >= 1)
      {
        continue;
      }
      for (const std::size_t block : part.Blocks)
      {
        if (cut.IsInside(block))
        {
          this->Grid.SetBlock(true, block, this->State.Own);
        }
      }
    }
  }

  bool FindDoubts(const std::vector<SeveredPart>& parts, const RegionCut& cut)
  {
    for (const SeveredPart& part : parts)
    {
      if (part.Volume < LeastDoubt * this->Kept)
      {
        continue;
      }
      const std::size_t deepest = *std::max_element(part.Blocks.begin(), part.Blocks.end(),
        [this](std::size_t a, std::size_t b)
        { return this->SquaredDepth[a] < this->SquaredDepth[b]; });
      // The cut may have divided the part.
      const bool isInside = cut.IsInside(deepest);
      std::vector<std::size_t> blocks;
      std::copy_if(part.Blocks.begin(), part.Blocks.end(), std::back_inserter(blocks),
        [&](std::size_t block) { return cut.IsInside(block) == isInside; });
      const double margin = cut.MarginOf(blocks, this->Parallel, this->Ask);
      if (margin < 0)
      {
        return false;
      }
      const double volume = static_cast<double>(blocks.size()) * this->Grid.Blocks.VoxelVolume();
      this->State.Doubts.push_back(
        { this->Grid.CenterOf(deepest), volume, isInside, margin / volume });
    }
    return true;
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
  }

  // Voxels at the mask's rim whose block is not in the network follow the blocks around.
  void RemoveBlocks(const RegionCut& cut)
  {
    const ImageGeometry& blocks = this->Grid.Blocks;
    const auto isRemoved = [&](int i, int j, int k)
    {
      const std::size_t own = blocks.Offset(i, j, k);
      if (this->Nodes.IsNode(own))
      {
        return !cut.IsInside(own);
      }
      int balance = 0;
      VisitSurroundings({ i, j, k }, blocks,
        [&](std::size_t block)
        { balance += !this->Nodes.IsNode(block) ? 0 : (cut.IsInside(block) ? 1 : -1); });
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
                this->Grid.SetBlocks(false, i, i + 1, j, k, this->Mask);
              }
            }
          }
        }
      });
  }

  const ImagePart Image;
  const SeedSphere& Seed;
  const SeedSphere Ball;
  const Modality Kind;
  const OrganCutSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Mask;
  OrganCutState& State;
  const BlockGrid Grid;
  const std::array<int, 3> Size;
  const RobustStatistics OfBall;
  const double Spread; // of the organ's gray values

  std::vector<std::size_t> SourceBlocks;
  std::vector<unsigned char> Inside; // half of the block is in the mask
  std::vector<bool> IsTouched;       // a voxel is
  std::vector<float> SquaredDepth;
  std::vector<std::size_t> Cores;
  std::vector<float> Smooth; // gray values
  double EdgeContrast = 0;   // of the links
  double Kept = 0;           // mm3 inside the first cut
  BlockSums Sums;
  std::vector<float> Unaries; // of the blocks, later of the nodes
  BlockNodes Nodes;
};

} // namespace

bool CutOrgan(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
  const OrganCutSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask, OrganCutState& state)
{
  const ImageGeometry geometry = mask.GetGeometry();
  // The edges at the mask's rim need what lies around it.
  constexpr double margin = 6;
  const VoxelBox box = WidenedBy(
    mask.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)), margin, 2, geometry);
  BitMask part = mask.Cropped(box);
  mask = BitMask(); // its memory is needed
  OrganCutState ofPart;
  ofPart.Supported = state.Supported.Cropped(box);
  ofPart.Own = state.Own.Cropped(box);
  for (const std::size_t voxel : VoxelsAround(part.GetGeometry(), seed))
  {
    part.Insert(voxel);
  }
  const std::vector<std::size_t> source =
    VoxelsAround(part.GetGeometry(), { seed.Center, settings.SourceRadius * seed.Radius });
  if (!FillHoles(part, monitor) || !KeepConnected(part, source, monitor) ||
    !OrganCutter(image.Cropped(box), seed, noise, modality, settings, parallelFor, monitor, part,
      ofPart)
       .Execute() ||
    !KeepConnected(part, source, monitor) || !FillHoles(part, monitor))
  {
    return false;
  }
  mask = BitMask(geometry);
  mask.Insert(part, box.Begin);
  if (ofPart.Own.HasGrid())
  {
    state.Own = BitMask(geometry);
    state.Own.Insert(ofPart.Own, box.Begin);
  }
  state.Doubts.insert(state.Doubts.end(), ofPart.Doubts.begin(), ofPart.Doubts.end());
  return true;
}

} // namespace FlipFree

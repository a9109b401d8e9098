#include "Evidence/OtherParts.h"

#include "Evidence/BoundarySupport.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/RegionCut.h"
#include "Image/BallInside.h"
#include "Image/BlockNetwork.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/LeakControl.h"
#include "Intensity/ModelFit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// Millimeters around the foreground.
constexpr double AroundForeground = 30;
// Of the blocks of a cut (RegionBlockSize): parts are found on larger ones.
constexpr double BlockScale = 1.6;
// Of the foreground's volume.
constexpr double LeastPartVolume = 0.01;
// What is less deep, in blocks, does not connect a part.
constexpr double ConnectingDepth = 1.5;
// Two parts are the same if they have this much of their union in common.
constexpr double SameOverlap = 0.5;
// Masses of the foreground for growth from the seed.
constexpr std::array<double, 2> CoarseMasses{ { 0.7, 0.85 } };

// The margin is DoubtfulPart::MarginScale * (SupportOffset - SupportSlope * ln(r)), where r is the
// support of the boundary with the part changed, in comparison with that of the foreground's. Of
// 347 parts in the 76 organs of development.csv, the foreground was wrong about 3 % below a ratio
// of 0.7, 8 % up to 0.85, 26 % up to 1, and 37 % above.
constexpr double SupportOffset = 0.85;
constexpr double SupportSlope = 4;
constexpr double GreatestMargin = 6;

double BlockSizeOf(const BitMask& foreground, const SeedSphere& seed)
{
  return BlockScale * RegionBlockSize(BallInside(foreground, seed).Radius);
}

class OtherPartFinder
{
public:
  OtherPartFinder(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
    const OrganFeatureSettings& settings, const BitMask& foreground, const ParallelFor& parallelFor,
    const Monitor& monitor)
    : Smooth(smooth)
    , Seed(seed)
    , Noise(noise)
    , Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Box(OtherPartsBox(foreground, seed))
    , Grid(CropGeometry(smooth.Geometry, Box), BlockSizeOf(foreground, seed))
    , Means(SmoothBlockMeans({ smooth, Box.Begin }, Grid, parallelFor))
    , Foreground(BlocksOf(foreground))
    , LeastContrast(LeastContrastAround(smooth, seed, noise))
    , Support(this->SupportOf(Foreground))
  {
  }

  bool Execute(const std::vector<BitMask>& opinions, std::vector<OtherPart>& parts)
  {
    std::vector<BitMask> others;
    for (const BitMask& opinion : opinions)
    {
      others.push_back(this->BlocksOf(opinion));
    }
    for (const double mass : CoarseMasses)
    {
      others.emplace_back();
      if (!this->Grow(mass, others.back()))
      {
        return false;
      }
    }
    for (const BitMask& other : others)
    {
      for (const bool isIncluded : { false, true })
      {
        if (!this->AddParts(other, isIncluded))
        {
          return false;
        }
      }
    }
    for (const Part& part : this->Parts)
    {
      parts.push_back({ this->VoxelsOf(part.Blocks), part.Doubt });
    }
    return true;
  }

private:
  struct Part
  {
    std::vector<std::size_t> Blocks; // ascending
    DoubtfulPart Doubt;
  };

  ImageView<float> View() const { return { this->Means.data(), this->Grid.Blocks }; }

  // Those of which the mask holds half.
  BitMask BlocksOf(const BitMask& mask) const
  {
    const std::vector<std::size_t> counts =
      this->Grid.CountVoxels(mask.Cropped(this->Box), this->Parallel);
    BitMask blocks(this->Grid.Blocks);
    for (std::size_t block = 0; block < counts.size(); ++block)
    {
      if (2 * counts[block] >= this->Grid.VoxelsPerBlock())
      {
        const std::array<int, 3> index = IndexOf(block, this->Grid.Blocks);
        blocks.Insert(index[0], index[1], index[2]);
      }
    }
    return blocks;
  }

  BitMask VoxelsOf(const std::vector<std::size_t>& blocks) const
  {
    BitMask cropped(this->Grid.Voxels);
    for (const std::size_t block : blocks)
    {
      const std::array<int, 3> index = IndexOf(block, this->Grid.Blocks);
      this->Grid.SetBlock(true, index[0], index[1], index[2], cropped);
    }
    BitMask voxels(this->Smooth.Geometry);
    voxels.Insert(cropped, this->Box.Begin);
    return voxels;
  }

  double SupportOf(const BitMask& mask) const
  {
    return BoundarySupport(this->View(), mask, this->LeastContrast);
  }

  bool Grow(double mass, BitMask& carved) const
  {
    IntensitySettings narrow = this->Settings.Intensity;
    narrow.ForegroundMass = std::min(mass, narrow.ForegroundMass);
    BitMask grown;
    std::vector<DoubtfulPart> doubts; // of another organ than the one that was found
    return FindForegroundInBox(this->View(), WholeBox(this->Grid.Blocks),
             FitToSeed(this->Smooth, this->Seed, this->Noise, narrow), this->Seed,
             RadiiOf(this->Settings.Leaks, this->Seed.Radius, this->Grid.Blocks), this->Parallel,
             this->Ask, grown) &&
      CarveOrgan(this->View(), grown, nullptr, this->Seed, this->Noise, this->Settings.Modality,
        this->Parallel, this->Ask, carved, doubts);
  }

  bool AddParts(const BitMask& other, bool isIncluded)
  {
    BitMask different = isIncluded ? this->Foreground : other;
    different.Remove(isIncluded ? other : this->Foreground);
    const std::vector<float> squared = SquaredDistance(different, false, this->Parallel, this->Ask);
    if (squared.empty())
    {
      return false;
    }
    for (std::vector<std::size_t>& blocks : this->PiecesOf(squared))
    {
      if (static_cast<double>(blocks.size()) >=
          LeastPartVolume * static_cast<double>(this->Foreground.Count()) &&
        !this->IsKnown(blocks))
      {
        this->Add(std::move(blocks), squared, isIncluded);
      }
    }
    return true;
  }

  // Connected by what is deep, with what is around it.
  std::vector<std::vector<std::size_t>> PiecesOf(const std::vector<float>& squared) const
  {
    const auto least =
      static_cast<float>(std::pow(ConnectingDepth * this->Grid.Blocks.Spacing.minCoeff(), 2));
    std::vector<bool> isTaken(squared.size(), false);
    const auto grow =
      [&](std::size_t first, std::size_t last, float depth, std::vector<std::size_t>& piece)
    {
      for (; first < last; ++first)
      {
        VisitNeighbors(piece[first], this->Grid.Blocks,
          [&](std::size_t other)
          {
            if (!isTaken[other] && squared[other] > 0 && squared[other] >= depth)
            {
              isTaken[other] = true;
              piece.push_back(other);
            }
          });
      }
    };
    std::vector<std::vector<std::size_t>> pieces;
    for (std::size_t first = 0; first < squared.size(); ++first)
    {
      if (isTaken[first] || squared[first] < least)
      {
        continue;
      }
      isTaken[first] = true;
      std::vector<std::size_t> piece{ first };
      for (std::size_t next = 0; next < piece.size(); ++next)
      {
        grow(next, next + 1, least, piece);
      }
      std::size_t begin = 0;
      for (int step = 0; step < ConnectingDepth; ++step)
      {
        const std::size_t end = piece.size();
        grow(begin, end, 0, piece);
        begin = end;
      }
      std::sort(piece.begin(), piece.end());
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  bool IsKnown(const std::vector<std::size_t>& blocks) const
  {
    return std::any_of(this->Parts.begin(), this->Parts.end(),
      [&](const Part& part)
      {
        std::vector<std::size_t> both;
        std::set_intersection(blocks.begin(), blocks.end(), part.Blocks.begin(), part.Blocks.end(),
          std::back_inserter(both));
        const std::size_t either = blocks.size() + part.Blocks.size() - both.size();
        return static_cast<double>(both.size()) >= SameOverlap * static_cast<double>(either);
      });
  }

  void Add(std::vector<std::size_t> blocks, const std::vector<float>& squared, bool isIncluded)
  {
    BitMask changed = this->Foreground;
    for (const std::size_t block : blocks)
    {
      const std::array<int, 3> index = IndexOf(block, this->Grid.Blocks);
      changed.SetRun(!isIncluded, index[0], index[0] + 1, index[1], index[2]);
    }
    const double ratio = this->SupportOf(changed) / this->Support;
    const double margin =
      DoubtfulPart::MarginScale * (SupportOffset - SupportSlope * std::log(std::max(ratio, 1e-6)));
    if (!(margin <= GreatestMargin))
    {
      return;
    }
    Part part;
    part.Doubt.Place = this->Grid.CenterOf(*std::max_element(blocks.begin(), blocks.end(),
      [&](std::size_t a, std::size_t b) { return squared[a] < squared[b]; }));
    part.Doubt.Volume = static_cast<double>(blocks.size()) * this->Grid.Blocks.VoxelVolume();
    part.Doubt.IsIncluded = isIncluded;
    part.Doubt.Margin = margin;
    part.Blocks = std::move(blocks);
    this->Parts.push_back(std::move(part));
  }

  const ImageView<float>& Smooth;
  const SeedSphere& Seed;
  const double Noise;
  const OrganFeatureSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const VoxelBox Box;
  const BlockGrid Grid;

  const std::vector<float> Means;
  const BitMask Foreground; // of blocks
  const double LeastContrast;
  const double Support;
  std::vector<Part> Parts;
};

} // namespace

VoxelBox OtherPartsBox(const BitMask& foreground, const SeedSphere& seed)
{
  const ImageGeometry& geometry = foreground.GetGeometry();
  return WidenedBy(foreground.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)),
    AroundForeground, 1, geometry);
}

bool FindOtherParts(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const BitMask& foreground,
  const std::vector<BitMask>& opinions, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<OtherPart>& parts)
{
  parts.clear();
  return OtherPartFinder(smooth, seed, noise, settings, foreground, parallelFor, monitor)
    .Execute(opinions, parts);
}

} // namespace FlipFree

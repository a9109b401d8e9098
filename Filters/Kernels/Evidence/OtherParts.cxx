#include "Evidence/OtherParts.h"

#include "Evidence/CoarseOrgan.h"
#include "Evidence/OrganConsensus.h"
#include "Image/DistanceParts.h"
#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace FlipFree
{
namespace
{

// Of the foreground's volume. What is smaller behind a wide neck is a bulge, or the pole of a
// kidney.
constexpr double LeastPartVolume = 0.02;
constexpr double LeastLobeVolume = 0.15;
// What is less deep, in blocks, does not connect a part; it belongs to what it is this many blocks
// away from.
constexpr double ConnectingDepth = 1.5;
constexpr int RimSteps = 2;
// Narrower necks divide the foreground, in comparison with the smaller of the parts that they
// connect. What a neck of less than 0.7 severs was decided about before (OrganCut.h).
constexpr std::array<double, 2> NecksOfForeground{ { 0.75, 0.9 } };
// Two parts are the same if they have this much of their union in common.
constexpr double SameOverlap = 0.5;
// Masses of the foreground for growth from the seed.
constexpr std::array<double, 2> CoarseMasses{ { 0.7, 0.85 } };

// That the foreground is wrong about a part has the chance 1 / (1 + exp(-z)), where z is Offset +
// OfSupport * ln(r) + OfDepth * ln(d). r is the support of the boundary with the part changed, in
// comparison with that of the foreground's; d is the part's depth in millimeters. What is deep and
// near is mostly another organ, included or not. Fitted to 953 parts of 115 organs, 183 of which
// the foreground was wrong about; fitted to one half of the volumes, they rank the other half's as
// well.
struct ChanceOfError
{
  double Offset;
  double OfSupport;
  double OfDepth;
};
constexpr ChanceOfError OfIncluded{ -2.2, 2.3, 0.7 };
constexpr ChanceOfError OfLeftOut{ 3.1, 8.2, -1.9 };
// Beyond it, the parts were too few to say more.
constexpr double GreatestSupportRatio = 1.2;
constexpr double GreatestMargin = 6;
constexpr std::size_t MostParts = 20;

class OtherPartFinder
{
public:
  OtherPartFinder(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
    const OrganFeatureSettings& settings, const IntensityModel& ofSeed, const BitMask& foreground,
    const ParallelFor& parallelFor, const Monitor& monitor)
    : Parallel(parallelFor)
    , Ask(monitor)
    , Box(ConsensusBox(foreground, seed))
    , Organ({ smooth, Box.Begin }, CropGeometry(smooth.Geometry, Box), foreground, seed, noise,
        settings, ofSeed, parallelFor)
    , Grid(Organ.GetGrid())
    , Foreground(Organ.BlocksOf(foreground.Cropped(Box)))
    , SeedBlocks(VoxelsAround(Grid.Blocks, seed))
    , Support(Organ.SupportOf(Foreground))
  {
  }

  bool Execute(const std::vector<BitMask>& opinions, std::vector<OtherPart>& parts)
  {
    if (!(this->Support > 0))
    {
      return true; // nothing to compare with
    }
    this->Steps = static_cast<double>(opinions.size() + 2 * CoarseMasses.size());
    for (const BitMask& opinion : opinions)
    {
      if (!this->AddParts(this->Organ.BlocksOf(opinion.Cropped(this->Box))))
      {
        return false;
      }
    }
    for (const double mass : CoarseMasses)
    {
      BitMask carved;
      if (!this->Organ.Grow(mass, this->Proceed(), carved))
      {
        return false;
      }
      ++this->Done;
      if (carved.HasGrid() && !this->AddParts(carved))
      {
        return false;
      }
    }
    for (const double neck : NecksOfForeground)
    {
      if (!this->AddLobes(neck))
      {
        return false;
      }
    }
    std::stable_sort(this->Parts.begin(), this->Parts.end(),
      [](const Part& one, const Part& other) { return one.Doubt.Margin < other.Doubt.Margin; });
    std::vector<Part> kept;
    for (Part& part : this->Parts)
    {
      const bool isKnown = std::any_of(kept.begin(), kept.end(),
        [&](const Part& other) { return IsSame(part, other); });
      if (!isKnown && kept.size() < MostParts)
      {
        kept.push_back(std::move(part));
      }
    }
    for (const Part& part : kept)
    {
      parts.push_back(this->VoxelsOf(part));
    }
    return true;
  }

private:
  struct Part
  {
    std::vector<std::size_t> Blocks; // ascending
    DoubtfulPart Doubt;
  };

  static bool IsSame(const Part& one, const Part& other)
  {
    std::vector<std::size_t> both;
    std::set_intersection(one.Blocks.begin(), one.Blocks.end(), other.Blocks.begin(),
      other.Blocks.end(), std::back_inserter(both));
    const std::size_t either = one.Blocks.size() + other.Blocks.size() - both.size();
    return static_cast<double>(both.size()) >= SameOverlap * static_cast<double>(either);
  }

  Monitor Proceed() const
  {
    return [this](double) { return this->Ask(this->Done / this->Steps); };
  }

  OtherPart VoxelsOf(const Part& part) const
  {
    BitMask voxels(this->Grid.Voxels);
    for (const std::size_t block : part.Blocks)
    {
      this->Grid.SetBlock(true, block, voxels);
    }
    const VoxelBox bounds = voxels.Bounds();
    VoxelBox box = bounds;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.Begin[axis] += this->Box.Begin[axis];
      box.End[axis] += this->Box.Begin[axis];
    }
    return { { box, voxels.Cropped(bounds) }, part.Doubt };
  }

  bool AddParts(const BitMask& other)
  {
    const Monitor proceed = this->Proceed();
    for (const bool isIncluded : { false, true })
    {
      BitMask different = isIncluded ? this->Foreground : other;
      different.Remove(isIncluded ? other : this->Foreground);
      const std::vector<float> squared = SquaredDistance(different, false, this->Parallel, proceed);
      if (squared.empty())
      {
        return false;
      }
      for (std::vector<std::size_t>& blocks : this->PiecesOf(squared))
      {
        if (!proceed(0))
        {
          return false;
        }
        this->Add(std::move(blocks), squared, isIncluded, LeastPartVolume);
      }
    }
    ++this->Done;
    return true;
  }

  // Cores are connected by what is deep. Then all of them grow rims together, so that none takes
  // another's.
  std::vector<std::vector<std::size_t>> PiecesOf(const std::vector<float>& squared) const
  {
    const auto least =
      static_cast<float>(std::pow(ConnectingDepth * this->Grid.Blocks.Spacing.minCoeff(), 2));
    std::vector<bool> isTaken(squared.size(), false);
    const auto addNeighbors = [&](std::size_t block, bool deep, std::vector<std::size_t>& piece)
    {
      VisitNeighbors(block, this->Grid.Blocks,
        [&](std::size_t other)
        {
          if (!isTaken[other] && squared[other] > 0 && (squared[other] >= least) == deep)
          {
            isTaken[other] = true;
            piece.push_back(other);
          }
        });
    };
    std::vector<std::vector<std::size_t>> pieces;
    for (std::size_t first = 0; first < squared.size(); ++first)
    {
      if (isTaken[first] || squared[first] < least)
      {
        continue;
      }
      isTaken[first] = true;
      pieces.push_back({ first });
      for (std::size_t next = 0; next < pieces.back().size(); ++next)
      {
        addNeighbors(pieces.back()[next], true, pieces.back());
      }
    }
    std::vector<std::size_t> begin(pieces.size(), 0);
    for (int step = 0; step < RimSteps; ++step)
    {
      for (std::size_t number = 0; number < pieces.size(); ++number)
      {
        const std::size_t end = pieces[number].size();
        for (; begin[number] < end; ++begin[number])
        {
          addNeighbors(pieces[number][begin[number]], false, pieces[number]);
        }
      }
    }
    for (std::vector<std::size_t>& piece : pieces)
    {
      std::sort(piece.begin(), piece.end());
    }
    return pieces;
  }

  // The parts of the foreground behind necks, but for that of the seed.
  bool AddLobes(double neck)
  {
    const std::vector<float> squared =
      SquaredDistance(this->Foreground, false, this->Parallel, this->Proceed());
    if (squared.empty())
    {
      return false;
    }
    const DistanceParts parts =
      FindDistanceParts(squared, this->Grid.Blocks, this->SeedBlocks, neck);
    std::vector<std::vector<std::size_t>> lobes(parts.Peaks.size());
    for (std::size_t block = 0; block < squared.size(); ++block)
    {
      if (parts.PartOf[block] != DistanceParts::Outside && !parts.HoldsSeed[parts.PartOf[block]])
      {
        lobes[parts.PartOf[block]].push_back(block);
      }
    }
    for (std::vector<std::size_t>& lobe : lobes)
    {
      this->Add(std::move(lobe), squared, true, LeastLobeVolume);
    }
    return this->Proceed()(0);
  }

  void Add(std::vector<std::size_t> blocks, const std::vector<float>& squared, bool isIncluded,
    double leastVolume)
  {
    if (static_cast<double>(blocks.size()) <
      leastVolume * static_cast<double>(this->Foreground.Count()))
    {
      return;
    }
    BitMask changed = this->Foreground;
    for (const std::size_t block : blocks)
    {
      const std::array<int, 3> index = IndexOf(block, this->Grid.Blocks);
      changed.SetRun(!isIncluded, index[0], index[0] + 1, index[1], index[2]);
    }
    const double ratio = std::max(1e-6,
      std::min(GreatestSupportRatio, this->Organ.SupportOf(changed) / this->Support));
    const std::size_t deepest = *std::max_element(blocks.begin(), blocks.end(),
      [&](std::size_t a, std::size_t b) { return squared[a] < squared[b]; });
    const ChanceOfError& chance = isIncluded ? OfIncluded : OfLeftOut;
    const double margin = -DoubtfulPart::MarginScale *
      (chance.Offset + chance.OfSupport * std::log(ratio) +
        chance.OfDepth * std::log(std::sqrt(squared[deepest])));
    if (margin > GreatestMargin)
    {
      return;
    }
    Part part;
    part.Doubt.Place = this->Grid.CenterOf(deepest);
    part.Doubt.Volume = static_cast<double>(blocks.size()) * this->Grid.Blocks.VoxelVolume();
    part.Doubt.IsIncluded = isIncluded;
    part.Doubt.Margin = margin;
    part.Blocks = std::move(blocks);
    this->Parts.push_back(std::move(part));
  }

  const ParallelFor& Parallel;
  const Monitor& Ask;
  const VoxelBox Box;
  const CoarseOrgan Organ;
  const BlockGrid& Grid;
  const BitMask Foreground; // of blocks
  const std::vector<std::size_t> SeedBlocks;
  const double Support;
  std::vector<Part> Parts;
  double Done = 0;
  double Steps = 1;
};

} // namespace

bool FindOtherParts(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const IntensityModel& ofSeed, const BitMask& foreground,
  const std::vector<BitMask>& opinions, const ParallelFor& parallelFor, const Monitor& monitor,
  std::vector<OtherPart>& parts)
{
  parts.clear();
  return OtherPartFinder(smooth, seed, noise, settings, ofSeed, foreground, parallelFor, monitor)
    .Execute(opinions, parts);
}

} // namespace FlipFree

#include "Evidence/HalfContrastRim.h"

#include "Image/BallMorphology.h"
#include "Image/LocalMeans.h"
#include "Image/NoData.h"
#include "Image/SliceMorphology.h"
#include "Intensity/LeakControl.h"
#include "Intensity/RobustStatistics.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{
namespace
{

// All lengths in millimeters.
constexpr double CoreMargin = 2;
constexpr double ShellBegin = 3;
constexpr double ShellEnd = 15;
constexpr double RimReach = 3;
constexpr double OpeningRadius = 1.8;
constexpr double BlockSize = 4;

// In robust standard deviations of the organ about its local mean.
constexpr double LeastHalf = 2.5;
constexpr double GreatestHalf = 12;

using Word = BitMask::Word;

// How the organ and the contrast are averaged. In CT, what is blurred at the boundary is the
// organ's outer layer, which differs from its inside where contrast medium has reached only the
// cortex of a kidney; and it varies less. Of the surroundings, lung, fat and muscle lie side by
// side, and an arithmetic mean would take muscle for organ: the harmonic mean follows what differs
// least. In MR, slices are thick: a layer holds too few of them, and what surrounds the organ also
// holds some of it that the mask still misses, so that the mean falls short of the contrast; hence
// more than a half of it.
struct ContrastRule
{
  double LayerDepth;     // of the organ's voxels that count, in millimeters; zero: all
  double OrganDeviation; // of the Gaussian over the organ, in millimeters
  double Deviation;      // of the Gaussian over the surroundings, in millimeters
  float Power;           // of the mean: 1 arithmetic, -1 harmonic
  float Part;            // of the contrast by which the boundary differs from the organ
};

ContrastRule RuleOf(Modality modality)
{
  return modality == Modality::MR ? ContrastRule{ 0, 15, 10, 1, 0.6F }
                                  : ContrastRule{ 8, 6, 5, -1, 0.5F };
}

class Rim
{
public:
  Rim(const ImagePart& image, double noise, Modality modality, const ParallelFor& parallelFor,
    const Monitor& monitor, BitMask& mask)
    : Image(image)
    , Noise(noise)
    , Rule(RuleOf(modality))
    , Parallel(parallelFor)
    , Ask(monitor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), BlockSize)
  {
  }

  bool Execute()
  {
    BitMask core = this->Mask;
    if (!Erode(core, CoreMargin, this->Parallel, this->Ask))
    {
      return false;
    }
    if (core.Count() == 0)
    {
      return true;
    }
    return this->FindOrgan(core) && this->FindContrast() && this->Grow(core);
  }

private:
  // The organ's local means, and its deviation from them.
  bool FindOrgan(const BitMask& core)
  {
    BitMask layer = core;
    if (this->Rule.LayerDepth > 0)
    {
      BitMask deep = core;
      if (!Erode(deep, this->Rule.LayerDepth - CoreMargin, this->Parallel, this->Ask))
      {
        return false;
      }
      layer.Remove(deep);
    }
    this->Organ =
      this->AverageOf(layer, this->Rule.OrganDeviation, [](float value, float) { return value; });
    std::vector<float> deviations = DifferencesFrom(this->Organ, this->Grid, this->Image, layer);
    this->Spread = std::max(
      { RobustStatisticsOf(deviations).StandardDeviation, 0.5 * this->Noise, LeastDeviation });
    return true;
  }

  bool FindContrast()
  {
    // Whole blocks, since the shell is averaged in blocks.
    BitMask blocks = this->Grid.BlocksWith(1, this->Mask, this->Parallel);
    if (!Dilate(blocks, ShellEnd, this->Parallel, this->Ask))
    {
      return false;
    }
    BitMask gap = this->Mask;
    if (!Dilate(gap, ShellBegin, this->Parallel, this->Ask))
    {
      return false;
    }
    BitMask shell = this->Grid.VoxelsOf(blocks, this->Parallel);
    shell.Remove(gap);
    const auto smallest = static_cast<float>(this->Spread);
    const float power = this->Rule.Power;
    this->Halves = this->AverageOf(shell, this->Rule.Deviation,
      [=](float value, float mean)
      {
        const float contrast = std::max(smallest, std::abs(value - mean));
        return power < 0 ? 1 / contrast : contrast;
      });
    const auto least = static_cast<float>(LeastHalf * this->Spread);
    const auto most = static_cast<float>(GreatestHalf * this->Spread);
    for (float& half : this->Halves)
    {
      const float contrast = power < 0 ? 1 / half : half;
      half = std::max(least, std::min(this->Rule.Part * contrast, most));
    }
    return true;
  }

  bool Grow(const BitMask& core)
  {
    BitMask near = this->Mask;
    if (!Dilate(near, RimReach, this->Parallel, this->Ask))
    {
      return false;
    }
    const int across = AxisAcrossSlices(this->Mask.GetGeometry());
    if (this->Mask.GetGeometry().Spacing[across] > RimReach)
    {
      AddNeighborsAlong(across, this->Mask, near);
    }
    const BitMask like = this->LikeOrgan(near);
    BitMask grown = like;
    grown.Unite(this->Mask);
    if (!Erode(grown, OpeningRadius, this->Parallel, this->Ask) ||
      !Dilate(grown, OpeningRadius, this->Parallel, this->Ask))
    {
      return false;
    }
    this->Mask.Intersect(like);
    this->Mask.Unite(grown);
    std::vector<std::size_t> sources;
    core.ForEachRun(0, core.GetGeometry().Dimensions[2],
      [&](int begin, int, int j, int k)
      { sources.push_back(core.GetGeometry().Offset(begin, j, k)); });
    if (!KeepConnected(this->Mask, sources, this->Ask))
    {
      return false;
    }
    MedianInSlices(this->Mask, this->Parallel);
    return true;
  }

  // Those of the voxels near the mask that differ from the organ by less than half the contrast.
  BitMask LikeOrgan(const BitMask& near) const
  {
    BitMask like(near.GetGeometry());
    const auto& size = near.GetGeometry().Dimensions;
    this->Parallel(0, size[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        BlockRow interpolate(this->Grid);
        std::array<float, BitMask::BitsOfWord> mean{};
        std::array<float, BitMask::BitsOfWord> half{};
        near.ForEachRun(first, last,
          [&](int begin, int end, int j, int k)
          {
            const float* const row = this->Image.Row(j, k);
            interpolate.Read(this->Organ, begin, end, j, k, mean.data());
            interpolate.Read(this->Halves, begin, end, j, k, half.data());
            Word bits = 0;
            for (int i = begin; i < end; ++i)
            {
              const bool is = std::abs(row[i] - mean[i - begin]) < half[i - begin];
              bits |= Word(is ? 1 : 0) << (i % BitMask::BitsOfWord);
            }
            like.Row(j, k)[begin / BitMask::BitsOfWord] |= bits;
          });
      });
    return like;
  }

  // Local averages over the voxels of a mask.
  template <typename Read>
  std::vector<float> AverageOf(const BitMask& mask, double deviation, const Read& read) const
  {
    const bool withMeans = !this->Organ.empty();
    BlockSums sums = SumInBlocks(mask, this->Grid, this->Parallel,
      [&](std::size_t block, int begin, int end, int j, int k, float& sum)
      {
        const float* const row = this->Image.Row(j, k);
        const float mean = withMeans ? this->Organ[block] : 0;
        float ofRun = 0;
        int count = 0;
        for (int i = begin; i < end; ++i)
        {
          if (HasData(row[i]))
          {
            ofRun += read(row[i], mean);
            ++count;
          }
        }
        sum += ofRun;
        return count;
      });
    constexpr float leastWeight = 1e-9F;
    const float ofAll = sums.Mean();
    return LocalMeans(std::move(sums), this->Grid.Blocks, deviation, leastWeight, ofAll,
      this->Parallel);
  }

  const ImagePart& Image;
  const double Noise;
  const ContrastRule Rule;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Mask;
  const BlockGrid Grid;
  std::vector<float> Organ;
  std::vector<float> Halves;
  double Spread = 0;
};

} // namespace

std::array<int, 3> RimReachOf(const ImageGeometry& geometry, int calls)
{
  std::array<int, 3> voxels = BallReach(ShellEnd + calls * RimReach, geometry);
  const int across = AxisAcrossSlices(geometry);
  if (geometry.Spacing[across] > RimReach)
  {
    voxels[across] += 2 * calls;
  }
  return voxels;
}

bool GrowRim(const ImagePart& image, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  const double thickness = mask.GetGeometry().Spacing.maxCoeff();
  for (int pass = 0; pass < (thickness > RimReach ? 2 : 1); ++pass)
  {
    if (!Rim(image, noise, modality, parallelFor, monitor, mask).Execute())
    {
      return false;
    }
  }
  return true;
}

} // namespace FlipFree

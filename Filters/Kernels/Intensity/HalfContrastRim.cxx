#include "Intensity/HalfContrastRim.h"

#include "Image/BallMorphology.h"
#include "Image/BlockGrid.h"
#include "Image/GaussianSmoothing.h"
#include "Intensity/LeakControl.h"

#include <algorithm>
#include <functional>

namespace FlipFree
{
namespace
{

// All lengths in millimeters.
constexpr double CoreMargin = 2;
constexpr double ShellBegin = 3;
constexpr double ShellEnd = 15;
constexpr double OrganDeviation = 15;
constexpr double ContrastDeviation = 10;
constexpr double RimReach = 3;
constexpr double OpeningRadius = 1.8;
constexpr double BlockSize = 4;

// In robust standard deviations of the organ about its local mean.
constexpr double GreatestContrast = 40;
constexpr double LeastHalf = 2.5;
constexpr double GreatestHalf = 12;

using Word = BitMask::Word;

// The axis across the slices: the one of the greatest spacing, and z if they are alike.
int AxisAcrossSlices(const ImageGeometry& geometry)
{
  int axis = 2;
  for (int other = 1; other >= 0; --other)
  {
    if (geometry.Spacing[other] > 1.01 * geometry.Spacing[axis])
    {
      axis = other;
    }
  }
  return axis;
}

// The words of a mask moved by up to a voxel along each axis; zeros come in from the sides.
class MovedMask
{
public:
  explicit MovedMask(const BitMask& mask)
    : Mask(mask)
  {
  }

  Word operator()(int word, int j, int k, const std::array<int, 3>& offset) const
  {
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const int y = j + offset[1];
    const int z = k + offset[2];
    if (y < 0 || y >= size[1] || z < 0 || z >= size[2])
    {
      return 0;
    }
    const Word* const row = this->Mask.Row(y, z);
    constexpr int last = BitMask::BitsOfWord - 1;
    if (offset[0] > 0)
    {
      const Word next = word + 1 < this->Mask.GetWordsPerRow() ? row[word + 1] : 0;
      return row[word] >> 1 | next << last;
    }
    if (offset[0] < 0)
    {
      const Word before = word > 0 ? row[word - 1] : 0;
      return row[word] << 1 | before >> last;
    }
    return row[word];
  }

private:
  const BitMask& Mask;
};

// Adds the mask moved by a voxel either way along an axis.
void AddNeighborsAlong(int axis, const BitMask& mask, BitMask& sum)
{
  const MovedMask moved(mask);
  const auto& size = mask.GetGeometry().Dimensions;
  std::array<int, 3> offset{};
  for (const int way : { -1, 1 })
  {
    offset[axis] = way;
    for (int k = 0; k < size[2]; ++k)
    {
      for (int j = 0; j < size[1]; ++j)
      {
        Word* const row = sum.Row(j, k);
        for (int word = 0; word < mask.GetWordsPerRow(); ++word)
        {
          row[word] |= moved(word, j, k, offset);
        }
      }
    }
  }
  sum.CutRows();
}

// The median of the nine voxels around each in its slice.
void MedianInSlices(BitMask& mask, const ParallelFor& parallelFor)
{
  const BitMask copy = mask;
  const MovedMask moved(copy);
  const int across = AxisAcrossSlices(mask.GetGeometry());
  const int a = across == 0 ? 1 : 0;
  const int b = across == 2 ? 1 : 2;
  const auto& size = mask.GetGeometry().Dimensions;
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          Word* const row = mask.Row(j, k);
          for (int word = 0; word < mask.GetWordsPerRow(); ++word)
          {
            // Counts of each bit, in four binary digits.
            std::array<Word, 4> digits{};
            for (int way = 0; way < 9; ++way)
            {
              std::array<int, 3> offset{};
              offset[a] = way % 3 - 1;
              offset[b] = way / 3 - 1;
              Word carry = moved(word, j, k, offset);
              for (Word& digit : digits)
              {
                const Word next = digit & carry;
                digit ^= carry;
                carry = next;
              }
            }
            // Five or more.
            row[word] = digits[3] | (digits[2] & (digits[1] | digits[0]));
          }
        }
      }
    });
  mask.CutRows();
}

void Unite(BitMask& mask, const BitMask& other)
{
  std::transform(mask.GetWords().begin(), mask.GetWords().end(), other.GetWords().begin(),
    mask.GetWords().begin(), std::bit_or<>());
}

void Intersect(BitMask& mask, const BitMask& other)
{
  std::transform(mask.GetWords().begin(), mask.GetWords().end(), other.GetWords().begin(),
    mask.GetWords().begin(), std::bit_and<>());
}

class Rim
{
public:
  Rim(const ImagePart& image, double noise, const ParallelFor& parallelFor, const Monitor& monitor,
    BitMask& mask)
    : Image(image)
    , Noise(noise)
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
    this->FindOrgan(core);
    return this->FindContrast() && this->Grow(core);
  }

private:
  // The organ's local means, and its deviation from them.
  void FindOrgan(const BitMask& core)
  {
    this->Organ = this->AverageOf(core, OrganDeviation,
      [](float value, float) { return value; });
    std::vector<float> deviations;
    BlockRow means(this->Grid);
    std::vector<float> mean(core.GetGeometry().Dimensions[0]);
    core.ForEachRun(0, core.GetGeometry().Dimensions[2],
      [&](int begin, int end, int j, int k)
      {
        const float* const row = this->Image.Row(j, k);
        means.Read(this->Organ, begin, end, j, k, mean.data());
        for (int i = begin; i < end; ++i)
        {
          deviations.push_back(row[i] - mean[i - begin]);
        }
      });
    const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
    std::nth_element(deviations.begin(), middle, deviations.end());
    const float center = *middle;
    for (float& deviation : deviations)
    {
      deviation = std::abs(deviation - center);
    }
    std::nth_element(deviations.begin(), middle, deviations.end());
    this->Spread = std::max({ 1.4826 * *middle, 0.5 * this->Noise, 1e-12 });
  }

  bool FindContrast()
  {
    BitMask shell = this->Mask;
    BitMask gap = this->Mask;
    if (!Dilate(shell, ShellEnd, this->Parallel, this->Ask) ||
      !Dilate(gap, ShellBegin, this->Parallel, this->Ask))
    {
      return false;
    }
    shell.Remove(gap);
    const auto greatest = static_cast<float>(GreatestContrast * this->Spread);
    this->Halves = this->AverageOf(shell, ContrastDeviation,
      [greatest](float value, float mean) { return std::min(std::abs(value - mean), greatest); });
    const auto least = static_cast<float>(LeastHalf * this->Spread);
    const auto most = static_cast<float>(GreatestHalf * this->Spread);
    for (float& half : this->Halves)
    {
      half = std::max(least, std::min(0.5F * half, most));
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
    Unite(grown, this->Mask);
    if (!Erode(grown, OpeningRadius, this->Parallel, this->Ask) ||
      !Dilate(grown, OpeningRadius, this->Parallel, this->Ask))
    {
      return false;
    }
    Intersect(this->Mask, like);
    Unite(this->Mask, grown);
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
    std::vector<float> sums(this->Grid.Blocks.NumberOfVoxels(), 0.0F);
    std::vector<float> weights(sums.size(), 0.0F);
    const bool withMeans = !this->Organ.empty();
    this->Grid.ForEachRun(mask, this->Parallel,
      [&](std::size_t block, int begin, int end, int j, int k)
      {
        const float* const row = this->Image.Row(j, k);
        const float mean = withMeans ? this->Organ[block] : 0;
        float sum = 0;
        for (int i = begin; i < end; ++i)
        {
          sum += read(row[i], mean);
        }
        sums[block] += sum;
        weights[block] += static_cast<float>(end - begin);
      });
    double whole = 0;
    double count = 0;
    for (std::size_t block = 0; block < sums.size(); ++block)
    {
      whole += sums[block];
      count += weights[block];
    }
    const auto mean = static_cast<float>(count > 0 ? whole / count : 0);
    SmoothGaussian(sums, this->Grid.Blocks, deviation, this->Parallel);
    SmoothGaussian(weights, this->Grid.Blocks, deviation, this->Parallel);
    for (std::size_t block = 0; block < sums.size(); ++block)
    {
      sums[block] = weights[block] > 1e-9F ? sums[block] / weights[block] : mean;
    }
    return sums;
  }

  const ImagePart& Image;
  const double Noise;
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

bool GrowRim(const ImagePart& image, double noise, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& mask)
{
  const double thickness = mask.GetGeometry().Spacing.maxCoeff();
  for (int pass = 0; pass < (thickness > RimReach ? 2 : 1); ++pass)
  {
    if (!Rim(image, noise, parallelFor, monitor, mask).Execute())
    {
      return false;
    }
  }
  return true;
}

} // namespace FlipFree

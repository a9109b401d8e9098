#include "Intensity/LeakControl.h"

#include "Image/BallMorphology.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

using Word = BitMask::Word;

// Some milliseconds.
constexpr std::size_t StepsBetweenQuestions = 1U << 18U;

bool HoldsOne(const BitMask& mask, const std::vector<std::size_t>& voxels)
{
  return std::any_of(voxels.begin(), voxels.end(),
    [&mask](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, mask.GetGeometry());
      return mask(index[0], index[1], index[2]);
    });
}

// The runs of ones in `mask` that hold a one of `bits`, by doubling.
Word FillRuns(Word bits, Word mask)
{
  if (~mask == 0)
  {
    return bits == 0 ? 0 : mask;
  }
  Word up = bits & mask;
  Word down = up;
  Word throughUp = mask;
  Word throughDown = mask;
  for (int step = 1; step < BitMask::BitsOfWord; step *= 2)
  {
    up |= throughUp & (up << step);
    throughUp &= throughUp << step;
    down |= throughDown & (down >> step);
    throughDown &= throughDown >> step;
  }
  return up | down;
}

// A flood fill from word to word.
class Flood
{
public:
  explicit Flood(const BitMask& mask)
    : Mask(mask)
    , Reached(mask.GetGeometry())
  {
  }

  void Enter(std::ptrdiff_t word, Word bits)
  {
    const Word added = bits & this->Mask.GetWords()[word] & ~this->Reached.GetWords()[word];
    if (added != 0)
    {
      this->Reached.GetWords()[word] |= added;
      this->Front.push_back(word);
    }
  }

  void Enter(const std::array<int, 3>& index)
  {
    const Word* const row = this->Mask.Row(index[1], index[2]);
    this->Enter(row - this->Mask.GetWords().data() + index[0] / BitMask::BitsOfWord,
      Word(1) << (index[0] % BitMask::BitsOfWord));
  }

  void EnterRow(int j, int k)
  {
    const std::ptrdiff_t first = this->Mask.Row(j, k) - this->Mask.GetWords().data();
    for (std::ptrdiff_t word = 0; word < this->Mask.GetWordsPerRow(); ++word)
    {
      this->Enter(first + word, ~Word(0));
    }
  }

  // False if the monitor stopped it.
  bool Spread(const Monitor& monitor)
  {
    const auto& size = this->Mask.GetGeometry().Dimensions;
    const std::ptrdiff_t row = this->Mask.GetWordsPerRow();
    const std::ptrdiff_t slice = row * size[1];
    for (std::size_t step = 0; !this->Front.empty(); ++step)
    {
      if (step % StepsBetweenQuestions == 0 && !monitor(0))
      {
        return false;
      }
      const std::ptrdiff_t word = this->Front.back();
      this->Front.pop_back();
      Word& bits = this->Reached.GetWords()[word];
      bits = FillRuns(bits, this->Mask.GetWords()[word]);
      const std::ptrdiff_t inRow = word % row;
      const std::ptrdiff_t j = word / row % size[1];
      const std::ptrdiff_t k = word / slice;
      this->EnterIf(inRow > 0, word - 1, bits << (BitMask::BitsOfWord - 1));
      this->EnterIf(inRow + 1 < row, word + 1, bits >> (BitMask::BitsOfWord - 1));
      this->EnterIf(j > 0, word - row, bits);
      this->EnterIf(j + 1 < size[1], word + row, bits);
      this->EnterIf(k > 0, word - slice, bits);
      this->EnterIf(k + 1 < size[2], word + slice, bits);
    }
    return true;
  }

  BitMask TakeReached() { return std::move(this->Reached); }

private:
  void EnterIf(bool exists, std::ptrdiff_t word, Word bits)
  {
    if (exists)
    {
      this->Enter(word, bits);
    }
  }

  const BitMask& Mask;
  BitMask Reached;
  std::vector<std::ptrdiff_t> Front;
};

} // namespace

bool KeepConnected(BitMask& mask, const std::vector<std::size_t>& sources, const Monitor& monitor)
{
  Flood flood(mask);
  for (std::size_t voxel : sources)
  {
    flood.Enter(IndexOf(voxel, mask.GetGeometry()));
  }
  if (!flood.Spread(monitor))
  {
    return false;
  }
  mask = flood.TakeReached();
  return true;
}

LeakControlRadii RadiiOf(const LeakControlSettings& settings, double seedRadius,
  const ImageGeometry& geometry)
{
  constexpr double minimumOpening = 2.5;
  constexpr double maximumOpening = 6;
  const double maximum = 2 * geometry.Spacing.maxCoeff();
  const double opening =
    std::max(minimumOpening, std::min(maximumOpening, settings.OpeningScale * seedRadius));
  return { std::min(settings.ClosingRadius, maximum),
    settings.OpeningScale > 0 ? std::min(opening, maximum) : 0 };
}

bool ControlLeaks(BitMask& mask, const SeedSphere& seed, const LeakControlRadii& radii,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  return ControlLeaks(mask, VoxelsInSphere(mask.GetGeometry(), seed), radii, parallelFor, monitor);
}

bool ControlLeaks(BitMask& mask, const std::vector<std::size_t>& sources,
  const LeakControlRadii& radii, const ParallelFor& parallelFor, const Monitor& monitor)
{
  if (radii.Closing > 0 &&
    !(Dilate(mask, radii.Closing, parallelFor, PartOf(monitor, 0, 0.15)) &&
      Erode(mask, radii.Closing, parallelFor, PartOf(monitor, 0.15, 0.3))))
  {
    return false;
  }
  if (radii.Opening > 0)
  {
    BitMask closed = mask;
    if (!Erode(mask, radii.Opening, parallelFor, PartOf(monitor, 0.3, 0.6)))
    {
      return false;
    }
    if (HoldsOne(mask, sources))
    {
      closed = BitMask();
      // The dilation leaves it connected, since balls are.
      return KeepConnected(mask, sources, PartOf(monitor, 0.6, 0.7)) &&
        Dilate(mask, radii.Opening, parallelFor, PartOf(monitor, 0.7, 1));
    }
    mask = std::move(closed);
  }
  return KeepConnected(mask, sources, PartOf(monitor, 0.9, 1));
}

bool FillHoles(BitMask& mask, const Monitor& monitor)
{
  const auto& size = mask.GetGeometry().Dimensions;
  BitMask outside = mask;
  outside.Complement();
  Flood flood(outside);
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      if (k == 0 || k + 1 == size[2] || j == 0 || j + 1 == size[1])
      {
        flood.EnterRow(j, k);
      }
      else
      {
        flood.Enter({ { 0, j, k } });
        flood.Enter({ { size[0] - 1, j, k } });
      }
    }
  }
  if (!flood.Spread(monitor))
  {
    return false;
  }
  mask = flood.TakeReached();
  mask.Complement();
  return true;
}

bool CutAtNoData(const VoxelReader& read, const SeedSphere& seed, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground)
{
  const std::size_t before = foreground.Count();
  RemoveNoData(read, parallelFor, foreground);
  return foreground.Count() == before ||
    (KeepConnected(foreground, VoxelsAround(foreground.GetGeometry(), seed), monitor) &&
      FillHoles(foreground, monitor));
}

} // namespace FlipFree

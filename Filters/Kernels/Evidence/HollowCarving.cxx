#include "Evidence/HollowCarving.h"

#include "Image/BallMorphology.h"
#include "Image/LocalMeans.h"
#include "Intensity/LeakControl.h"
#include "Intensity/RobustStatistics.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// In Hounsfield units.
constexpr float GrayValueOfFat = -100;
// Water with noise has more.
constexpr float MostlyFat = -30;
constexpr float Lowest = -1e6F;
// Of the way from the organ to fat, but in robust standard deviations of the organ at least, so
// that an organ of much fat is not carved.
constexpr float DarkPart = 1.0F / 3;
constexpr double LeastDifference = 2.5;

// In millimeters.
constexpr double HollowCoreMargin = 2;
constexpr double HollowBlockSize = 4;
constexpr double OrganDeviation = 8;
constexpr double HollowRadius = 10;
constexpr double FatReach = 8;

// Of the core's voxels around a block, so that they have a mean.
constexpr float LeastWeight = 1e-9F;

class Hollows
{
public:
  Hollows(const ImagePart& image, const ParallelFor& parallelFor, const Monitor& monitor,
    BitMask& mask)
    : Image(image)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Mask(mask)
    , Grid(mask.GetGeometry(), HollowBlockSize)
  {
  }

  bool Execute()
  {
    BitMask core = this->Mask;
    if (!Erode(core, HollowCoreMargin, this->Parallel, this->Ask))
    {
      return false;
    }
    std::vector<std::size_t> sources;
    core.ForEach([&](std::size_t voxel) { sources.push_back(voxel); });
    if (sources.empty())
    {
      return true;
    }
    // Far from the core, nothing is darker.
    this->Organ = LocalMeans(SumInBlocks(this->Image, core, this->Grid, this->Parallel),
      this->Grid.Blocks, OrganDeviation, LeastWeight, Lowest, this->Parallel);
    std::vector<float> differences = DifferencesFrom(this->Organ, this->Grid, this->Image, core);
    const auto difference =
      static_cast<float>(LeastDifference * RobustStatisticsOf(differences).StandardDeviation);
    BitMask dark = this->Darker(this->Mask,
      [=](float organ)
      { return organ - std::max(difference, DarkPart * (organ - GrayValueOfFat)); });
    BitMask bright = this->Mask;
    bright.Remove(dark);
    BitMask hollow = bright;
    if (!Dilate(hollow, HollowRadius, this->Parallel, this->Ask) ||
      !Erode(hollow, HollowRadius, this->Parallel, this->Ask))
    {
      return false;
    }
    hollow.Remove(bright);
    BitMask nearFat = this->Darker(hollow, [](float) { return MostlyFat; });
    if (!Dilate(nearFat, FatReach, this->Parallel, this->Ask))
    {
      return false;
    }
    dark.Intersect(hollow);
    dark.Intersect(nearFat);
    this->Mask.Remove(dark);
    // What the outside does not reach is not a hollow.
    return FillHoles(this->Mask, this->Ask) && KeepConnected(this->Mask, sources, this->Ask);
  }

private:
  // The voxels of the mask darker than a limit, which depends on the organ.
  template <typename Limit>
  BitMask Darker(const BitMask& mask, const Limit& limit) const
  {
    BitMask darker(mask.GetGeometry());
    this->Parallel(0, mask.GetGeometry().Dimensions[2],
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        BlockRow interpolate(this->Grid);
        std::array<float, BitMask::BitsOfWord> organ{};
        mask.ForEachRun(first, last,
          [&](int begin, int end, int j, int k)
          {
            const float* const row = this->Image.Row(j, k);
            interpolate.Read(this->Organ, begin, end, j, k, organ.data());
            for (int i = begin; i < end; ++i)
            {
              if (row[i] < limit(organ[i - begin]))
              {
                darker.Insert(i, j, k);
              }
            }
          });
      });
    return darker;
  }

  const ImagePart& Image;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  BitMask& Mask;
  const BlockGrid Grid;
  std::vector<float> Organ;
};

} // namespace

bool CarveHollows(const ImagePart& image, Modality modality, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& mask)
{
  return modality != Modality::CT || Hollows(image, parallelFor, monitor, mask).Execute();
}

} // namespace FlipFree

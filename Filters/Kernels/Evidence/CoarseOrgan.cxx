#include "Evidence/CoarseOrgan.h"

#include "Evidence/BoundarySupport.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/RegionCut.h"
#include "Image/BallInside.h"
#include "Image/BlockNetwork.h"
#include "Intensity/LeakControl.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Of the usual blocks of a cut (RegionBlockSize).
constexpr double CoarseScale = 1.6;

} // namespace

IntensityModel NarrowedTo(double mass, const IntensityModel& ofSeed)
{
  IntensityModel narrow = ofSeed;
  narrow.Threshold = std::max(narrow.Threshold, narrow.Mixture.ThresholdForMass(mass));
  return narrow;
}

CoarseOrgan::CoarseOrgan(const ImagePart& image, const ImageGeometry& voxels,
  const BitMask& foreground, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const IntensityModel& ofSeed,
  const ParallelFor& parallelFor)
  : Seed(seed)
  , Noise(noise)
  , Settings(settings)
  , OfSeed(ofSeed)
  , Parallel(parallelFor)
  , Grid(voxels, CoarseScale * RegionBlockSize(BallInside(foreground, seed).Radius))
  , Means(SmoothBlockMeans(image, Grid, parallelFor))
  , LeastContrast(LeastContrastAround(image.Image, seed, noise))
{
}

BitMask CoarseOrgan::BlocksOf(const BitMask& mask) const
{
  return this->Grid.BlocksWith(this->Grid.HalfOfBlock(), mask, this->Parallel);
}

double CoarseOrgan::SupportOf(const BitMask& blocks) const
{
  return BoundarySupport(this->View(), blocks, this->LeastContrast);
}

std::vector<BitMask> CoarseOrgan::Grow(const std::vector<double>& masses) const
{
  std::vector<BitMask> carved(masses.size());
  // Side by side: on so few blocks, each pass is too short for several threads.
  this->Parallel(0, static_cast<std::ptrdiff_t>(masses.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        this->Grow(masses[index], carved[index]);
      }
    });
  return carved;
}

void CoarseOrgan::Grow(double mass, BitMask& carved) const
{
  const ImageGeometry& blocks = this->Grid.Blocks;
  BitMask grown;
  FindForegroundInBox(this->View(), WholeBox(blocks), NarrowedTo(mass, this->OfSeed), this->Seed,
    RadiiOf(this->Settings.Leaks, this->Seed.Radius, blocks), SerialFor, NeverStop, grown);
  if (grown.Count() != 0)
  {
    CarveOrgan(this->View(), grown, nullptr, this->Seed, this->Noise, this->Settings.Modality,
      SerialFor, NeverStop, carved, nullptr);
  }
}

} // namespace FlipFree

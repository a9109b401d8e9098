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

bool CoarseOrgan::Grow(double mass, const Monitor& monitor, BitMask& carved) const
{
  const ImageGeometry& blocks = this->Grid.Blocks;
  BitMask grown;
  if (!FindForegroundInBox(this->View(), WholeBox(blocks), NarrowedTo(mass, this->OfSeed),
        this->Seed, RadiiOf(this->Settings.Leaks, this->Seed.Radius, blocks), this->Parallel,
        monitor, grown))
  {
    return false;
  }
  carved = BitMask();
  return grown.Count() == 0 ||
    CarveOrgan(this->View(), grown, nullptr, this->Seed, this->Noise, this->Settings.Modality,
      this->Parallel, monitor, carved, nullptr);
}

} // namespace FlipFree

/**
 * The surroundings of an organ on blocks of voxels, for quick second looks: what grows from its
 * seed by other gray values, and how well the image supports a mask there.
 */
#ifndef FlipFreeCoarseOrgan_h
#define FlipFreeCoarseOrgan_h

#include "Image/BitMask.h"
#include "Image/BlockGrid.h"
#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/OrganFeature.h"

#include <vector>

namespace FlipFree
{

/// The seed's model with an interval of gray values that holds no more than this part of its mass.
IntensityModel NarrowedTo(double mass, const IntensityModel& ofSeed);

class CoarseOrgan
{
public:
  /// `voxels` is the grid of the image's part; the foreground is on it, or on that of the whole
  /// image. `noise` is the standard deviation before smoothing; the settings' modality is not
  /// Automatic; `ofSeed` is the seed's (FitToSeed()). Refers to the seed, the settings, `ofSeed`
  /// and `parallelFor`.
  CoarseOrgan(const ImagePart& image, const ImageGeometry& voxels, const BitMask& foreground,
    const SeedSphere& seed, double noise, const OrganFeatureSettings& settings,
    const IntensityModel& ofSeed, const ParallelFor& parallelFor);

  const BlockGrid& GetGrid() const { return this->Grid; }

  /// The blocks of which a mask on the grid of the voxels holds half.
  BitMask BlocksOf(const BitMask& mask) const;

  /// Of a mask of blocks; contrast below the least does not count (BoundarySupport.h).
  double SupportOf(const BitMask& blocks) const;
  double GetLeastContrast() const { return this->LeastContrast; }

  /// Grows from the seed by the gray values that hold this part of the seed's mass, and carves;
  /// without a grid where nothing grows. Returns false if the monitor stopped it.
  bool Grow(double mass, const Monitor& monitor, BitMask& carved) const;

private:
  ImageView<float> View() const { return { this->Means.data(), this->Grid.Blocks }; }

  const SeedSphere& Seed;
  const double Noise;
  const OrganFeatureSettings& Settings;
  const IntensityModel& OfSeed;
  const ParallelFor& Parallel;
  const BlockGrid Grid;
  const std::vector<float> Means;
  const double LeastContrast;
};

} // namespace FlipFree

#endif

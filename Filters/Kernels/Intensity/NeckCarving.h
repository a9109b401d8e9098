/**
 * Carves what hangs on to an organ by a neck off its mask: a minimum cut inside the mask, between
 * the seed and the cores of the parts behind necks, so that the cut itself finds where the organ
 * ends.
 */
#ifndef FlipFreeNeckCarving_h
#define FlipFreeNeckCarving_h

#include "Image/BitMask.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

/// A part of an image, which begins at the voxel `First`.
struct ImagePart
{
  const ImageView<float>& Image;
  std::array<int, 3> First;

  /// The values of a row of the part.
  const float* Row(int j, int k) const
  {
    return &this->Image(this->First[0], this->First[1] + j, this->First[2] + k);
  }
};

/// What is known of the seed's gray values.
struct SeedStatistics
{
  double Median = 0;
  double Deviation = 0; ///< robust
};

/// Carves the mask, which is on the grid of the part. Returns false if the monitor stopped it; the
/// mask is then useless.
bool CarveNecks(const ImagePart& image, const SeedSphere& seed, double noise, Modality modality,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask);

/// Fills the holes of a mask: what is not connected, by faces, with the sides of its grid.
bool FillHoles(BitMask& mask, const Monitor& monitor);

} // namespace FlipFree

#endif

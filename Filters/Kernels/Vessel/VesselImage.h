/**
 * The part of an image in which a vessel is sought: slightly smoothed, on the image's own grid for
 * cross-sections, and on a grid of cubes for paths.
 */
#ifndef FlipFreeVesselImage_h
#define FlipFreeVesselImage_h

#include "Image/AnisotropicDiffusion.h"
#include "Image/SeedRegion.h"

namespace FlipFree
{

struct VesselImage
{
  FloatImage Own;
  FloatImage Cubes; ///< at right angles even where the image's axes are not
  /// The cubes that lie in voxels without data, ascending; they have the values of near voxels.
  std::vector<std::size_t> WithoutData;
};

/// Averages over a Gaussian window of the image alone; what lies beyond its rim does not count.
void SmoothInside(FloatImage& image, double deviation, const ParallelFor& parallelFor);

/// Gives voxels without data (NoData.h) the value of the next one with data in their row; rows,
/// columns and slices without any that of the next such one. So an image goes on beyond its end.
/// One voxel has data at least.
void ContinueData(FloatImage& image);

/// Smooths the voxels and samples them at the corners of cubes of `edge` millimeters.
VesselImage MakeVesselImage(FloatImage voxels, double deviation, double edge,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

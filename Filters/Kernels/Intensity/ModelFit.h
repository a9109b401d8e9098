/**
 * Fits the intensity model to an image: to the seed sphere, and then to the inside of a surface.
 */
#ifndef FlipFreeModelFit_h
#define FlipFreeModelFit_h

#include "Image/SeedRegion.h"
#include "Intensity/IntensityModel.h"

namespace FlipFree
{

/// Fits the model to the seed. Throws Error where that touches voxels without data.
IntensityModel FitToSeed(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const IntensitySettings& settings);

enum class Refit
{
  Done,
  NothingInside, ///< no voxel's center lies within the surface
  TooFewInside,  ///< MinimumRefitSample or fewer lie more than InnerMargin inside it
  Stopped        ///< by the monitor
};

/// As many voxels or fewer do not make a histogram.
constexpr std::size_t MinimumRefitSample = 200;

/// Fits the model again, to the inside of a closed surface. The monitor is asked before each pass
/// over the image. Unless the result is Done, the model is unchanged.
Refit RefitToSurface(const ImageView<float>& smooth, const PointList& points,
  const TriangleList& triangles, double noise, const IntensitySettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor, IntensityModel& model);

/// The same, to the voxels inside it, a mask of the part of the image that begins at the voxel
/// `first`; the part holds the shell around them, as far as the image does.
Refit RefitToInside(const ImageView<float>& smooth, const std::array<int, 3>& first, BitMask inside,
  double noise, const IntensitySettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, IntensityModel& model);

/// Reduces `inside`, the voxels inside a surface, to those well inside, and makes the shell around
/// the surface. Returns false if the monitor, asked before each pass over the masks, stopped it;
/// the masks are then useless.
bool MakeInsideAndShell(const IntensitySettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& inside, BitMask& shell);

} // namespace FlipFree

#endif

/**
 * The feature image of the organ (paper section 3.2) with its threshold, and its leak control.
 */
#ifndef FlipFreeOrganFeature_h
#define FlipFreeOrganFeature_h

#include "Intensity/IntensityModel.h"
#include "Intensity/LeakControl.h"

namespace FlipFree
{

struct OrganFeatureSettings
{
  IntensitySettings Intensity;

  /// Fit the intensities again to the inside of the surface, once there is one.
  bool ReestimateIntensities = true;

  bool ControlLeaks = true;
  LeakControlSettings Leaks;
};

/// The voxels of a smoothed image whose feature is at or above the model's threshold, after leak
/// control. Returns false if the monitor, asked before each pass over the image, stopped it; what
/// is in `foreground` is then useless.
bool FindForeground(const ImageView<float>& smooth, const IntensityModel& model,
  const SeedSphere& seed, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground);

/// The same, looked for in a box of the image alone. Voxels that are nearer to the box's sides than
/// ForegroundMargin() may be wrong. If all voxels found keep that margin from the sides that are
/// not the image's own, the result is that of the whole image. Throws std::invalid_argument unless
/// the box lies in the image, holds the seed sphere's voxels, and begins at a multiple of
/// BitMask::BitsOfWord along x.
bool FindForegroundInBox(const ImageView<float>& smooth, const VoxelBox& box,
  const IntensityModel& model, const SeedSphere& seed, const LeakControlRadii& leaks,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground);

/// How far, in voxels along each axis, the sides of a box are felt: a foreground all of whose
/// voxels are farther than that from the sides that are not the image's own is the same as that of
/// the whole image. Leak control's masks are right where no ball of closing and opening, one after
/// the other, reaches beyond the sides; and what hangs together with the seed cannot have left that
/// part of the box without being seen on its rim.
std::array<int, 3> ForegroundMargin(const ImageGeometry& geometry, const LeakControlRadii& leaks);

/// The feature of a smoothed image. Voxels that leak control has taken away get half the model's
/// threshold, and voxels that it has filled in get the threshold; all others keep what they have.
std::vector<float> MakeFeature(const ImageView<float>& smooth, const IntensityModel& model,
  const BitMask& foreground, const ParallelFor& parallelFor);

/// Throws std::invalid_argument when all but a thousandth of the voxels are foreground: then there
/// is no boundary to be found.
void RequireContrast(const BitMask& foreground);

/// Fits the model to the seed.
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

/// Fits it again to the inside of a closed surface. The monitor is asked before each pass over the
/// image. Unless it is done, the model is as it was.
Refit RefitToSurface(const ImageView<float>& smooth, const PointList& points,
  const TriangleList& triangles, double noise, const IntensitySettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor, IntensityModel& model);

} // namespace FlipFree

#endif

/**
 * The foreground of a smoothed image, with leak control, and the feature image of the organ (paper
 * section 3.2).
 */
#ifndef FlipFreeOrganFeature_h
#define FlipFreeOrganFeature_h

#include "Intensity/IntensityModel.h"
#include "Intensity/LeakControl.h"
#include "Intensity/Modality.h"

namespace FlipFree
{

struct OrganFeatureSettings
{
  IntensitySettings Intensity;

  /// Fit the intensities again to the inside of the surface, once there is one.
  bool ReestimateIntensities = true;

  /// Once all levels have run, carve off what is connected to the surface's inside only by a neck
  /// and move its boundary to half the local contrast; then run all levels again with that for the
  /// foreground.
  bool Carving = true;

  /// Where carving changed much of the surface's inside, seek further opinions and decide once more
  /// (OrganConsensus.h). Part of Carving; needs ControlLeaks.
  bool Consensus = true;

  FlipFree::Modality Modality = FlipFree::Modality::Automatic;

  bool ControlLeaks = true;
  LeakControlSettings Leaks;
};

/// The voxels of a smoothed image whose feature is at or above the model's threshold, after leak
/// control. Returns false if the monitor, asked before each pass over the image, stopped it;
/// `foreground` is then useless.
bool FindForeground(const ImageView<float>& smooth, const IntensityModel& model,
  const SeedSphere& seed, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground);

/// The same with leak control, from the voxels of a box of the image alone, which holds the seed
/// sphere. Voxels within ForegroundMargin() of the box's sides may be wrong. If all voxels found
/// keep that margin from the sides inside the image, the result is that of the whole
/// image.
bool FindForegroundInBox(const ImageView<float>& smooth, const VoxelBox& box,
  const IntensityModel& model, const SeedSphere& seed, const LeakControlRadii& leaks,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground);

/// How far the sides of a box influence the foreground, in voxels along each axis. Leak control is
/// right where no ball of closing and opening, one after the other, reaches beyond the sides; and
/// what is connected with the seed cannot leave that part of the box without appearing in its
/// boundary layer.
std::array<int, 3> ForegroundMargin(const ImageGeometry& geometry, const LeakControlRadii& leaks);

/// The feature of a smoothed image. Voxels that leak control removed get half the model's
/// threshold, voxels that it filled in get the threshold, and others without data NaN.
std::vector<float> MakeFeature(const ImageView<float>& smooth, const IntensityModel& model,
  const BitMask& foreground, const ParallelFor& parallelFor);

/// Throws an Error if all but a thousandth of the voxels are foreground: there is no
/// boundary to find.
void RequireContrast(const BitMask& foreground);

} // namespace FlipFree

#endif

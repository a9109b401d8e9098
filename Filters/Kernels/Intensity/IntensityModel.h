/**
 * How well a gray value fits the organ: first from the seed sphere's mixture (paper section 3.2),
 * and once there is a surface, from the values inside it against those of a shell around it.
 */
#ifndef FlipFreeIntensityModel_h
#define FlipFreeIntensityModel_h

#include "Image/BitMask.h"
#include "Image/EdgeRamp.h"
#include "Image/GrayIntervals.h"
#include "Image/SeedRegion.h"
#include "Intensity/GaussianMixture.h"

namespace FlipFree
{

struct IntensitySettings
{
  MixtureSettings Mixture;

  /// Standard deviations of the noise by which the mixture is widened, added in squares.
  double NoiseWidening = 1;

  /// Mass of the foreground above the threshold; counts if Threshold is zero.
  double ForegroundMass = 0.95;

  /// Gamma; zero: from ForegroundMass, and after re-estimation even odds.
  double Threshold = 0;

  /// Odds at which a value that background has as well still is foreground (re-estimation).
  double BackgroundRatio = 0.5;

  /// The shell around the surface that models the background, and the margin inside it that does
  /// not model the foreground, in millimeters.
  double ShellBegin = 1.5;
  double ShellEnd = 12;
  double InnerMargin = 2;

  /// Half width of the ramp by which edges are located, in deviations of the noise.
  double EdgeRamp = 20;
};

class IntensityModel
{
public:
  GaussianMixture Mixture;
  double Threshold = 0.5; ///< of the feature (Gamma)
  EdgeRamp Ramp;

  /// The feature of a gray value, in [0, 1]; tabulated.
  float operator()(float z) const { return this->Table[this->PlaceOf(z)]; }

  /// The gray values whose feature is at or above the threshold.
  GrayIntervals Foreground() const;

  /// Fits the mixture to the seed's values.
  static IntensityModel FromSeed(const std::vector<float>& values, double noise,
    const IntensitySettings& settings);

  /// Replaces the feature by the odds of the gray values `inside` against those `outside`, within
  /// the one interval about the median inside in which they favor it. Mixture and ramp stay. The
  /// masks are of a part of the image, which begins at the voxel `first`.
  void Reestimate(const ImageView<float>& image, const std::array<int, 3>& first,
    const BitMask& inside, const BitMask& outside, double noise, const IntensitySettings& settings,
    const ParallelFor& parallelFor);

private:
  std::size_t PlaceOf(float z) const;

  float Begin = 0;
  float Step = 1;
  std::vector<float> Table;
};

/// The median of the image's voxels in the mask, which must hold one: of an even number the upper
/// one. Sorts nothing and copies nothing. The mask is of a part of the image, which begins at the
/// voxel `first`.
float MedianOf(const ImageView<float>& image, const std::array<int, 3>& first, const BitMask& mask,
  const ParallelFor& parallelFor);

/// Cuts `inside`, the voxels inside a surface, down to those well inside, and gives the shell
/// around the surface. Returns false if the monitor, asked before each pass over the masks, stopped
/// it; the masks are then useless.
bool MakeInsideAndShell(const IntensitySettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& inside, BitMask& shell);

} // namespace FlipFree

#endif

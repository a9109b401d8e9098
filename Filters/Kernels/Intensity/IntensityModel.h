/**
 * How well a gray value fits the organ: at first by the seed sphere's mixture (paper section 3.2),
 * and once there is a surface, by the values inside it against those of a shell around it.
 */
#ifndef FlipFreeIntensityModel_h
#define FlipFreeIntensityModel_h

#include "Image/BitMask.h"
#include "Image/EdgeRamp.h"
#include "Image/NoData.h"
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

  /// Odds at which a value that also occurs in the background still counts as foreground
  /// (re-estimation).
  double BackgroundRatio = 0.5;

  /// The shell around the surface that models the background, and the margin inside the surface
  /// that is left out of the foreground's model, in millimeters.
  double ShellBegin = 1.5;
  double ShellEnd = 12;
  double InnerMargin = 2;

  /// Half width of the ramp by which edges are located, in standard deviations of the noise.
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

  /// The smallest float at or above the threshold.
  float ThresholdRoundedUp() const;

  /// The voxels of a part of an image whose feature is at or above the threshold, on the part's
  /// grid; none without data.
  BitMask Foreground(const ImageView<float>& image, const VoxelBox& box,
    const ParallelFor& parallelFor) const;

  /// Fits the mixture to the seed's values.
  static IntensityModel FromSeed(const std::vector<float>& values, double noise,
    const IntensitySettings& settings);

  /// Replaces the feature by the odds of the gray values `inside` against those `outside`, within
  /// the one interval about the median inside in which they favor it. Mixture and ramp stay. The
  /// masks are of the part of the image that begins at the voxel `first`.
  void Reestimate(const ImageView<float>& image, const std::array<int, 3>& first,
    const BitMask& inside, const BitMask& outside, double noise, const IntensitySettings& settings,
    const ParallelFor& parallelFor);

private:
  int PlaceOf(float z) const;

  float Begin = 0;
  float Step = 1;
  std::vector<float> Table;
};

/// The median of the image's voxels in a non-empty mask: of an even number the upper one. The mask
/// is of the part of the image that begins at the voxel `first`.
float MedianOf(const ImageView<float>& image, const std::array<int, 3>& first, const BitMask& mask);

} // namespace FlipFree

#endif

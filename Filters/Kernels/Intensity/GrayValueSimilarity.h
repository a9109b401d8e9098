/**
 * How much gray values look like those around a point, on the scale of the noise and the modality.
 */
#ifndef FlipFreeGrayValueSimilarity_h
#define FlipFreeGrayValueSimilarity_h

#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"
#include "Intensity/RobustStatistics.h"

namespace FlipFree
{

class GrayValueSimilarity
{
public:
  /// `noise` is the standard deviation before smoothing; the modality is not Automatic.
  GrayValueSimilarity(double noise, Modality modality)
    : Noise(noise)
    , IsMR(modality == Modality::MR)
  {
  }

  /// The standard deviation that gray values are compared by.
  double SpreadOf(const RobustStatistics& of) const;

  /// From -1, nothing like it, to 1.
  double LikenessOf(double value, const RobustStatistics& of) const;

  /// How far around a point the smoothed image looks like it, at most `limit` millimeters.
  double ReachOfLikeness(const ImageView<float>& image, const Eigen::Vector3d& point,
    double limit) const;

private:
  double Noise;
  bool IsMR;
};

/// Of the gray values in a ball; of the voxel next to its center if it holds none.
RobustStatistics StatisticsInBall(const ImagePart& image, const ImageGeometry& geometry,
  const SeedSphere& ball);

} // namespace FlipFree

#endif

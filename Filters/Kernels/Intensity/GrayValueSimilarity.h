/**
 * How much gray values look like those around a point, on the scale of the noise and the modality.
 */
#ifndef FlipFreeGrayValueSimilarity_h
#define FlipFreeGrayValueSimilarity_h

#include "Image/ImagePart.h"
#include "Image/SeedRegion.h"
#include "Intensity/Modality.h"
#include "Intensity/RobustStatistics.h"

#include <vector>

namespace FlipFree
{

/// Shells about a point, from the innermost, as long as at least half of the voxels in each look
/// alike.
class AlikeShells
{
public:
  /// As thick as `step`, up to the first that reaches beyond `limit`; both in millimeters.
  AlikeShells(double step, double limit)
    : Step(step)
    , Limit(limit)
    , Shells(static_cast<std::size_t>(limit / step) + 2)
  {
  }

  void Add(double away, bool isAlike);

  /// The radius of the last shell, at most the limit; 0 without any.
  double Reach() const;

private:
  struct Shell
  {
    int Size = 0;
    int Alike = 0;
  };

  double Step;
  double Limit;
  std::vector<Shell> Shells;
};

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
  double ReachOfLikeness(const ImagePart& image, const ImageGeometry& geometry,
    const Eigen::Vector3d& point, double limit) const;

private:
  double Noise;
  bool IsMR;
};

/// Of the gray values in a ball; of the voxel next to its center if it holds none.
RobustStatistics StatisticsInBall(const ImagePart& image, const ImageGeometry& geometry,
  const SeedSphere& ball);

} // namespace FlipFree

#endif

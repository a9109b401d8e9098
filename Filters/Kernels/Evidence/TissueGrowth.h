/**
 * What an inside point shows that was not expected in the organ, such as the cortex of a kidney
 * whose seed lies in a cyst: the foreground that grows from the point's surroundings by their own
 * gray values, as the organ's first one does from its seed.
 */
#ifndef FlipFreeTissueGrowth_h
#define FlipFreeTissueGrowth_h

#include "Image/MaskPart.h"
#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

#include <memory>
#include <utility>
#include <vector>

namespace FlipFree
{

class TissueGrowth
{
public:
  /// The arguments must outlive the object. `noise` is the standard deviation before smoothing.
  TissueGrowth(SmoothRegion& region, double noise, const OrganFeatureSettings& settings,
    const ParallelFor& parallelFor);

  /// In the region; without voxels where the place's surroundings have no data. Null if the monitor
  /// stopped it. What has grown from a place is kept for further calls.
  std::shared_ptr<const MaskPart> From(const Eigen::Vector3d& place, const Monitor& monitor);

private:
  bool Grow(const Eigen::Vector3d& place, const Monitor& monitor, MaskPart& tissue);

  SmoothRegion& Region;
  const double Noise;
  const OrganFeatureSettings& Settings;
  const ParallelFor& Parallel;
  std::vector<std::pair<Eigen::Vector3d, std::shared_ptr<const MaskPart>>> Kept;
};

} // namespace FlipFree

#endif

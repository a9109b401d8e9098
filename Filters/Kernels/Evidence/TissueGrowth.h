/**
 * What an inside point shows that was not expected in the organ, such as the cortex of a kidney
 * whose seed lies in a cyst: the foreground that grows from the point's surroundings by their own
 * gray values, as the organ's first one does from its seed.
 */
#ifndef FlipFreeTissueGrowth_h
#define FlipFreeTissueGrowth_h

#include "Image/SmoothRegion.h"
#include "Intensity/OrganFeature.h"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace FlipFree
{

struct GrownTissue
{
  VoxelBox Box;   ///< in the grid of the region
  BitMask Voxels; ///< in the box; none where the point's surroundings have no data

  /// Whether it holds a voxel of the region.
  bool Holds(const std::array<int, 3>& voxel) const
  {
    const std::array<int, 3>& first = this->Box.Begin;
    const std::array<int, 3> in{ { voxel[0] - first[0], voxel[1] - first[1],
      voxel[2] - first[2] } };
    return this->Voxels.HasGrid() && this->Voxels.GetGeometry().Contains(in[0], in[1], in[2]) &&
      this->Voxels(in[0], in[1], in[2]);
  }
};

class TissueGrowth
{
public:
  /// The arguments must outlive the object. `noise` is the standard deviation before smoothing.
  TissueGrowth(SmoothRegion& region, double noise, const OrganFeatureSettings& settings,
    const ParallelFor& parallelFor);

  /// Null if the monitor stopped it. What has grown from a place is kept for further calls.
  std::shared_ptr<const GrownTissue> From(const Eigen::Vector3d& place, const Monitor& monitor);

private:
  bool Grow(const Eigen::Vector3d& place, const Monitor& monitor, GrownTissue& tissue);

  SmoothRegion& Region;
  const double Noise;
  const OrganFeatureSettings& Settings;
  const ParallelFor& Parallel;
  std::vector<std::pair<Eigen::Vector3d, std::shared_ptr<const GrownTissue>>> Kept;
};

} // namespace FlipFree

#endif

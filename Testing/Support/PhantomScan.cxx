#include "PhantomScan.h"

#include "Phantom/AbdomenPhantom.h"

#include <algorithm>

namespace FlipFree
{

PhantomScan ScanPhantom(const Phantom& phantom, std::uint8_t label,
  const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  const ParallelFor& parallelFor)
{
  PhantomScan scan;
  scan.Label = label;
  scan.Geometry.Dimensions = dimensions;
  scan.Geometry.Spacing = spacing;
  scan.Voxels.resize(scan.Geometry.NumberOfVoxels());
  scan.Labels.resize(scan.Geometry.NumberOfVoxels());
  SamplingOptions options;
  options.NoiseStandardDeviation = 12;
  options.NoiseCorrelation = 0.3;
  options.Seed = 1;
  SampleTissues(phantom.Tissues, scan.Geometry, options, scan.Voxels.data(), scan.Labels.data(),
    parallelFor);
  const auto organ = std::find_if(phantom.Seeds.begin(), phantom.Seeds.end(),
    [label](const PhantomSeed& seed) { return seed.Label == label; });
  scan.Seed = { GridToPhysical(scan.Geometry, organ->Start.Center), organ->Start.Radius };
  return scan;
}

PhantomScan ScanAbdomen(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  double scale, const ParallelFor& parallelFor)
{
  return ScanPhantom(MakeAbdomenPhantom(scale * Eigen::Vector3d(330, 255, 270)),
    static_cast<std::uint8_t>(AbdomenLabel::Liver), dimensions, spacing, parallelFor);
}

} // namespace FlipFree

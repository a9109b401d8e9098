#include "PhantomScan.h"

#include "AbdomenPhantom.h"

#include <algorithm>

namespace FlipFree
{

PhantomScan ScanAbdomen(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  double scale, const ParallelFor& parallelFor)
{
  const Phantom phantom = MakeAbdomenPhantom(scale * Eigen::Vector3d(330, 255, 270));
  PhantomScan scan;
  scan.Geometry.Dimensions = dimensions;
  scan.Geometry.Spacing = spacing;
  scan.Voxels.resize(scan.Geometry.NumberOfVoxels());
  scan.Labels.resize(scan.Geometry.NumberOfVoxels());
  SamplingOptions options;
  options.NoiseDeviation = 12;
  options.NoiseCorrelation = 0.3;
  options.Seed = 1;
  SampleTissues(phantom.Tissues, scan.Geometry, options, scan.Voxels.data(), scan.Labels.data(),
    parallelFor);
  scan.Label = static_cast<std::uint8_t>(AbdomenLabel::Liver);
  const auto liver = std::find_if(phantom.Seeds.begin(), phantom.Seeds.end(),
    [&scan](const PhantomSeed& seed) { return seed.Label == scan.Label; });
  scan.Seed = { GridToPhysical(scan.Geometry, liver->Start.Center), liver->Start.Radius };
  return scan;
}

OrganSegmentationSettings LiverSettings(const PhantomScan& scan)
{
  const double voxel = scan.Geometry.Spacing.maxCoeff();
  OrganSegmentationSettings settings;
  settings.DistanceTolerance = 0.1 * voxel;
  settings.ChangeTolerance = 0.02 * voxel;
  settings.Feature.Leaks.OpeningRadius = std::min(6.0, 2 * voxel);
  CorrespondenceSettings& search = settings.Targets.Correspondence;
  search.SearchDistance = std::clamp(1.6 * scan.Seed.Radius, 15.0, 60.0);
  search.RunLength = 2;
  search.ImageEndDistance = 12;
  search.EdgeWindow = 3;
  settings.Targets.MaximumDisplacement = 8 * voxel;
  return settings;
}

} // namespace FlipFree

/**
 * A scan of the abdomen phantom: any grid, any size of the body, with the noise of a CT; the liver
 * is the organ. And the settings by which kernels segment it as vtkFlipFreeSegmentation does.
 */
#ifndef PhantomScan_h
#define PhantomScan_h

#include "OrganSegmentation.h"

#include <cstdint>
#include <vector>

namespace FlipFree
{

struct PhantomScan
{
  ImageGeometry Geometry;
  std::vector<std::int16_t> Voxels;
  std::vector<std::uint8_t> Labels;
  SeedSphere Seed; ///< in the liver
  std::uint8_t Label = 0;
};

/// The body lies in the middle of the grid; in its natural size, a scale of 1, it takes 330 x 255 x
/// 270 mm.
PhantomScan ScanAbdomen(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  double scale, const ParallelFor& parallelFor);

/// How far the surface may get from the seed, in millimetres.
constexpr double LiverReach = 250;

OrganSegmentationSettings LiverSettings(const PhantomScan& scan);

} // namespace FlipFree

#endif

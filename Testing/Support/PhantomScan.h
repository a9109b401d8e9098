/**
 * Scans of phantoms, with the noise of a CT.
 */
#ifndef PhantomScan_h
#define PhantomScan_h

#include "Image/SeedRegion.h"
#include "Phantom/Phantom.h"

#include <cstdint>
#include <vector>

namespace FlipFree
{

struct PhantomScan
{
  ImageGeometry Geometry;
  std::vector<std::int16_t> Voxels;
  std::vector<std::uint8_t> Labels;
  SeedSphere Seed;
  std::uint8_t Label = 0;
};

/// The organ is the object of that label; the phantom lies in the middle of the grid.
PhantomScan ScanPhantom(const Phantom& phantom, std::uint8_t label,
  const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  const ParallelFor& parallelFor);

/// The liver of the abdomen, whose body in its natural size, a scale of 1, takes 330 x 255 x 270
/// mm.
PhantomScan ScanAbdomen(const std::array<int, 3>& dimensions, const Eigen::Vector3d& spacing,
  double scale, const ParallelFor& parallelFor);

/// How far the surface may get from the seed, in millimeters.
constexpr double OrganReach = 250;

} // namespace FlipFree

#endif

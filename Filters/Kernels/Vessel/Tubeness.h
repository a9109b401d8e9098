/**
 * How much a voxel resembles the middle of a bright tube, from second derivatives (Y. Sato et al.:
 * Three-dimensional multi-scale line filter, 1998). Within organs and along their borders, which
 * are as bright as a vessel, there is no tube.
 */
#ifndef FlipFreeTubeness_h
#define FlipFreeTubeness_h

#include "Image/SeedRegion.h"

#include <vector>

namespace FlipFree
{

/// Per voxel of an image smoothed by `deviation` millimeters (SmoothInside()), in gray values: the
/// geometric mean of both curvatures across the tube, zero where one is not negative, times the
/// square of the deviation. Voxels where `wanted` is zero, and those at the rim of the image, are
/// zero.
std::vector<float> BrightTubeness(const FloatImage& image, const std::vector<unsigned char>& wanted,
  double deviation, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * Private to the module: what ITK's recursive Gaussians need, as an error of ours.
 */
#ifndef FlipFreeGaussianWidth_h
#define FlipFreeGaussianWidth_h

#include "KernelTypes.h"

#include <stdexcept>
#include <string>

namespace FlipFree
{

/// Throws std::invalid_argument if the part of the image that can be reached has fewer than four
/// voxels along one of its first `axes` axes.
inline void RequireGaussianWidth(const ImageGeometry& region, int axes)
{
  constexpr int least = 4;
  for (int axis = 0; axis < axes; ++axis)
  {
    if (region.Dimensions[axis] < least)
    {
      throw std::invalid_argument("only " + std::to_string(region.Dimensions[axis]) +
        " voxels of the image on port 0 can be reached along axis " + std::to_string(axis) +
        ", and gradients need four; give it a larger image, raise Reach, or choose another method");
    }
  }
}

} // namespace FlipFree

#endif

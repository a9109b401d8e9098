/**
 * Gaussian smoothing in millimeters along the grid's axes, truncated at three standard deviations.
 * Beyond the image everything is zero: to average over a part of the image alone, smooth the part's
 * values and its weights, and divide (normalized convolution).
 */
#ifndef FlipFreeGaussianSmoothing_h
#define FlipFreeGaussianSmoothing_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

void SmoothGaussian(std::vector<float>& voxels, const ImageGeometry& geometry, double deviation,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

/**
 * Dilation and erosion of masks by balls measured in millimetres.
 */
#ifndef FlipFreeBallMorphology_h
#define FlipFreeBallMorphology_h

#include "KernelTypes.h"

#include <vector>

namespace FlipFree
{

/// Sets (value 1) or clears (value 0) all voxels within `radius` millimetres of one that is.
void GrowValue(std::vector<unsigned char>& mask, const ImageGeometry& geometry, double radius,
  unsigned char value, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

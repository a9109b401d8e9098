/**
 * How far inside a tree of vessels each voxel of a grid around it is.
 */
#ifndef FlipFreeTreeDepth_h
#define FlipFreeTreeDepth_h

#include "Image/SeedRegion.h"
#include "Vessel/VesselTree.h"

namespace FlipFree
{

/// On a grid of cubes of `edge` millimeters around all sections; see MergeTubeDepth().
FloatImage DepthOnGrid(const VesselTree& tree, double edge, double margin,
  const ParallelFor& parallelFor);

/// Of the thinnest branch: the quartile of its sections, mm.
double SmallestRadius(const VesselTree& tree);

} // namespace FlipFree

#endif

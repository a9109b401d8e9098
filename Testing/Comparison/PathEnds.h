/**
 * What lies beyond the ends of a path.
 */
#ifndef FlipFreePathEnds_h
#define FlipFreePathEnds_h

#include "Image/BitMask.h"

#include <vector>

namespace FlipFree
{

/// The lines of a path, the first one and its branches. Each has two points at least.
using PathLines = std::vector<PointList>;

/// The voxels whose nearest point of the path is an end of it, and which lie on the far side of the
/// plane across the path there. The ends are the first line's first point and each line's last: a
/// branch begins within another line. A path may pass beside its own ends: what is nearer to
/// another point of it is not beyond.
BitMask VoxelsBeyondEnds(const PathLines& path, const ImageGeometry& geometry,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

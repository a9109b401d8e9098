/**
 * How long the edges of a deforming surface are: the scale of all lengths that are relative to its
 * resolution.
 */
#ifndef FlipFreeEdgeLength_h
#define FlipFreeEdgeLength_h

#include "KernelTypes.h"

#include <array>
#include <vector>

namespace FlipFree
{

/// The mean length of the edges, in millimeters. If one is more than eight times as long as that,
/// the mean of those up to eight upper quartiles: a few stray vertices do not make everything else
/// look small. There is at least one vertex.
double TypicalEdgeLength(const std::vector<std::array<int, 4>>& neighbors, const PointList& points);

} // namespace FlipFree

#endif

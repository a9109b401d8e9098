/**
 * A closed tube of quads along a line: the paper's cube (section 3.1) as a box of n x n x m cells,
 * bent along the line, its square cross-sections made disks. Every vertex has four neighbors; at
 * the corners of the box there are 8 triangles.
 */
#ifndef FlipFreeQuadTube_h
#define FlipFreeQuadTube_h

#include "KernelTypes.h"

#include <string>

namespace FlipFree
{

struct QuadTube
{
  PointList Points;
  FaceList Faces; ///< counter-clockwise seen from outside
};

/// `radii`: at the points of the line. `n`: vertices along a side of the square; the tube has 4 n
/// around and as many along as make its cells even. Throws Error, naming the line by `name`, for
/// fewer than two points, two alike in a row, radii that are not positive, and where the tube would
/// intersect itself: where the line bends more tightly than its radius, or comes too near to
/// itself.
QuadTube MakeQuadTube(const PointList& line, const Eigen::VectorXd& radii, int n,
  const std::string& name, const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

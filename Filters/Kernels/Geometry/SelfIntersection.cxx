#include "Geometry/SelfIntersection.h"

#include "Geometry/TriangleIntersection.h"

namespace FlipFree
{

std::vector<std::pair<int, int>> FindSelfIntersections(const PointList& points,
  const TriangleList& triangles)
{
  return FindSelfIntersections(TriangleTree(points, triangles), points, triangles, SerialFor);
}

std::vector<std::pair<int, int>> FindSelfIntersections(const TriangleTree& tree,
  const PointList& points, const TriangleList& triangles, const ParallelFor& parallelFor)
{
  const std::vector<TriangleBox> boxes = tree.RefitBoxes(points, triangles);
  return tree.SelfPairs([&](int node, int other) { return boxes[node].Touches(boxes[other]); },
    [&](int one, int two) { return TrianglesIntersect(points, triangles, one, two); }, parallelFor);
}

std::ptrdiff_t CountSelfIntersections(const PointList& points, const TriangleList& triangles)
{
  return static_cast<std::ptrdiff_t>(FindSelfIntersections(points, triangles).size());
}

} // namespace FlipFree

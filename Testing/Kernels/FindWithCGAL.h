/**
 * Self-intersections as CGAL finds them: the second implementation that ours is compared with.
 */
#ifndef FlipFreeFindWithCGAL_h
#define FlipFreeFindWithCGAL_h

#include "KernelTypes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace FlipFree
{

using PairList = std::vector<std::pair<int, int>>;

/// All pairs, each with the lesser index first, sorted.
inline PairList FindWithCGAL(const PointList& points, const TriangleList& triangles)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    surface.add_vertex(Kernel::Point_3(points(point, 0), points(point, 1), points(point, 2)));
  }
  for (Eigen::Index row = 0; row < triangles.rows(); ++row)
  {
    surface.add_face(Surface::Vertex_index(triangles(row, 0)),
      Surface::Vertex_index(triangles(row, 1)), Surface::Vertex_index(triangles(row, 2)));
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  PairList pairs;
  for (const auto& pair : found)
  {
    const int one = static_cast<int>(pair.first);
    const int two = static_cast<int>(pair.second);
    pairs.emplace_back(std::min(one, two), std::max(one, two));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace FlipFree

#endif

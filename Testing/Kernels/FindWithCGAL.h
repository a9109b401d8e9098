/**
 * Self-intersections as CGAL finds them, for all ways to cut quads into triangles: the second
 * implementation that ours is compared with.
 */
#ifndef FlipFreeFindWithCGAL_h
#define FlipFreeFindWithCGAL_h

#include "KernelTypes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace FlipFree
{

using PairList = std::vector<std::pair<int, int>>;

/// Appends the pairs of faces, of at most four corners, that intersect if the quads for which
/// otherDiagonal(face) holds are cut from their second corner and the others from their first.
inline void AppendWithCGAL(const PointList& points, const FaceList& faces,
  const std::function<bool(int face)>& otherDiagonal, PairList& pairs)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using CutSurface = CGAL::Surface_mesh<Kernel::Point_3>;
  CutSurface surface;
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    surface.add_vertex(Kernel::Point_3(points(point, 0), points(point, 1), points(point, 2)));
  }
  std::vector<int> faceOf;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    const int first = size == 4 && otherDiagonal(face) ? 1 : 0;
    const auto at = [&](int corner)
    { return CutSurface::Vertex_index(faces.Face(face)[(first + corner) % size]); };
    for (int corner = 2; corner < size; ++corner)
    {
      if (surface.add_face(at(0), at(corner - 1), at(corner)) == CutSurface::null_face())
      {
        throw std::invalid_argument("CGAL refuses face " + std::to_string(face));
      }
      faceOf.push_back(face);
    }
  }
  std::vector<std::pair<CutSurface::Face_index, CutSurface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  for (const auto& pair : found)
  {
    pairs.push_back(std::minmax({ faceOf[pair.first], faceOf[pair.second] }));
  }
}

/// All pairs of faces that some cuts make intersect, each with the lesser index first, sorted. For
/// any two faces, each combination of their diagonals is in one of the surfaces that are tested:
/// all cut alike, or by a bit of their index, or by its opposite.
inline PairList FindWithCGAL(const PointList& points, const FaceList& faces)
{
  PairList pairs;
  const auto append = [&](const std::function<bool(int face)>& otherDiagonal)
  { AppendWithCGAL(points, faces, otherDiagonal, pairs); };
  append([](int) { return false; });
  const bool hasQuads =
    faces.Connectivity.size() != 3 * static_cast<std::size_t>(faces.NumberOfFaces());
  if (hasQuads)
  {
    append([](int) { return true; });
  }
  for (int bit = 0; hasQuads && (faces.NumberOfFaces() - 1) >> bit > 0; ++bit)
  {
    for (int value : { 0, 1 })
    {
      append([&](int face) { return (face >> bit & 1) == value; });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

} // namespace FlipFree

#endif

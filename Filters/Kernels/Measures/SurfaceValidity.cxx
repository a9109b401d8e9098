#include "Measures/SurfaceValidity.h"

#include "Geometry/SelfIntersection.h"
#include "Geometry/SurfaceGap.h"

#include <algorithm>
#include <numeric>

namespace FlipFree
{
namespace
{

unsigned char DefectOf(const SurfaceEdge& edge)
{
  const int uses = edge.Forward + edge.Backward;
  return uses == 1                  ? SurfaceValidity::BoundaryEdge
    : uses > 2 || edge.Forward != 1 ? SurfaceValidity::BadEdge
                                    : 0;
}

void MarkEdges(const FaceList& faces, std::vector<SurfaceEdge> edges,
  std::vector<unsigned char>& defects)
{
  // Usually few or none remain.
  edges.erase(std::remove_if(edges.begin(), edges.end(),
                [](const SurfaceEdge& edge) { return DefectOf(edge) == 0; }),
    edges.end());
  if (edges.empty())
  {
    return;
  }
  const auto precedes = [](const SurfaceEdge& edge, const std::pair<int, int>& vertices)
  { return std::make_pair(edge.Lower, edge.Higher) < vertices; };
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const std::pair<int, int> vertices =
        std::minmax({ faces.Face(face)[corner], faces.Face(face)[(corner + 1) % size] });
      const auto edge = std::lower_bound(edges.begin(), edges.end(), vertices, precedes);
      if (edge != edges.end() && edge->Lower == vertices.first && edge->Higher == vertices.second)
      {
        defects[face] |= DefectOf(*edge);
      }
    }
  }
}

int MarkFlippedCorners(const PointList& points, const PointList& reference, const FaceList& faces,
  std::vector<unsigned char>& defects)
{
  const std::vector<int> flipped = CountFlippedCorners(points, reference, faces);
  for (std::size_t face = 0; face < flipped.size(); ++face)
  {
    defects[face] |= flipped[face] > 0 ? SurfaceValidity::FlippedCorner : 0;
  }
  return std::accumulate(flipped.begin(), flipped.end(), 0);
}

int MarkSelfIntersections(const PointList& points, const FaceHulls& hulls,
  const ParallelFor& parallelFor, std::vector<unsigned char>& defects)
{
  const auto pairs = FindSelfIntersections(points, hulls, parallelFor);
  for (const auto& pair : pairs)
  {
    defects[pair.first] |= SurfaceValidity::SelfIntersecting;
    defects[pair.second] |= SurfaceValidity::SelfIntersecting;
  }
  return static_cast<int>(pairs.size());
}

} // namespace

SurfaceValidity MeasureValidity(const PointList& points, const FaceList& faces,
  const PointList* reference, const ParallelFor& parallelFor, const Monitor& monitor)
{
  SurfaceValidity validity;
  validity.Quality = MeasureQuality(points, faces);
  validity.Defects.assign(faces.NumberOfFaces(), 0);
  MarkEdges(faces, CollectEdges(static_cast<int>(points.rows()), faces), validity.Defects);
  if (reference)
  {
    validity.FlippedCorners = MarkFlippedCorners(points, *reference, faces, validity.Defects);
  }
  if (!monitor(0.2))
  {
    return validity;
  }
  const FaceHulls hulls(points, faces);
  validity.SelfIntersections = MarkSelfIntersections(points, hulls, parallelFor, validity.Defects);
  if (!monitor(0.6))
  {
    return validity;
  }
  if (validity.SelfIntersections == 0)
  {
    validity.MinimumGap = MeasureMinimumGap(points, hulls, parallelFor);
  }
  validity.Complete = monitor(1);
  return validity;
}

} // namespace FlipFree

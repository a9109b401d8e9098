/**
 * Refinement that keeps a surface embedded: the refined surface is proven to keep a small gap from
 * itself, however its faces are cut into triangles (FaceHulls.h).
 */
#ifndef FlipFreeSurfaceRefinement_h
#define FlipFreeSurfaceRefinement_h

#include "Guard/EmbeddingGuard.h"

#include <memory>

namespace FlipFree
{

struct RefinedSurface
{
  ContourMesh Mesh;
  PointList Points;
  int Relaxations = 0; ///< guarded smoothing steps that the coarse surface needed first
  bool Embedded = false;
  /// The guard of the refined surface and those at rest, to be used again when they move. Null
  /// unless checked.
  std::unique_ptr<EmbeddingGuard> Guard;
};

/// What the refined surface must not meet.
struct RefinementSurroundings
{
  PointList Obstacles = PointList(0, 3); ///< fixed points, one row each, which stay on their side
  ContourMesh FixedMesh = {};            ///< of surfaces at rest, which are not refined
  PointList FixedPoints = PointList(0, 3);
  /// Per obstacle, the vertices of the old surface that it stops; without ranges, each stops all
  /// (EmbeddingGuard::SetObstacles()).
  std::vector<VertexRange> Ranges = {};
};

/// Refines a surface into one of four times as many vertices (MeshRefinement.h). Where the refined
/// surface would intersect itself, it is pulled toward the old vertices there, and if that does
/// not help, the old surface is smoothed there, in growing neighborhoods if needed, under the
/// guard, which opens its sharpest folds. `checked` false skips all that. Embedded is false when no
/// attempt succeeded or the monitor stopped it; the mesh must then not be used. The
/// surroundings matter only if it is checked.
RefinedSurface RefineSurface(const ContourMesh& mesh, const PointList& points,
  const RefinementSurroundings& surroundings, bool checked, const ParallelFor& parallelFor,
  const Monitor& monitor);

inline RefinedSurface RefineSurface(const ContourMesh& mesh, const PointList& points, bool checked,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  return RefineSurface(mesh, points, RefinementSurroundings(), checked, parallelFor, monitor);
}

} // namespace FlipFree

#endif

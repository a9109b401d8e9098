/**
 * Holds a step of the deformation back where it would make the surface meet itself or a face flip,
 * so that every iterate is embedded when the first one is.
 */
#ifndef FlipFreeEmbeddingGuard_h
#define FlipFreeEmbeddingGuard_h

#include "ContourMesh.h"
#include "TriangleTree.h"

namespace FlipFree
{

struct GuardReport
{
  int HeldBack = 0; ///< vertices whose displacement was scaled down
  int Passes = 0;   ///< times that the motion was tested; 1 when nothing had to be held back
};

class EmbeddingGuard
{
public:
  /// Keeps what depends on the connectivity only.
  explicit EmbeddingGuard(const ContourMesh& mesh);

  /// Scales displacements down, as little as it can, until points + displacements is embedded (no
  /// pair of its triangles intersects) and no corner of a face or triangle has a normal that turned
  /// by 90 degrees or more. Corners without a normal at the start are not judged. `points` must be
  /// embedded: no motion is then always valid, so this ends. Throws std::invalid_argument when they
  /// turn out not to be, or when a number is not finite.
  GuardReport Limit(const PointList& points, PointList& displacements,
    const ParallelFor& parallelFor, const Monitor& monitor) const;

private:
  using Corner = std::array<int, 3>; // before, vertex, after

  // Marks the vertices of all pairs and corners that fail, among those with a vertex that
  // `changed`.
  void FindFailures(const PointList& points, const PointList& moved,
    const std::vector<char>& changed, const ParallelFor& parallelFor,
    std::vector<char>& failed) const;

  // Scales the failed vertices down and their neighbourhood with them; marks what changed. False
  // when there was nothing left to scale down.
  bool ScaleBack(const std::vector<char>& failed, std::vector<double>& scales,
    std::vector<char>& changed) const;

  std::vector<std::array<int, 4>> Neighbours;
  TriangleList Triangles;
  std::vector<Corner> Corners;
  TriangleTree Tree;
};

} // namespace FlipFree

#endif

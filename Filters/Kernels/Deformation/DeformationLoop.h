/**
 * The loop that deforms surfaces from coarse to fine: one, such as an organ's or a vessel's, or
 * several under one guard. The guard and the refinement see one surface, the union, and keep it
 * embedded, so no surface ever meets another, or a fixed one that is in the way. Each follows its
 * own evidence, and rests once its level has ended.
 */
#ifndef FlipFreeDeformationLoop_h
#define FlipFreeDeformationLoop_h

#include "Deformation/DeformingSurface.h"

namespace FlipFree
{

/// Whether none of the closed surfaces, which do not meet, lies within another.
bool NoneIsWithinAnother(const std::vector<const DeformableSurface*>& surfaces);

class DeformationLoop
{
public:
  /// The surfaces have begun (DeformingSurface::BeginAt), apart from each other and from the fixed
  /// surfaces, and none within another. All have the same schedule, and the guard on or
  /// off. Several surfaces, or fixed surfaces, need the guard.
  DeformationLoop(std::vector<DeformingSurface*> surfaces, std::vector<DeformableSurface> fixed,
    const ParallelFor& parallelFor);

  /// Runs all levels, and brings the surfaces to obey their constraints; each then has a reason.
  /// The monitor is asked with the number of levels done, divided by their number. Returns
  /// false if it stopped the run. Throws Error where a constraint cannot be obeyed.
  bool Run(const Monitor& monitor);
  /// The same of the last level alone, for surfaces that have its vertices already: first freely,
  /// then, pulled back from outside points, once more.
  bool RunLastLevel(const Monitor& monitor);
  /// No level: looks for the targets once, and brings the surfaces to obey their constraints. For
  /// surfaces that are at their boundaries, of any closed mesh (BuildMeshAtRest).
  bool Stay(const Monitor& monitor);

private:
  bool HasGuard() const;
  void Unite();
  PointList UniteObstacles(std::vector<VertexRange>& ranges) const;
  PointList PartOf(const PointList& all, std::size_t surface) const;
  bool Refit(const Monitor& proceed);
  bool Refine(const Monitor& proceed);
  bool IterateLevel(int level, const Monitor& monitor);
  void IterateOnce(const Monitor& proceed);
  void MakeGuard();
  bool FinishConstraints(bool isLast, const Monitor& monitor);

  const std::vector<DeformingSurface*> Surfaces;
  const std::vector<DeformableSurface> FixedParts;
  DeformableSurface Fixed; // their union
  const ParallelFor& Parallel;
  const int Levels;

  ContourMesh Mesh;                      // of the surfaces' union, without the fixed surface
  std::vector<VertexRange> Parts;        // of the surfaces
  std::unique_ptr<EmbeddingGuard> Guard; // of the level's surfaces
};

} // namespace FlipFree

#endif

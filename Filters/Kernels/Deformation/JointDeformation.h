/**
 * Deforms the surfaces of one or several organs from coarse to fine, all of them under one guard.
 * The guard and the refinement see one surface, the union, and keep it embedded, so no surface ever
 * meets another, or a fixed one that is in the way. Each organ follows its own evidence, and rests
 * once its level has ended.
 */
#ifndef FlipFreeJointDeformation_h
#define FlipFreeJointDeformation_h

#include "Deformation/DeformingOrgan.h"

namespace FlipFree
{

/// Whether none of the closed surfaces, which do not meet, lies within another.
bool NoneIsWithinAnother(const std::vector<const DeformableSurface*>& surfaces);

class JointDeformation
{
public:
  /// The organs have begun (DeformingOrgan::BeginAt), apart from each other and from the fixed
  /// surfaces, and none within another. All have the same schedule. Several organs, or fixed
  /// surfaces, need the guard.
  JointDeformation(std::vector<DeformingOrgan*> organs, std::vector<DeformableSurface> fixed,
    const ParallelFor& parallelFor);

  /// Runs all levels, and brings the organs to obey their constraints; their surfaces then have a
  /// reason. The monitor is asked with the number of levels done, divided by their number. Returns
  /// false if it stopped the run. Throws Error where a constraint cannot be obeyed.
  bool Run(const Monitor& monitor);
  /// The same of the last level alone, for surfaces that have its vertices already: first freely,
  /// then, pulled back from outside points, once more.
  bool RunLastLevel(const Monitor& monitor);
  /// No level: looks for the targets once, and brings the organs to obey their constraints. For
  /// surfaces that are at their boundaries, of any closed mesh (BuildMeshAtRest).
  bool Stay(const Monitor& monitor);

private:
  bool HasGuard() const;
  void Unite();
  PointList UniteObstacles(std::vector<VertexRange>& ranges) const;
  PointList PartOf(const PointList& all, std::size_t organ) const;
  bool Refit(const Monitor& proceed);
  bool Refine(const Monitor& proceed);
  bool IterateLevel(int level, const Monitor& monitor);
  void IterateOnce(const Monitor& proceed);
  void MakeGuard();
  bool FinishConstraints(bool isLast, const Monitor& monitor);

  const std::vector<DeformingOrgan*> Organs;
  const std::vector<DeformableSurface> FixedParts;
  DeformableSurface Fixed; // their union
  const ParallelFor& Parallel;
  const int Levels;

  ContourMesh Mesh;                      // of the organs' union, without the fixed surface
  std::vector<VertexRange> Parts;        // of the organs
  std::unique_ptr<EmbeddingGuard> Guard; // of the level's surfaces
};

} // namespace FlipFree

#endif

/**
 * What follows the search in each iteration (paper sections 3.4 to 3.6): flip avoidance,
 * propagation of displacements, the Laplacian deformation, and the guard of the embedding.
 */
#ifndef FlipFreeDeformationStep_h
#define FlipFreeDeformationStep_h

#include "Deformation/DisplacementDiffusion.h"
#include "Deformation/LaplacianDeformation.h"
#include "Guard/EmbeddingGuard.h"

namespace FlipFree
{

struct DeformationStepSettings
{
  bool AvoidFlips = true;     ///< off: they are only counted
  double FlipThreshold = 0.3; ///< r of Eq. 3
  DiffusionSettings Propagation;
  DeformationSettings Energy;
};

struct DeformationStepReport
{
  int Flipping = 0; ///< vertices whose targets would have flipped an edge
  int HeldBack = 0; ///< vertices that the guard held back
  double FlipSeconds = 0;
  double SolveSeconds = 0;
  double GuardSeconds = 0;
};

/// Moves the points of the solver's mesh. The field is left with what came of it: its states say
/// which vertices had a target, and which of these would have flipped an edge, whether that was
/// avoided or not; its displacements what was wanted of every vertex after propagation. Without a
/// guard (null) the solved motion is taken as it is. Throws std::invalid_argument when
/// displacements are too long to be computed with.
DeformationStepReport DeformOnce(DeformationSolver& solver, const EmbeddingGuard* guard,
  const DeformationStepSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  CorrespondenceField& field, PointList& points);

} // namespace FlipFree

#endif

/**
 * What follows the search in each iteration (paper sections 3.4 to 3.6): flip avoidance,
 * propagation of displacements, Laplacian deformation, and the guard.
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
  bool Guard = true; ///< read by those who make the guard
};

struct DeformationStepReport
{
  int Flipping = 0; ///< vertices whose targets would have flipped an edge
  int Guarded = 0;  ///< vertices that the guard held back
  DeformationReport Solver;
  double FlipSeconds = 0;
  double SolveSeconds = 0;
  double GuardSeconds = 0;
};

/// The motion that an iteration wants, before the guard. On return, the field is as DeformOnce()
/// leaves it, and the report lacks what is the guard's. Throws as it does.
PointList FindMotion(DeformationSolver& solver, const DeformationStepSettings& settings,
  const PointList& points, CorrespondenceField& field, DeformationStepReport& report);

/// Moves the points of the solver's mesh. On return, the field's states say which vertices had a
/// target and which of these would have flipped an edge, avoided or not; its displacements are
/// those after propagation, which the solver was given. Without a guard (null) the solved motion is
/// applied as it is. Throws Error when the system has no finite solution, or when the guard refuses
/// the surface.
DeformationStepReport DeformOnce(DeformationSolver& solver, EmbeddingGuard* guard,
  const DeformationStepSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  CorrespondenceField& field, PointList& points);

} // namespace FlipFree

#endif

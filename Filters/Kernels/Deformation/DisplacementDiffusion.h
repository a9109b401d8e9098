/**
 * Propagation of displacements to solitary vertices (paper section 3.6) by iterated local
 * averaging, like the diffusion of a gradient vector field.
 */
#ifndef FlipFreeDisplacementDiffusion_h
#define FlipFreeDisplacementDiffusion_h

#include "Deformation/Correspondence.h"

namespace FlipFree
{

struct DiffusionSettings
{
  /// Passes of averaging by which solitary vertices take over their neighbors' displacements.
  int Iterations = 40;

  /// Passes in which the matched vertices are averaged too, which calms the whole field.
  int SmoothingIterations = 1;
};

/// Gives solitary vertices a displacement; those that no displacement reaches stay at rest.
void DiffuseDisplacements(const ContourMesh& mesh, const DiffusionSettings& settings,
  CorrespondenceField& field);

} // namespace FlipFree

#endif

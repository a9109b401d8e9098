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
  /// Averaging passes that carry displacements to solitary vertices.
  int Iterations = 40;

  /// Averaging passes over all vertices, which smooth the whole field.
  int SmoothingIterations = 1;
};

/// Gives solitary vertices a displacement; those that none reaches stay at rest.
void DiffuseDisplacements(const ContourMesh& mesh, const DiffusionSettings& settings,
  CorrespondenceField& field);

} // namespace FlipFree

#endif

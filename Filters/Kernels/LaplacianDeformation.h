/**
 * The deformation step (paper section 3.6, Eq. 4-8): minimises E_L + lambda_p E_p + lambda_u E_u.
 *
 * On a four-valent mesh the three quadratic forms are combinations of one operator, the uniform
 * Laplacian L = I - A / 4, which is symmetric there: E_L gives L^2, E_u gives 4 L (each edge lies
 * on exactly one contour), E_p a diagonal. So the normal equations (L^2 + 4 lambda_u L + lambda_p
 * W) x = b need no matrix at all. They are solved for the step x, in three coordinates at once, by
 * conjugate gradients; a sparse Cholesky factorisation takes over in the case that these do not
 * converge.
 */
#ifndef FlipFreeLaplacianDeformation_h
#define FlipFreeLaplacianDeformation_h

#include "ContourMesh.h"

namespace FlipFree
{

struct DeformationSettings
{
  double PositionWeight = 0.3; ///< lambda_p
  double UniformWeight = 1.0;  ///< lambda_u

  /// How much of the present Laplacian is given up: 0 keeps the shape (Eq. 5), in which case the
  /// energy is inertia and noise never leaves; 1 minimises |L(u')|^2, which smooths and shrinks.
  double Fairing = 0;
};

struct DeformationReport
{
  int Iterations = 0;
  bool Factorised = false; ///< conjugate gradients gave up
};

/// The displacements that minimise the energy when every vertex i is drawn by `targets` (target
/// minus point), weighted by its length over the mean length (Eq. 7). `start` warms up the solver
/// and takes the result.
DeformationReport SolveDeformation(const ContourMesh& mesh, const PointList& points,
  const PointList& targets, const DeformationSettings& settings, PointList& start);

} // namespace FlipFree

#endif

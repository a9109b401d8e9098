/**
 * The linear system of the deformation step (paper section 3.6, Eq. 4-8), which minimizes
 * E_L + lambda_p E_p + lambda_u E_u.
 *
 * On a four-valent mesh the three quadratic forms are combinations of one operator, the uniform
 * Laplacian L = I - A / 4, which is symmetric there: E_L gives L^2, E_u gives 4 L (each edge lies
 * on exactly one contour), E_p a diagonal. So the normal equations are
 * (L^2 + 4 lambda_u L + lambda_p W) x = b, for the step x of every vertex.
 */
#ifndef FlipFreeDeformationSystem_h
#define FlipFreeDeformationSystem_h

#include "Mesh/ContourMesh.h"

#include <Eigen/SparseCore>

namespace FlipFree
{

struct DeformationSettings
{
  double PositionWeight = 0.3; ///< lambda_p
  double UniformWeight = 1.0;  ///< lambda_u

  /// The fraction of the present Laplacian that is given up: 0 keeps the shape and its noise (Eq.
  /// 5); 1 minimizes |L(u')|^2, which smooths and shrinks.
  double Fairing = 0;
};

/// One column per vertex: x, y, z and a zero, which fills the vector registers.
using VertexField = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// The uniform Laplacian of a field.
void ApplyLaplacian(const ContourMesh& mesh, const VertexField& field, VertexField& result);

/// lambda_p W: every vertex's distance to its target, over the mean distance (Eq. 7). All zero if
/// no vertex has a target.
void FindPositionWeights(const PointList& targets, double weight, Eigen::VectorXd& diagonal);

/// b. `targets` are target minus point; `diagonal` is lambda_p W; `work` is overwritten.
void FindRightSide(const ContourMesh& mesh, const PointList& points, const PointList& targets,
  const DeformationSettings& settings, const Eigen::VectorXd& diagonal, VertexField& right,
  VertexField& work);

/// The matrix itself. Its pattern follows from the mesh alone.
Eigen::SparseMatrix<double> AssembleSystem(const ContourMesh& mesh, double uniformWeight,
  const Eigen::VectorXd& diagonal);

} // namespace FlipFree

#endif

/**
 * The deformation step: solves the system of DeformationSystem for the motion of all vertices,
 * three coordinates at once.
 *
 * Conjugate gradients need no matrix, and about as many iterations for any number of vertices. They
 * run in single precision, which halves the data they move through the caches. Where they do not
 * converge, a sparse Cholesky factorization in double precision takes over.
 */
#ifndef FlipFreeLaplacianDeformation_h
#define FlipFreeLaplacianDeformation_h

#include "Deformation/DeformationSystem.h"

#include <memory>

namespace FlipFree
{

struct DeformationReport
{
  int Iterations = 0;
  bool Factorized = false; ///< conjugate gradients did not converge
};

/// The solver for one mesh, which must outlive it. Keeps its memory and the analysis of the
/// matrix's pattern from step to step.
class DeformationSolver
{
public:
  explicit DeformationSolver(const ContourMesh& mesh);
  ~DeformationSolver();

  const ContourMesh& GetMesh() const { return this->Mesh; }

  /// The displacements that minimize the energy, given every vertex's target minus its point.
  /// `start` holds the initial guess and receives the solution. Throws Error (SingularSystem) when
  /// there is no finite solution, as for displacements whose squares overflow.
  DeformationReport Solve(const PointList& points, const PointList& targets,
    const DeformationSettings& settings, PointList& start);

private:
  struct Factorization;

  /// As VertexField.
  using SolverField = Eigen::Matrix4Xf;

  Eigen::Vector4f Apply(SolverField& field, float shift);
  bool IterateToSolution(double uniformWeight, int& iterations);
  bool Factorize(double uniformWeight, PointList& solution); ///< false: there is no solution

  const ContourMesh& Mesh;
  Eigen::VectorXd Diagonal; ///< lambda_p W
  VertexField Right;
  VertexField Work;
  Eigen::VectorXf Weights; ///< the diagonal
  Eigen::VectorXf Preconditioner;
  SolverField Solution;
  SolverField Residual;
  SolverField Direction;
  SolverField Inner;
  SolverField Image;
  std::unique_ptr<Factorization> Factor; ///< made when first needed
};

} // namespace FlipFree

#endif

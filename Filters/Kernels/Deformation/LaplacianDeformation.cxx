#include "Deformation/LaplacianDeformation.h"

#include "Error.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <sstream>

namespace FlipFree
{
namespace
{

// What single precision can reach, and far less than a step leaves to the next one anyway.
constexpr double RelativeTolerance = 1e-5;
constexpr int MaximumIterations = 400;

} // namespace

struct DeformationSolver::Factorization
{
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Cholesky;
};

DeformationSolver::DeformationSolver(const ContourMesh& mesh)
  : Mesh(mesh)
{
  const int size = mesh.NumberOfPoints();
  for (VertexField* field : { &this->Right, &this->Work })
  {
    field->setZero(4, size);
  }
  for (SolverField* field :
    { &this->Solution, &this->Residual, &this->Direction, &this->Inner, &this->Image })
  {
    field->setZero(4, size);
  }
}

DeformationSolver::~DeformationSolver() = default;

// The matrix times x, into Image, by way of Inner = (L + 4 lambda_u) x. Returns the sums of x
// Image.
Eigen::Vector4f DeformationSolver::Apply(const SolverField& x, float shift)
{
  const auto add = [this](const SolverField& field, int vertex) -> Eigen::Vector4f
  {
    const auto& ring = this->Mesh.Neighbors[vertex];
    return (field.col(ring[0]) + field.col(ring[1])) + (field.col(ring[2]) + field.col(ring[3]));
  };
  const int size = this->Mesh.NumberOfPoints();
  for (int vertex = 0; vertex < size; ++vertex)
  {
    this->Inner.col(vertex) = (1 + shift) * x.col(vertex) - 0.25F * add(x, vertex);
  }
  Eigen::Vector4f curvature = Eigen::Vector4f::Zero();
  for (int vertex = 0; vertex < size; ++vertex)
  {
    const Eigen::Vector4f image = this->Inner.col(vertex) - 0.25F * add(this->Inner, vertex) +
      this->Weights[vertex] * x.col(vertex);
    this->Image.col(vertex) = image;
    curvature += image.cwiseProduct(x.col(vertex));
  }
  return curvature;
}

// Preconditioned conjugate gradients. Each pass does all that can be done at a vertex, since the
// fields together do not fit into the first-level cache.
bool DeformationSolver::IterateToSolution(double uniformWeight, int& iterations)
{
  const int size = this->Mesh.NumberOfPoints();
  const auto shift = static_cast<float>(4 * uniformWeight);
  this->Weights = this->Diagonal.cast<float>();
  this->Preconditioner = (this->Weights.array() + (1.25F + shift)).inverse();

  // One goal for all coordinates: a goal of its own would be zero for a coordinate without forces.
  const auto goal =
    static_cast<float>(RelativeTolerance * RelativeTolerance * this->Right.squaredNorm() / 3);
  if (!std::isfinite(goal))
  {
    return false; // too great for single precision
  }
  this->Apply(this->Solution, shift);
  Eigen::Vector4f energy = Eigen::Vector4f::Zero();
  Eigen::Vector4f error = Eigen::Vector4f::Zero();
  for (int vertex = 0; vertex < size; ++vertex)
  {
    this->Residual.col(vertex) = this->Right.col(vertex).cast<float>() - this->Image.col(vertex);
    this->Direction.col(vertex) = this->Preconditioner[vertex] * this->Residual.col(vertex);
    error += this->Residual.col(vertex).cwiseAbs2();
    energy += this->Residual.col(vertex).cwiseProduct(this->Direction.col(vertex));
  }
  for (iterations = 0; iterations < MaximumIterations; ++iterations)
  {
    if ((error.array() <= goal).all())
    {
      return true;
    }
    const Eigen::Vector4f curvature = this->Apply(this->Direction, shift);
    // A coordinate that has converged must not divide by zero while the others continue.
    const Eigen::Vector4f step =
      (curvature.array() > 0).select(energy.array() / curvature.array(), 0.0F);
    Eigen::Vector4f next = Eigen::Vector4f::Zero();
    error.setZero();
    for (int vertex = 0; vertex < size; ++vertex)
    {
      // Named, since what is stored and read again waits for the memory.
      const Eigen::Vector4f residual =
        this->Residual.col(vertex) - step.cwiseProduct(this->Image.col(vertex));
      const Eigen::Vector4f preconditioned = this->Preconditioner[vertex] * residual;
      this->Solution.col(vertex) += step.cwiseProduct(this->Direction.col(vertex));
      this->Residual.col(vertex) = residual;
      this->Image.col(vertex) = preconditioned; // the product is no longer needed
      error += residual.cwiseAbs2();
      next += residual.cwiseProduct(preconditioned);
    }
    const Eigen::Vector4f turn = (energy.array() > 0).select(next.array() / energy.array(), 0.0F);
    for (int vertex = 0; vertex < size; ++vertex)
    {
      this->Direction.col(vertex) =
        this->Image.col(vertex) + turn.cwiseProduct(this->Direction.col(vertex));
    }
    energy = next;
  }
  return false;
}

bool DeformationSolver::Factorize(double uniformWeight, PointList& solution)
{
  const Eigen::SparseMatrix<double> matrix =
    AssembleSystem(this->Mesh, uniformWeight, this->Diagonal);
  if (!this->Factor)
  {
    this->Factor = std::make_unique<Factorization>();
    this->Factor->Cholesky.analyzePattern(matrix);
  }
  this->Factor->Cholesky.factorize(matrix);
  if (this->Factor->Cholesky.info() != Eigen::Success)
  {
    return false;
  }
  solution = this->Factor->Cholesky.solve(PointList(this->Right.topRows<3>().transpose()));
  return this->Factor->Cholesky.info() == Eigen::Success && solution.allFinite();
}

DeformationReport DeformationSolver::Solve(const PointList& points, const PointList& targets,
  const DeformationSettings& settings, PointList& start)
{
  FindPositionWeights(targets, settings.PositionWeight, this->Diagonal);
  FindRightSide(this->Mesh, points, targets, settings, this->Diagonal, this->Right, this->Work);
  this->Solution.topRows<3>() = start.transpose().cast<float>();
  this->Solution.row(3).setZero(); // an earlier call that failed may have left NaN

  DeformationReport report;
  if (this->IterateToSolution(settings.UniformWeight, report.Iterations) &&
    this->Solution.allFinite())
  {
    start = this->Solution.topRows<3>().transpose().cast<double>();
    return report;
  }
  report.Factorized = true;
  if (!this->Factorize(settings.UniformWeight, start))
  {
    std::ostringstream message;
    message << "the system of the deformation has no finite solution for displacements of up to "
            << targets.cwiseAbs().maxCoeff()
            << " mm; limit them (MaximumDisplacement), or check the surface";
    throw Error(ErrorCode::SingularSystem, message.str());
  }
  return report;
}

} // namespace FlipFree

#include "Deformation/LaplacianDeformation.h"

#include "Error.h"

#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace FlipFree
{
namespace
{

// Attainable in single precision, and far below what a step leaves to the next one anyway.
constexpr double RelativeTolerance = 1e-5;
constexpr int MaximumIterations = 400;

// Local copy of the pointer, so it need not be reloaded after each store.
class Columns
{
public:
  using Column = Eigen::Map<Eigen::Vector4f, Eigen::Aligned16>;

  explicit Columns(Eigen::Matrix4Xf& field)
    : Data(field.data())
  {
  }
  Column operator[](std::ptrdiff_t vertex) const { return Column(this->Data + 4 * vertex); }
  Eigen::Vector4f SumOf(const std::array<int, 4>& ring) const
  {
    return ((*this)[ring[0]] + (*this)[ring[1]]) + ((*this)[ring[2]] + (*this)[ring[3]]);
  }

private:
  float* Data;
};

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

// The matrix times the field, into Image, by way of Inner = (L + 4 lambda_u) times the field.
// Returns the sums of the field times Image.
Eigen::Vector4f DeformationSolver::Apply(SolverField& field, float shift)
{
  const std::array<int, 4>* const rings = this->Mesh.Neighbors.data();
  const float* const weights = this->Weights.data();
  const Columns x(field);
  const Columns inner(this->Inner);
  const Columns image(this->Image);
  const int size = this->Mesh.NumberOfPoints();
  for (int vertex = 0; vertex < size; ++vertex)
  {
    inner[vertex] = (1 + shift) * x[vertex] - 0.25F * x.SumOf(rings[vertex]);
  }
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  for (int vertex = 0; vertex < size; ++vertex)
  {
    const Eigen::Vector4f product =
      inner[vertex] - 0.25F * inner.SumOf(rings[vertex]) + weights[vertex] * x[vertex];
    image[vertex] = product;
    sum += product.cwiseProduct(x[vertex]);
  }
  return Eigen::Vector4f(sum); // a copy, so that the sum itself can stay in a register
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
  const float* const preconditioner = this->Preconditioner.data();
  const Columns solutions(this->Solution);
  const Columns residuals(this->Residual);
  const Columns directions(this->Direction);
  const Columns images(this->Image);
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
      const Eigen::Vector4f residual = residuals[vertex] - step.cwiseProduct(images[vertex]);
      const Eigen::Vector4f preconditioned = preconditioner[vertex] * residual;
      solutions[vertex] += step.cwiseProduct(directions[vertex]);
      residuals[vertex] = residual;
      images[vertex] = preconditioned; // the product is no longer needed
      error += residual.cwiseAbs2();
      next += residual.cwiseProduct(preconditioned);
    }
    const Eigen::Vector4f turn = (energy.array() > 0).select(next.array() / energy.array(), 0.0F);
    for (int vertex = 0; vertex < size; ++vertex)
    {
      directions[vertex] = images[vertex] + turn.cwiseProduct(directions[vertex]);
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
            << " mm; limit them ({MaximumDisplacement}), or check the surface";
    throw Error(ErrorCode::SingularSystem, message.str());
  }
  return report;
}

} // namespace FlipFree

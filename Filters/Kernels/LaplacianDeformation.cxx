#include "LaplacianDeformation.h"

#include <Eigen/SparseCholesky>

#include <vector>

namespace FlipFree
{
namespace
{

constexpr double RelativeTolerance = 1e-6;
constexpr int MaximumIterations = 400;

PointList Laplacian(const ContourMesh& mesh, const PointList& field)
{
  PointList result(field.rows(), 3);
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    const auto& ring = mesh.Neighbours[vertex];
    result.row(vertex) = field.row(vertex) -
      0.25 * (field.row(ring[0]) + field.row(ring[1]) + field.row(ring[2]) + field.row(ring[3]));
  }
  return result;
}

// Eq. 7's d_i / mean(d). With all distances zero nothing draws; the step is then left to E_L and
// E_u.
Eigen::VectorXd PositionWeights(const PointList& targets)
{
  Eigen::VectorXd distances = targets.rowwise().norm();
  const double mean = distances.mean();
  if (mean > 0)
  {
    distances /= mean;
  }
  return distances;
}

// b of E_u: edges want the mean length of their contour along their present direction.
void AddUniformTerm(const ContourMesh& mesh, const PointList& points, double weight,
  PointList& right)
{
  std::vector<double> lengths;
  for (const auto& contour : mesh.Contours)
  {
    const std::size_t size = contour.size();
    lengths.resize(size);
    double mean = 0;
    for (std::size_t position = 0; position < size; ++position)
    {
      const int i = contour[position];
      const int j = contour[(position + 1) % size];
      lengths[position] = (points.row(i) - points.row(j)).norm();
      mean += lengths[position];
    }
    mean /= static_cast<double>(size);
    for (std::size_t position = 0; position < size; ++position)
    {
      if (lengths[position] > 0)
      {
        const int i = contour[position];
        const int j = contour[(position + 1) % size];
        const Eigen::RowVector3d pull =
          weight * (mean / lengths[position] - 1) * (points.row(i) - points.row(j));
        right.row(i) += pull;
        right.row(j) -= pull;
      }
    }
  }
}

struct NormalEquations
{
  const ContourMesh& Mesh;
  double Uniform;
  Eigen::VectorXd Diagonal; ///< lambda_p W

  PointList operator()(const PointList& x) const
  {
    const PointList inner = Laplacian(this->Mesh, x) + 4 * this->Uniform * x;
    return Laplacian(this->Mesh, inner) + this->Diagonal.asDiagonal() * x;
  }

  Eigen::SparseMatrix<double> Assemble() const
  {
    const int size = this->Mesh.NumberOfPoints();
    std::vector<Eigen::Triplet<double>> entries;
    for (int vertex = 0; vertex < size; ++vertex)
    {
      entries.emplace_back(vertex, vertex, 1.0);
      for (int neighbour : this->Mesh.Neighbours[vertex])
      {
        entries.emplace_back(vertex, neighbour, -0.25);
      }
    }
    Eigen::SparseMatrix<double> laplacian(size, size);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseMatrix<double> matrix = laplacian * laplacian + 4 * this->Uniform * laplacian;
    // A mesh that nothing holds has a one-dimensional kernel, its translation.
    matrix.diagonal() += this->Diagonal + Eigen::VectorXd::Constant(size, 1e-9);
    return matrix;
  }
};

bool ConjugateGradients(const NormalEquations& equations, const PointList& right, PointList& x,
  int& iterations)
{
  const Eigen::VectorXd preconditioner =
    (equations.Diagonal.array() + 1.25 + 4 * equations.Uniform).inverse();
  // One goal for the three: a coordinate without any force could never meet one of its own.
  const double goal = RelativeTolerance * RelativeTolerance * right.squaredNorm() / 3;
  PointList residual = right - equations(x);
  PointList scaled = preconditioner.asDiagonal() * residual;
  PointList direction = scaled;
  Eigen::RowVector3d energy = residual.cwiseProduct(scaled).colwise().sum();
  for (iterations = 0; iterations < MaximumIterations; ++iterations)
  {
    const Eigen::RowVector3d error = residual.colwise().squaredNorm();
    if ((error.array() <= goal).all())
    {
      return true;
    }
    const PointList image = equations(direction);
    const Eigen::RowVector3d curvature = direction.cwiseProduct(image).colwise().sum();
    // A coordinate that has arrived must not divide by zero while the others go on.
    const Eigen::RowVector3d step =
      (curvature.array() > 0).select(energy.array() / curvature.array(), 0.0);
    x += direction * step.asDiagonal();
    residual -= image * step.asDiagonal();
    scaled = preconditioner.asDiagonal() * residual;
    const Eigen::RowVector3d next = residual.cwiseProduct(scaled).colwise().sum();
    const Eigen::RowVector3d turn = (energy.array() > 0).select(next.array() / energy.array(), 0.0);
    direction = scaled + direction * turn.asDiagonal();
    energy = next;
  }
  return false;
}

} // namespace

DeformationReport SolveDeformation(const ContourMesh& mesh, const PointList& points,
  const PointList& targets, const DeformationSettings& settings, PointList& start)
{
  const NormalEquations equations{ mesh, settings.UniformWeight,
    settings.PositionWeight * PositionWeights(targets) };
  PointList right = equations.Diagonal.asDiagonal() * targets;
  AddUniformTerm(mesh, points, settings.UniformWeight, right);
  if (settings.Fairing > 0)
  {
    right -= settings.Fairing * Laplacian(mesh, Laplacian(mesh, points));
  }

  DeformationReport report;
  const PointList warm = start;
  if (!ConjugateGradients(equations, right, start, report.Iterations) || !start.allFinite())
  {
    report.Factorised = true;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(equations.Assemble());
    start = factor.info() == Eigen::Success ? PointList(factor.solve(right)) : warm;
  }
  return report;
}

} // namespace FlipFree

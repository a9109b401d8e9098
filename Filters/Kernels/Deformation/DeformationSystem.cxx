#include "Deformation/DeformationSystem.h"

#include <vector>

namespace FlipFree
{
namespace
{

// Pulls each edge toward the mean length of its contour, along its present direction.
void AddUniformTerm(const ContourMesh& mesh, const PointList& points, double weight,
  VertexField& right)
{
  for (const auto& contour : mesh.Contours)
  {
    // Calls visit(i, j, edge from j to i) along the contour.
    const auto walk = [&](const auto& visit)
    {
      int i = contour.back();
      for (int j : contour)
      {
        visit(i, j, Eigen::Vector3d(points.row(i) - points.row(j)));
        i = j;
      }
    };
    double mean = 0;
    walk([&mean](int, int, const Eigen::Vector3d& edge) { mean += edge.norm(); });
    mean /= static_cast<double>(contour.size());
    walk(
      [&](int i, int j, const Eigen::Vector3d& edge)
      {
        const double length = edge.norm();
        if (length > 0)
        {
          const Eigen::Vector3d pull = weight * (mean / length - 1) * edge;
          right.col(i).head<3>() += pull;
          right.col(j).head<3>() -= pull;
        }
      });
  }
}

} // namespace

void ApplyLaplacian(const ContourMesh& mesh, const VertexField& field, VertexField& result)
{
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    const auto& ring = mesh.Neighbors[vertex];
    result.col(vertex) = field.col(vertex) -
      0.25 * (field.col(ring[0]) + field.col(ring[1]) + field.col(ring[2]) + field.col(ring[3]));
  }
}

void FindPositionWeights(const PointList& targets, double weight, Eigen::VectorXd& diagonal)
{
  diagonal = targets.rowwise().norm();
  const double mean = diagonal.mean();
  diagonal *= mean > 0 ? weight / mean : weight;
}

void FindRightSide(const ContourMesh& mesh, const PointList& points, const PointList& targets,
  const DeformationSettings& settings, const Eigen::VectorXd& diagonal, VertexField& right,
  VertexField& work)
{
  if (settings.Fairing > 0)
  {
    right.topRows<3>() = points.transpose();
    right.row(3).setZero();
    ApplyLaplacian(mesh, right, work);
    ApplyLaplacian(mesh, work, right);
    right *= -settings.Fairing;
  }
  else
  {
    right.setZero();
  }
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    right.col(vertex).head<3>() += diagonal[vertex] * targets.row(vertex).transpose();
  }
  AddUniformTerm(mesh, points, settings.UniformWeight, right);
}

Eigen::SparseMatrix<double> AssembleSystem(const ContourMesh& mesh, double uniformWeight,
  const Eigen::VectorXd& diagonal)
{
  const int size = mesh.NumberOfPoints();
  std::vector<Eigen::Triplet<double>> entries;
  for (int vertex = 0; vertex < size; ++vertex)
  {
    entries.emplace_back(vertex, vertex, 1.0);
    for (int neighbor : mesh.Neighbors[vertex])
    {
      entries.emplace_back(vertex, neighbor, -0.25);
    }
  }
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> matrix = laplacian * laplacian + 4 * uniformWeight * laplacian;
  // Without position weights the matrix has a kernel: the translations.
  matrix.diagonal() += diagonal + Eigen::VectorXd::Constant(size, 1e-9);
  return matrix;
}

} // namespace FlipFree

#include "TargetSearch.h"

#include "SurfaceNormals.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Fewer neighbours say nothing about what is usual.
constexpr std::size_t LeastRing = 4;

double TakeMedian(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TargetReport Describe(const CorrespondenceField& field)
{
  TargetReport report;
  for (std::size_t vertex = 0; vertex < field.States.size(); ++vertex)
  {
    if (field.States[vertex] == VertexState::Solitary)
    {
      ++report.Solitary;
    }
    else
    {
      ++report.Matched;
      report.MeanDistance += field.Displacements.row(static_cast<Eigen::Index>(vertex)).norm();
    }
  }
  report.MeanDistance /= std::max(1, report.Matched);
  return report;
}

} // namespace

void RejectOutliers(const ContourMesh& mesh, const PointList& normals, double deviations,
  double allowance, CorrespondenceField& field)
{
  const Eigen::VectorXd distances = field.Displacements.cwiseProduct(normals).rowwise().sum();
  const std::vector<VertexState> states = field.States;
  std::vector<double> ring;
  const auto add = [&](int vertex)
  {
    if (states[vertex] != VertexState::Solitary)
    {
      ring.push_back(distances[vertex]);
    }
  };
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    if (states[vertex] == VertexState::Solitary)
    {
      continue;
    }
    ring.clear();
    for (int neighbour : mesh.Neighbours[vertex])
    {
      add(neighbour);
      for (int next : mesh.Neighbours[neighbour])
      {
        if (next != vertex)
        {
          add(next);
        }
      }
    }
    if (ring.size() < LeastRing)
    {
      continue;
    }
    const double median = TakeMedian(ring);
    for (double& distance : ring)
    {
      distance = std::abs(distance - median);
    }
    const double spread = 1.4826 * TakeMedian(ring);
    if (std::abs(distances[vertex] - median) > deviations * spread + allowance)
    {
      field.States[vertex] = VertexState::Solitary;
      field.Displacements.row(vertex).setZero();
    }
  }
}

void LimitDisplacements(double limit, CorrespondenceField& field)
{
  for (Eigen::Index vertex = 0; vertex < field.Displacements.rows(); ++vertex)
  {
    const double length = field.Displacements.row(vertex).norm();
    if (length > limit)
    {
      field.Displacements.row(vertex) *= limit / length;
    }
  }
}

CorrespondenceField FindTargets(const ContourMesh& mesh, const PointList& points,
  const BitMask& foreground, const ImageView<float>& edges, const TargetSettings& settings,
  const ParallelFor& parallelFor, TargetReport& report)
{
  const PointList normals = VertexNormals(mesh, points, settings.NormalSmoothing);
  CorrespondenceField field =
    FindCorrespondences(points, normals, foreground, edges, settings.Correspondence, parallelFor);
  if (settings.OutlierDeviations > 0)
  {
    const double voxel = foreground.GetGeometry().Spacing.maxCoeff();
    RejectOutliers(mesh, normals, settings.OutlierDeviations, voxel, field);
  }
  report = Describe(field);
  if (settings.MaximumDisplacement > 0)
  {
    LimitDisplacements(settings.MaximumDisplacement, field);
  }
  return field;
}

} // namespace FlipFree

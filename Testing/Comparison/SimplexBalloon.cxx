#include "SimplexBalloon.h"

#include <cmath>

namespace FlipFree
{
namespace
{

Eigen::Vector3d ToEigen(const itk::SimplexMeshGeometry::PointType& point)
{
  return { point[0], point[1], point[2] };
}

} // namespace

void SimplexBalloon::SetStart(const SimplexMesh& mesh)
{
  this->Start = mesh;
  auto input = ItkSimplexMesh::New();
  for (Eigen::Index vertex = 0; vertex < mesh.Points.rows(); ++vertex)
  {
    ItkSimplexMesh::PointType point;
    // The mesh deletes it.
    auto* data = new itk::SimplexMeshGeometry; // NOLINT(cppcoreguidelines-owning-memory)
    for (int i = 0; i < 3; ++i)
    {
      point[i] = mesh.Points(vertex, i);
      data->neighborIndices[i] =
        static_cast<itk::IdentifierType>(mesh.Neighbors[static_cast<std::size_t>(vertex)][i]);
      data->referenceMetrics[i] = 1.0 / 3;
    }
    input->SetPoint(static_cast<itk::IdentifierType>(vertex), point);
    input->SetGeometryData(static_cast<itk::IdentifierType>(vertex), data);
  }
  this->SetInput(input);

  // Required, but unused.
  auto gradient = GradientImageType::New();
  gradient->SetRegions(GradientImageType::SizeType::Filled(1));
  gradient->Allocate();
  this->SetGradient(gradient);
}

void SimplexBalloon::ComputeGeometry()
{
  Superclass::ComputeGeometry();
  for (auto vertex = this->m_Data->Begin(); vertex != this->m_Data->End(); ++vertex)
  {
    // Where neighbors lie on a line, or by rounding the sine exceeds one.
    itk::SimplexMeshGeometry* data = vertex.Value();
    data->phi = std::isfinite(data->phi) ? data->phi : 0;
    data->meanCurvature = std::isfinite(data->meanCurvature) ? data->meanCurvature : 0;
  }
}

void SimplexBalloon::ComputeInternalForce(itk::SimplexMeshGeometry* data)
{
  double reference = 0;
  for (const itk::IdentifierType neighbor : *data->neighborSet)
  {
    reference += this->m_Data->GetElement(neighbor)->phi;
  }
  reference /= static_cast<double>(data->neighborSet->size());
  double present = 0;
  double wanted = 0;
  data->internalForce.Fill(0);
  if (this->L_Func(data->circleRadius, data->distance, data->phi, present) &&
    this->L_Func(data->circleRadius, data->distance, reference, wanted))
  {
    itk::SimplexMeshGeometry::VectorType force;
    for (int i = 0; i < 3; ++i)
    {
      force[i] = (present - wanted) * data->normal[i];
      for (int neighbor = 0; neighbor < 3; ++neighbor)
      {
        force[i] +=
          (data->referenceMetrics[neighbor] - data->eps[neighbor]) * data->neighbors[neighbor][i];
      }
    }
    if (std::isfinite(force.GetSquaredNorm()))
    {
      data->internalForce = force;
    }
  }
}

void SimplexBalloon::ComputeExternalForce(itk::SimplexMeshGeometry* data, const GradientImageType*)
{
  const double step = this->Outward(ToEigen(data->pos));
  for (int i = 0; i < 3; ++i)
  {
    data->externalForce[i] = std::isfinite(data->normal[i]) ? step * data->normal[i] : 0;
  }
}

void SimplexBalloon::ComputeDisplacement()
{
  constexpr int interval = 25;
  if (this->GetAbortGenerateData())
  {
    throw itk::ProcessAborted(__FILE__, __LINE__);
  }
  Superclass::ComputeDisplacement();
  if (++this->Elapsed % interval == 0)
  {
    const double volume = this->Volume();
    if (std::abs(volume - this->LastVolume) < this->VolumeTolerance * volume)
    {
      this->m_Step = this->m_Iterations; // the last iteration
    }
    this->LastVolume = volume;
  }
}

PointList SimplexBalloon::Vertices() const
{
  PointList points(this->Start.Points.rows(), 3);
  for (auto vertex = this->m_Data->Begin(); vertex != this->m_Data->End(); ++vertex)
  {
    points.row(static_cast<Eigen::Index>(vertex.Index())) = ToEigen(vertex.Value()->pos);
  }
  return points;
}

PointList SimplexBalloon::GetSurfacePoints() const
{
  return SurfacePoints(this->Start, this->Vertices());
}

double SimplexBalloon::Volume() const
{
  const PointList points = this->GetSurfacePoints();
  double volume = 0;
  for (Eigen::Index i = 0; i < this->Start.Triangles.rows(); ++i)
  {
    const Eigen::Vector3d a = points.row(this->Start.Triangles(i, 0));
    const Eigen::Vector3d b = points.row(this->Start.Triangles(i, 1));
    const Eigen::Vector3d c = points.row(this->Start.Triangles(i, 2));
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

} // namespace FlipFree

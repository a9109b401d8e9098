#include "Mesh/SurfaceNormals.h"

namespace FlipFree
{
namespace
{

void NormalizeRows(PointList& vectors)
{
  for (Eigen::Index row = 0; row < vectors.rows(); ++row)
  {
    const double length = vectors.row(row).norm();
    if (length > 0)
    {
      vectors.row(row) /= length;
    }
  }
}

PointList AddNeighbors(const ContourMesh& mesh, const PointList& field)
{
  PointList sum = field;
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    for (int neighbor : mesh.Neighbors[vertex])
    {
      sum.row(vertex) += field.row(neighbor);
    }
  }
  return sum;
}

} // namespace

PointList VertexNormals(const ContourMesh& mesh, const Eigen::Ref<const PointList>& points,
  int smoothing)
{
  PointList normals = PointList::Zero(points.rows(), 3);
  for (Eigen::Index triangle = 0; triangle < mesh.Triangles.rows(); ++triangle)
  {
    const auto corners = mesh.Triangles.row(triangle);
    const Eigen::RowVector3d a = points.row(corners[0]);
    const Eigen::RowVector3d b = points.row(corners[1]);
    const Eigen::RowVector3d c = points.row(corners[2]);
    const Eigen::RowVector3d areaNormal = (b - a).cross(c - a);
    for (int corner = 0; corner < 3; ++corner)
    {
      normals.row(corners[corner]) += areaNormal;
    }
  }
  NormalizeRows(normals);
  for (int pass = 0; pass < smoothing; ++pass)
  {
    normals = AddNeighbors(mesh, normals);
    NormalizeRows(normals);
  }
  if ((normals.rowwise().squaredNorm().array() == 0).any())
  {
    const PointList sum = AddNeighbors(mesh, normals);
    for (Eigen::Index vertex = 0; vertex < normals.rows(); ++vertex)
    {
      if (normals.row(vertex).isZero(0))
      {
        const double length = sum.row(vertex).norm();
        normals.row(vertex) =
          length > 0 ? Eigen::RowVector3d(sum.row(vertex) / length) : Eigen::RowVector3d(0, 0, 1);
      }
    }
  }
  return normals;
}

} // namespace FlipFree

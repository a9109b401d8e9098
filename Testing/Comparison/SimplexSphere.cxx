#include "SimplexSphere.h"

#include "Mesh/ContourMesh.h"
#include "Mesh/QuadSphere.h"

#include <map>
#include <utility>

namespace FlipFree
{

SimplexMesh MakeSimplexSphere(int n, const Eigen::Vector3d& center, double radius)
{
  const QuadSphere sphere = MakeQuadSphere(n, center, radius, QuadSphereSpacing::Equiangular);
  const TriangleList triangles = Triangulate(sphere.Faces);
  const auto size = static_cast<int>(triangles.rows());
  SimplexMesh mesh;
  mesh.Faces = static_cast<int>(sphere.Points.rows());
  mesh.Points.resize(size, 3);
  std::map<std::pair<int, int>, int> triangleOfEdge; // by the order in which it passes its ends
  for (int triangle = 0; triangle < size; ++triangle)
  {
    const auto corners = triangles.row(triangle);
    const Eigen::Vector3d middle = (sphere.Points.row(corners[0]) + sphere.Points.row(corners[1]) +
                                     sphere.Points.row(corners[2]))
                                     .transpose() /
      3;
    mesh.Points.row(triangle) = center + radius * (middle - center).normalized();
    for (int corner = 0; corner < 3; ++corner)
    {
      triangleOfEdge[{ corners[corner], corners[(corner + 1) % 3] }] = triangle;
    }
  }
  mesh.Neighbors.resize(size);
  mesh.Triangles.resize(3 * size, 3);
  for (int triangle = 0; triangle < size; ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int from = triangles(triangle, corner);
      const int to = triangles(triangle, (corner + 1) % 3);
      const int neighbor = triangleOfEdge.at({ to, from });
      mesh.Neighbors[triangle][corner] = neighbor;
      mesh.Triangles.row(3 * triangle + corner) << size + from, neighbor, triangle;
    }
  }
  return mesh;
}

PointList SurfacePoints(const SimplexMesh& mesh, const PointList& vertices)
{
  const auto size = static_cast<int>(vertices.rows());
  PointList points = PointList::Zero(size + mesh.Faces, 3);
  points.topRows(size) = vertices;
  Eigen::VectorXd corners = Eigen::VectorXd::Zero(mesh.Faces);
  for (Eigen::Index i = 0; i < mesh.Triangles.rows(); ++i)
  {
    // A face has as many triangles as corners, and each is the last of one.
    points.row(mesh.Triangles(i, 0)) += vertices.row(mesh.Triangles(i, 2));
    ++corners[mesh.Triangles(i, 0) - size];
  }
  points.bottomRows(mesh.Faces).array().colwise() /= corners.array();
  return points;
}

} // namespace FlipFree

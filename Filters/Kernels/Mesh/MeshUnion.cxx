#include "Mesh/MeshUnion.h"

#include <utility>

namespace FlipFree
{

void AppendMesh(const ContourMesh& part, ContourMesh& mesh)
{
  const int firstPoint = mesh.NumberOfPoints();
  const int firstCorner = static_cast<int>(mesh.Faces.Connectivity.size());
  const Eigen::Index firstTriangle = mesh.Triangles.rows();
  mesh.Neighbors.reserve(mesh.Neighbors.size() + part.Neighbors.size());
  for (std::array<int, 4> ring : part.Neighbors)
  {
    for (int& neighbor : ring)
    {
      neighbor += firstPoint;
    }
    mesh.Neighbors.push_back(ring);
  }
  for (std::vector<int> contour : part.Contours)
  {
    for (int& vertex : contour)
    {
      vertex += firstPoint;
    }
    mesh.Contours.push_back(std::move(contour));
  }
  for (const int vertex : part.Faces.Connectivity)
  {
    mesh.Faces.Connectivity.push_back(firstPoint + vertex);
  }
  for (auto offset = part.Faces.Offsets.begin() + 1; offset != part.Faces.Offsets.end(); ++offset)
  {
    mesh.Faces.Offsets.push_back(firstCorner + *offset);
  }
  mesh.Triangles.conservativeResize(firstTriangle + part.Triangles.rows(), 3);
  mesh.Triangles.bottomRows(part.Triangles.rows()) = part.Triangles.array() + firstPoint;
}

void AppendPoints(const PointList& part, PointList& points)
{
  points.conservativeResize(points.rows() + part.rows(), 3);
  points.bottomRows(part.rows()) = part;
}

} // namespace FlipFree

#include "Mesh/MeshRefinement.h"

#include <cmath>

namespace FlipFree
{
namespace
{

// The corners at each vertex, as indices into the connectivity list.
struct CornerLinks
{
  explicit CornerLinks(const ContourMesh& mesh)
    : CornerAt(mesh.NumberOfPoints())
  {
    for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
    {
      const int size = mesh.Faces.FaceSize(face);
      for (int corner = 0; corner < size; ++corner)
      {
        const int vertex = mesh.Faces.Face(face)[corner];
        const int next = mesh.Faces.Face(face)[(corner + 1) % size];
        for (int slot = 0; slot < 4; ++slot)
        {
          if (mesh.Neighbors[vertex][slot] == next)
          {
            this->CornerAt[vertex][slot] = mesh.Faces.Offsets[face] + corner;
          }
        }
      }
    }
  }

  // Per vertex and neighbor slot: the corner of the face to the left of the edge to that
  // neighbor.
  std::vector<std::array<int, 4>> CornerAt;
};

// From a corner of a face to its Doo-Sabin point.
Eigen::RowVector3d TowardsDooSabin(const PointList& points, const int* vertices, int size,
  int corner)
{
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();
  for (int other = 0; other < size; ++other)
  {
    const double angle = 2 * EIGEN_PI * (other - corner) / size;
    const double weight =
      other == corner ? (size + 5.0) / (4.0 * size) : (3 + 2 * std::cos(angle)) / (4.0 * size);
    offset += weight * points.row(vertices[other]);
  }
  return offset - points.row(vertices[corner]);
}

// From a corner of a face to a point at about the same distance in one of the face's triangles,
// which share its first vertex.
Eigen::RowVector3d TowardsTriangles(const PointList& points, const int* vertices, int size,
  int corner)
{
  const Eigen::RowVector3d parent = points.row(vertices[corner]);
  const auto toward = [&](int other) -> Eigen::RowVector3d
  { return 0.25 * (points.row(vertices[other % size]) - parent); };
  if (corner == 0 && size > 3)
  {
    return toward(size / 2);
  }
  if (corner <= 1 || corner == size - 1)
  {
    return toward(corner + 1) + toward(corner + size - 1);
  }
  return toward(0);
}

} // namespace

RefinedMesh RefineFaces(const ContourMesh& mesh)
{
  RefinedMesh refined;
  refined.Parents = mesh.Faces.Connectivity;
  // Each old face shrinks and keeps its place ...
  refined.Faces.Offsets = mesh.Faces.Offsets;
  refined.Faces.Connectivity.resize(mesh.Faces.Connectivity.size());
  for (std::size_t corner = 0; corner < refined.Faces.Connectivity.size(); ++corner)
  {
    refined.Faces.Connectivity[corner] = static_cast<int>(corner);
  }
  // ... each old vertex and each old edge opens into a quad.
  const CornerLinks links(mesh);
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    const auto& at = links.CornerAt[vertex];
    refined.Faces.Append({ at[0], at[1], at[2], at[3] });
  }
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    for (int slot = 0; slot < 4; ++slot)
    {
      const int other = mesh.Neighbors[vertex][slot];
      if (other < vertex)
      {
        continue;
      }
      int back = 0;
      while (mesh.Neighbors[other][back] != vertex)
      {
        ++back;
      }
      // Left and right of the edge, at this end and at the other.
      const int left = links.CornerAt[vertex][slot];
      const int right = links.CornerAt[vertex][(slot + 3) % 4];
      const int otherRight = links.CornerAt[other][back];
      const int otherLeft = links.CornerAt[other][(back + 3) % 4];
      refined.Faces.Append({ left, right, otherRight, otherLeft });
    }
  }
  return refined;
}

PointList RefinePoints(const ContourMesh& mesh, const PointList& points,
  const Eigen::VectorXd& reach)
{
  PointList refined(static_cast<Eigen::Index>(mesh.Faces.Connectivity.size()), 3);
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int size = mesh.Faces.FaceSize(face);
    const int* vertices = mesh.Faces.Face(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const Eigen::RowVector3d parent = points.row(vertices[corner]);
      const Eigen::RowVector3d smooth = TowardsDooSabin(points, vertices, size, corner);
      const Eigen::RowVector3d flat = TowardsTriangles(points, vertices, size, corner);
      const double part = reach[vertices[corner]];
      refined.row(mesh.Faces.Offsets[face] + corner) =
        parent + part * (flat + part * (smooth - flat));
    }
  }
  return refined;
}

PointList RefinePoints(const ContourMesh& mesh, const PointList& points, double reach)
{
  return RefinePoints(mesh, points, Eigen::VectorXd::Constant(points.rows(), reach));
}

} // namespace FlipFree

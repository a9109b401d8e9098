#include "Measures/SurfaceQuality.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

const double Pi = 4 * std::atan(1.0);

// A corner of a face with the edges to the next and to the previous vertex.
struct CornerEdges
{
  Eigen::Vector3d Next;
  Eigen::Vector3d Previous;

  CornerEdges(const PointList& points, const FaceList& faces, int face, int corner)
  {
    const int* vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    const Eigen::RowVector3d vertex = points.row(vertices[corner]);
    this->Next = points.row(vertices[(corner + 1) % size]) - vertex;
    this->Previous = points.row(vertices[(corner + size - 1) % size]) - vertex;
  }
  Eigen::Vector3d Normal() const { return this->Next.cross(this->Previous); }
};

// By Newell's method: the direction in which the polygon's projection has the maximum area.
Eigen::Vector3d MeanNormal(const PointList& points, const FaceList& faces, int face)
{
  const int* vertices = faces.Face(face);
  const Eigen::Vector3d first = points.row(vertices[0]);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int corner = 2; corner < faces.FaceSize(face); ++corner)
  {
    normal += (points.row(vertices[corner - 1]).transpose() - first)
                .cross(points.row(vertices[corner]).transpose() - first);
  }
  return normal.normalized();
}

double ScaledJacobian(const PointList& points, const FaceList& faces, int face)
{
  const int size = faces.FaceSize(face);
  const Eigen::Vector3d normal = MeanNormal(points, faces, face);
  double minimum = 1;
  for (int corner = 0; corner < size; ++corner)
  {
    const CornerEdges edges(points, faces, face, corner);
    const double lengths = edges.Next.norm() * edges.Previous.norm();
    const double sine = lengths > 0 ? edges.Normal().dot(normal) / lengths : 0;
    minimum = std::min(minimum, sine / std::sin(2 * Pi / size));
  }
  return minimum;
}

double DihedralAngle(const PointList& points, const TriangleList& triangles,
  const SurfaceEdge& edge)
{
  std::array<Eigen::Vector3d, 2> normals;
  for (int side = 0; side < 2; ++side)
  {
    const auto triangle = triangles.row(edge.Faces[side]);
    const Eigen::Vector3d a = points.row(triangle[0]);
    const Eigen::Vector3d b = points.row(triangle[1]);
    const Eigen::Vector3d c = points.row(triangle[2]);
    normals[side] = (b - a).cross(c - a);
    if (normals[side].squaredNorm() == 0)
    {
      return 0; // a degenerate triangle counts as folded back
    }
  }
  const double turn = std::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1]));
  return 180 - turn * 180 / Pi;
}

double MinimumDihedralAngle(const PointList& points, const FaceList& faces)
{
  const TriangleList triangles = Triangulate(faces);
  double minimum = 180;
  for (const SurfaceEdge& edge : CollectEdges(static_cast<int>(points.rows()), FacesOf(triangles)))
  {
    if (edge.Forward == 1 && edge.Backward == 1)
    {
      minimum = std::min(minimum, DihedralAngle(points, triangles, edge));
    }
  }
  return minimum;
}

double EdgeLengthVariation(const PointList& points, const std::vector<SurfaceEdge>& edges)
{
  Eigen::VectorXd lengths(edges.size());
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
  {
    lengths[edge] = (points.row(edges[edge].Higher) - points.row(edges[edge].Lower)).norm();
  }
  const double mean = lengths.size() > 0 ? lengths.mean() : 0;
  return mean > 0 ? std::sqrt((lengths.array() - mean).square().mean()) / mean : 0;
}

} // namespace

SurfaceQuality MeasureQuality(const PointList& points, const FaceList& faces)
{
  RequireValidFaces(points, faces, "the surface");
  const int numberOfPoints = static_cast<int>(points.rows());
  const auto edges = CollectEdges(numberOfPoints, faces);
  SurfaceQuality quality;
  quality.Topology = MeasureTopology(faces, edges);
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    quality.ScaledJacobians.push_back(ScaledJacobian(points, faces, face));
  }
  std::vector<double> sorted = quality.ScaledJacobians;
  std::sort(sorted.begin(), sorted.end());
  quality.MinimumScaledJacobian = sorted.front();
  quality.FirstPercentileScaledJacobian = sorted[(sorted.size() + 99) / 100 - 1];
  quality.MinimumDihedralAngle = MinimumDihedralAngle(points, faces);
  quality.EdgeLengthVariation = EdgeLengthVariation(points, edges);
  return quality;
}

std::vector<int> CountFlippedCorners(const PointList& points, const PointList& reference,
  const FaceList& faces)
{
  std::vector<int> flipped(faces.NumberOfFaces(), 0);
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    for (int corner = 0; corner < faces.FaceSize(face); ++corner)
    {
      const Eigen::Vector3d before = CornerEdges(reference, faces, face, corner).Normal();
      const Eigen::Vector3d after = CornerEdges(points, faces, face, corner).Normal();
      flipped[face] += !(before.dot(after) > 0);
    }
  }
  return flipped;
}

} // namespace FlipFree

#include "Mesh/SurfaceTopology.h"

#include "Error.h"

#include <algorithm>
#include <sstream>

namespace FlipFree
{
namespace
{

// A side of a face; half-edges are grouped by their lower vertex.
struct HalfEdge
{
  int Higher;
  int Face;
  bool IsBackward;

  bool operator<(const HalfEdge& other) const
  {
    return this->Higher != other.Higher ? this->Higher < other.Higher : this->Face < other.Face;
  }
};

std::string ProblemOf(const SurfaceEdge& edge)
{
  switch (const int uses = edge.Forward + edge.Backward)
  {
    case 1:
      return "on one face only; fill holes, and merge coincident points";
    case 2:
      return "used twice in the same direction; orient the faces alike";
    default:
      return "on " + std::to_string(uses) + " faces; part what touches along it";
  }
}

} // namespace

FaceList FacesOf(const TriangleList& triangles)
{
  FaceList faces;
  faces.Connectivity.assign(triangles.data(), triangles.data() + triangles.size());
  faces.Offsets.resize(triangles.rows() + 1);
  for (Eigen::Index face = 0; face <= triangles.rows(); ++face)
  {
    faces.Offsets[face] = static_cast<int>(3 * face);
  }
  return faces;
}

std::vector<SurfaceEdge> CollectEdges(int numberOfPoints, const FaceList& faces)
{
  // A counting sort by the lower vertex leaves few half-edges per vertex to be sorted.
  std::vector<int> offsets(static_cast<std::size_t>(numberOfPoints) + 1, 0);
  const auto forEachHalfEdge = [&faces](auto&& visit)
  {
    for (int face = 0; face < faces.NumberOfFaces(); ++face)
    {
      const int* vertices = faces.Face(face);
      const int size = faces.FaceSize(face);
      for (int corner = 0; corner < size; ++corner)
      {
        const int from = vertices[corner];
        const int to = vertices[corner + 1 < size ? corner + 1 : 0];
        if (from != to)
        {
          visit(face, from, to);
        }
      }
    }
  };
  forEachHalfEdge([&offsets](int, int from, int to) { ++offsets[std::min(from, to) + 1]; });
  for (int vertex = 0; vertex < numberOfPoints; ++vertex)
  {
    offsets[vertex + 1] += offsets[vertex];
  }
  std::vector<HalfEdge> halfEdges(offsets.back());
  std::vector<int> next(offsets.begin(), offsets.end() - 1);
  forEachHalfEdge(
    [&](int face, int from, int to) {
      halfEdges[next[std::min(from, to)]++] = { std::max(from, to), face, from > to };
    });

  std::vector<SurfaceEdge> edges;
  edges.reserve(halfEdges.size() / 2 + 1);
  for (int vertex = 0; vertex < numberOfPoints; ++vertex)
  {
    const auto begin = halfEdges.begin() + offsets[vertex];
    const auto end = halfEdges.begin() + offsets[vertex + 1];
    std::sort(begin, end);
    for (auto halfEdge = begin; halfEdge != end; ++halfEdge)
    {
      if (halfEdge == begin || halfEdge->Higher != edges.back().Higher)
      {
        edges.push_back({ vertex, halfEdge->Higher });
      }
      SurfaceEdge& edge = edges.back();
      const int uses = edge.Forward + edge.Backward;
      if (uses < 2)
      {
        edge.Faces[uses] = halfEdge->Face;
      }
      ++(halfEdge->IsBackward ? edge.Backward : edge.Forward);
    }
  }
  return edges;
}

SurfaceTopology MeasureTopology(const FaceList& faces, const std::vector<SurfaceEdge>& edges)
{
  SurfaceTopology topology;
  std::vector<int> vertices = faces.Connectivity;
  std::sort(vertices.begin(), vertices.end());
  topology.Vertices =
    static_cast<int>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
  topology.Edges = static_cast<int>(edges.size());
  topology.Faces = faces.NumberOfFaces();
  for (const SurfaceEdge& edge : edges)
  {
    const int uses = edge.Forward + edge.Backward;
    topology.BoundaryEdges += uses == 1;
    topology.NonManifoldEdges += uses > 2;
    topology.MisorientedEdges += uses == 2 && edge.Forward != 1;
  }
  return topology;
}

void RequireValidFaces(const Eigen::Ref<const PointList>& points, const FaceList& faces,
  const std::string& name)
{
  if (faces.NumberOfFaces() == 0)
  {
    throw Error(ErrorCode::InvalidMesh, name + " has no polygons; it must have at least one");
  }
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const auto where = [&] { return "polygon " + std::to_string(face) + " of " + name; };
    if (faces.FaceSize(face) < 3)
    {
      throw Error(ErrorCode::InvalidMesh, where() + " has fewer than three vertices; remove it");
    }
    for (int corner = 0; corner < faces.FaceSize(face); ++corner)
    {
      const int vertex = faces.Face(face)[corner];
      if (vertex < 0 || vertex >= points.rows())
      {
        throw Error(ErrorCode::InvalidMesh,
          where() + " refers to point " + std::to_string(vertex) + ", but there are " +
            std::to_string(points.rows()) + " points; repair the connectivity");
      }
      if (!points.row(vertex).allFinite())
      {
        throw Error(ErrorCode::NonFiniteValue,
          "point " + std::to_string(vertex) + " of " + name +
            " has a coordinate that is not a finite number; remove or repair it");
      }
    }
  }
}

void RequireClosed(int numberOfPoints, const TriangleList& triangles, const std::string& name)
{
  for (const SurfaceEdge& edge : CollectEdges(numberOfPoints, FacesOf(triangles)))
  {
    if (edge.Forward != edge.Backward)
    {
      throw Error(ErrorCode::OpenSurface,
        name + " is not closed and consistently oriented: " + std::to_string(edge.Forward) +
          " face(s) traverse the edge from point " + std::to_string(edge.Lower) + " to point " +
          std::to_string(edge.Higher) + " and " + std::to_string(edge.Backward) +
          " traverse it backwards; merge coincident points, fill holes, and orient the faces "
          "alike");
    }
  }
}

void RequireManifoldEdges(const FaceList& faces, const std::vector<SurfaceEdge>& edges,
  const std::string& name)
{
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      if (faces.Face(face)[corner] == faces.Face(face)[(corner + 1) % size])
      {
        throw Error(ErrorCode::InvalidMesh,
          "polygon " + std::to_string(face) + " of " + name +
            " has the same point twice in a row; remove it");
      }
    }
  }
  for (const SurfaceEdge& edge : edges)
  {
    if (edge.Forward != 1 || edge.Backward != 1)
    {
      throw Error(ErrorCode::NotFourValent,
        name + " is not a closed, consistently oriented surface: the edge from point " +
          std::to_string(edge.Lower) + " to point " + std::to_string(edge.Higher) + " is " +
          ProblemOf(edge));
    }
  }
}

double EnclosedVolume(const Eigen::Ref<const PointList>& points, const TriangleList& triangles)
{
  // Any point will do; far away, rounding would cost digits.
  const Eigen::RowVector3d center = points.colwise().mean();
  double volume = 0;
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const Eigen::RowVector3d a = points.row(triangles(triangle, 0)) - center;
    const Eigen::RowVector3d b = points.row(triangles(triangle, 1)) - center;
    const Eigen::RowVector3d c = points.row(triangles(triangle, 2)) - center;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

void RequireOutward(const PointList& points, const TriangleList& triangles, const std::string& name)
{
  const double volume = EnclosedVolume(points, triangles);
  if (volume < 0)
  {
    std::ostringstream message;
    message << name << " is inside out: it encloses a volume of " << volume
            << " mm3; reverse its faces";
    throw Error(ErrorCode::InsideOut, message.str());
  }
}

} // namespace FlipFree

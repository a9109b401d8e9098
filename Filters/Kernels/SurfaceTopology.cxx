#include "SurfaceTopology.h"

#include <algorithm>
#include <stdexcept>

namespace FlipFree
{

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
  // Half-edges sorted by their lower vertex in linear time; what remains to sort per vertex is
  // short.
  std::vector<int> offsets(static_cast<std::size_t>(numberOfPoints) + 1, 0);
  const auto forEachHalfEdge = [&faces](auto&& visit)
  {
    for (int face = 0; face < faces.NumberOfFaces(); ++face)
    {
      const int* vertices = faces.Face(face);
      const int size = faces.FaceSize(face);
      for (int corner = 0; corner < size; ++corner)
      {
        visit(vertices[corner], vertices[corner + 1 < size ? corner + 1 : 0]);
      }
    }
  };
  forEachHalfEdge([&offsets](int from, int to) { ++offsets[std::min(from, to) + 1]; });
  for (int vertex = 0; vertex < numberOfPoints; ++vertex)
  {
    offsets[vertex + 1] += offsets[vertex];
  }
  std::vector<std::pair<int, bool>> halfEdges(offsets.back());
  std::vector<int> next(offsets.begin(), offsets.end() - 1);
  forEachHalfEdge(
    [&](int from, int to) {
      halfEdges[next[std::min(from, to)]++] = { std::max(from, to), from > to };
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
      if (halfEdge == begin || halfEdge->first != edges.back().Higher)
      {
        edges.push_back({ vertex, halfEdge->first, 0, 0 });
      }
      ++(halfEdge->second ? edges.back().Backward : edges.back().Forward);
    }
  }
  return edges;
}

SurfaceTopology MeasureTopology(int numberOfPoints, const FaceList& faces)
{
  SurfaceTopology topology;
  std::vector<char> used(numberOfPoints, 0);
  for (int vertex : faces.Connectivity)
  {
    used[vertex] = 1;
  }
  topology.Vertices = static_cast<int>(std::count(used.begin(), used.end(), 1));
  topology.Faces = faces.NumberOfFaces();
  for (const SurfaceEdge& edge : CollectEdges(numberOfPoints, faces))
  {
    const int uses = edge.Forward + edge.Backward;
    ++topology.Edges;
    topology.BoundaryEdges += uses == 1;
    topology.NonManifoldEdges += uses > 2;
    topology.MisorientedEdges += uses == 2 && edge.Forward != 1;
  }
  return topology;
}

void RequireValidTriangles(const PointList& points, const TriangleList& triangles,
  const std::string& name)
{
  if (triangles.rows() == 0)
  {
    throw std::invalid_argument(name + " has no triangles; it must have at least one polygon");
  }
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int vertex = triangles(triangle, corner);
      if (vertex < 0 || vertex >= points.rows())
      {
        throw std::invalid_argument("triangle " + std::to_string(triangle) + " of " + name +
          " names point " + std::to_string(vertex) + ", but there are " +
          std::to_string(points.rows()) + " points; repair the connectivity");
      }
      if (!points.row(vertex).allFinite())
      {
        throw std::invalid_argument("point " + std::to_string(vertex) + " of " + name +
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
      throw std::invalid_argument(name +
        " is not closed and consistently oriented: " + std::to_string(edge.Forward) +
        " face(s) pass the edge from point " + std::to_string(edge.Lower) + " to point " +
        std::to_string(edge.Higher) + " and " + std::to_string(edge.Backward) +
        " pass it backwards; merge coincident points, fill holes, and orient the faces alike");
    }
  }
}

} // namespace FlipFree

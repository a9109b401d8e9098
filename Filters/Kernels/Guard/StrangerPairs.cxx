#include "Guard/StrangerPairs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace FlipFree
{
namespace
{

using IndexLists = std::vector<std::vector<int>>;

void SortUnique(std::vector<int>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// The triangles around each vertex.
IndexLists ListStars(int numberOfPoints, const TriangleList& triangles)
{
  IndexLists stars(numberOfPoints);
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      stars[triangles(triangle, corner)].push_back(triangle);
    }
  }
  return stars;
}

// The triangles that are not strange to each triangle, itself included.
IndexLists ListNeighbors(const TriangleList& triangles, const IndexLists& stars)
{
  IndexLists neighbors(triangles.rows());
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    neighbors[triangle].reserve(24);
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::vector<int>& star = stars[triangles(triangle, corner)];
      neighbors[triangle].insert(neighbors[triangle].end(), star.begin(), star.end());
    }
    SortUnique(neighbors[triangle]);
  }
  return neighbors;
}

// A vertex and a triangle are without strangers if all triangles around the vertex are neighbors
// of the triangle.
void AppendVertexFaces(const TriangleList& triangles, const IndexLists& stars,
  const std::vector<int>& neighbors, const std::array<int, 3>& face, FeaturePairs& pairs)
{
  std::vector<int> vertices;
  for (int neighbor : neighbors)
  {
    const int* const corners = triangles.row(neighbor).data();
    vertices.insert(vertices.end(), corners, corners + 3);
  }
  SortUnique(vertices);
  for (int vertex : vertices)
  {
    const std::vector<int>& star = stars[vertex];
    if (std::find(face.begin(), face.end(), vertex) == face.end() &&
      std::includes(neighbors.begin(), neighbors.end(), star.begin(), star.end()))
    {
      pairs.VertexFaces.push_back({ { { vertex } }, face });
    }
  }
}

// Two edges are without strangers if both triangles at the second are neighbors of both triangles
// at the first.
void AppendEdgeEdges(const TriangleList& triangles, const std::vector<int>& commonNeighbors,
  const std::array<int, 2>& edge, FeaturePairs& pairs)
{
  std::vector<std::array<int, 2>> others;
  for (int neighbor : commonNeighbors)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int a = triangles(neighbor, corner);
      const int b = triangles(neighbor, (corner + 1) % 3);
      const std::array<int, 2> other{ { std::min(a, b), std::max(a, b) } };
      // Every pair once.
      if (edge < other && other[0] != edge[0] && other[0] != edge[1] && other[1] != edge[0] &&
        other[1] != edge[1])
      {
        others.push_back(other);
      }
    }
  }
  std::sort(others.begin(), others.end());
  for (std::size_t i = 1; i < others.size(); ++i)
  {
    if (others[i] == others[i - 1])
    {
      pairs.EdgeEdges.push_back({ edge, others[i] });
    }
  }
}

} // namespace

FeaturePairs ListPairsWithoutStrangers(int numberOfPoints, const TriangleList& triangles)
{
  const IndexLists stars = ListStars(numberOfPoints, triangles);
  const IndexLists neighbors = ListNeighbors(triangles, stars);
  FeaturePairs pairs;
  std::vector<int> common;
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const std::array<int, 3> face{ { triangles(triangle, 0), triangles(triangle, 1),
      triangles(triangle, 2) } };
    AppendVertexFaces(triangles, stars, neighbors[triangle], face, pairs);
    for (int corner = 0; corner < 3; ++corner)
    {
      const int a = face[corner];
      const int b = face[(corner + 1) % 3];
      for (int other : stars[a])
      {
        const std::vector<int>& atOtherEnd = stars[b];
        if (other > triangle && std::binary_search(atOtherEnd.begin(), atOtherEnd.end(), other))
        {
          common.clear();
          std::set_intersection(neighbors[triangle].begin(), neighbors[triangle].end(),
            neighbors[other].begin(), neighbors[other].end(), std::back_inserter(common));
          AppendEdgeEdges(triangles, common, { { std::min(a, b), std::max(a, b) } }, pairs);
        }
      }
    }
  }
  return pairs;
}

} // namespace FlipFree

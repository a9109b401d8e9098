#include "StrangerPairs.h"

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
IndexLists ListNeighbours(const TriangleList& triangles, const IndexLists& stars)
{
  IndexLists neighbours(triangles.rows());
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    neighbours[triangle].reserve(24);
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::vector<int>& star = stars[triangles(triangle, corner)];
      neighbours[triangle].insert(neighbours[triangle].end(), star.begin(), star.end());
    }
    SortUnique(neighbours[triangle]);
  }
  return neighbours;
}

// A vertex and a triangle are without strangers if all triangles around the vertex are neighbours
// of the triangle.
void AppendVertexFaces(const TriangleList& triangles, const IndexLists& stars,
  const std::vector<int>& neighbours, const std::array<int, 3>& face, FeaturePairs& pairs)
{
  std::vector<int> vertices;
  for (int neighbour : neighbours)
  {
    const int* const corners = triangles.row(neighbour).data();
    vertices.insert(vertices.end(), corners, corners + 3);
  }
  SortUnique(vertices);
  for (int vertex : vertices)
  {
    const std::vector<int>& star = stars[vertex];
    if (std::find(face.begin(), face.end(), vertex) == face.end() &&
      std::includes(neighbours.begin(), neighbours.end(), star.begin(), star.end()))
    {
      pairs.VertexFaces.push_back({ { { vertex } }, face });
    }
  }
}

// Two edges are without strangers if both triangles at the second are neighbours of both triangles
// at the first.
void AppendEdgeEdges(const TriangleList& triangles, const std::vector<int>& commonNeighbours,
  const std::array<int, 2>& edge, FeaturePairs& pairs)
{
  std::vector<std::array<int, 2>> others;
  for (int neighbour : commonNeighbours)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int a = triangles(neighbour, corner);
      const int b = triangles(neighbour, (corner + 1) % 3);
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
  const IndexLists neighbours = ListNeighbours(triangles, stars);
  FeaturePairs pairs;
  std::vector<int> common;
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const std::array<int, 3> face{ { triangles(triangle, 0), triangles(triangle, 1),
      triangles(triangle, 2) } };
    AppendVertexFaces(triangles, stars, neighbours[triangle], face, pairs);
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
          std::set_intersection(neighbours[triangle].begin(), neighbours[triangle].end(),
            neighbours[other].begin(), neighbours[other].end(), std::back_inserter(common));
          AppendEdgeEdges(triangles, common, { { std::min(a, b), std::max(a, b) } }, pairs);
        }
      }
    }
  }
  return pairs;
}

} // namespace FlipFree

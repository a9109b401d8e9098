#include "Guard/CandidatePairs.h"

#include <iterator>
#include <numeric>

namespace FlipFree
{
namespace
{

using Face = std::array<int, 3>;

Face FaceOf(const TriangleList& triangles, int triangle)
{
  return { { triangles(triangle, 0), triangles(triangle, 1), triangles(triangle, 2) } };
}

// Whether a triangle below a node has changed.
struct ChangeFlag
{
  char IsSet = 0;
  void Merge(const ChangeFlag& other) { this->IsSet |= other.IsSet; }
};

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

// The triangles that have a vertex in common with each triangle, itself included.
IndexLists ListAdjacent(const TriangleList& triangles, const IndexLists& stars)
{
  IndexLists adjacent(triangles.rows());
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    adjacent[triangle].reserve(24);
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::vector<int>& star = stars[triangles(triangle, corner)];
      adjacent[triangle].insert(adjacent[triangle].end(), star.begin(), star.end());
    }
    SortUnique(adjacent[triangle]);
  }
  return adjacent;
}

// A vertex and a triangle are in no disjoint pair if all triangles around the vertex are adjacent
// to the triangle.
void AppendVertexFaces(const TriangleList& triangles, const IndexLists& stars,
  const std::vector<int>& adjacent, const std::array<int, 3>& face,
  std::vector<VertexFacePair>& pairs)
{
  std::vector<int> vertices;
  for (int other : adjacent)
  {
    const int* const corners = triangles.row(other).data();
    vertices.insert(vertices.end(), corners, corners + 3);
  }
  SortUnique(vertices);
  for (int vertex : vertices)
  {
    const std::vector<int>& star = stars[vertex];
    if (std::find(face.begin(), face.end(), vertex) == face.end() &&
      std::includes(adjacent.begin(), adjacent.end(), star.begin(), star.end()))
    {
      pairs.push_back({ { { vertex } }, face });
    }
  }
}

// Two edges are in no disjoint pair if both triangles at the second are adjacent to both triangles
// at the first.
void AppendEdgeEdges(const TriangleList& triangles, const std::vector<int>& commonAdjacent,
  const std::array<int, 2>& edge, std::vector<EdgeEdgePair>& pairs)
{
  std::vector<std::array<int, 2>> others;
  for (int triangle : commonAdjacent)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int a = triangles(triangle, corner);
      const int b = triangles(triangle, (corner + 1) % 3);
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
      pairs.push_back({ edge, others[i] });
    }
  }
}

} // namespace

CandidatePairs::CandidatePairs(int numberOfPoints, const TriangleList& triangles)
  : Triangles(triangles)
  , Layout(TriangleTree::TopologicalLayout(numberOfPoints, triangles))
  , TreeOfTriangles(this->Layout, triangles)
{
  this->ListDisjointTriangles();
  this->ListUncoveredPairs(numberOfPoints);
}

void CandidatePairs::ListDisjointTriangles()
{
  const auto pairs = this->TreeOfTriangles.DisjointPairs(this->Layout, this->Triangles);
  this->FirstPartner.assign(this->TreeOfTriangles.NumberOfNodes() + 1, 0);
  for (const auto& pair : pairs)
  {
    ++this->FirstPartner[pair.first + 1];
    ++this->FirstPartner[pair.second + 1];
  }
  std::partial_sum(this->FirstPartner.begin(), this->FirstPartner.end(),
    this->FirstPartner.begin());
  this->Partners.resize(this->FirstPartner.back());
  std::vector<int> next = this->FirstPartner;
  for (const auto& pair : pairs)
  {
    this->Partners[next[pair.first]++] = pair.second;
    this->Partners[next[pair.second]++] = pair.first;
  }
}

void CandidatePairs::ListUncoveredPairs(int numberOfPoints)
{
  const IndexLists stars = ListStars(numberOfPoints, this->Triangles);
  const IndexLists adjacent = ListAdjacent(this->Triangles, stars);
  std::vector<int> common;
  for (int triangle = 0; triangle < this->Triangles.rows(); ++triangle)
  {
    const Face face = FaceOf(this->Triangles, triangle);
    AppendVertexFaces(this->Triangles, stars, adjacent[triangle], face, this->VertexFaces);
    for (int corner = 0; corner < 3; ++corner)
    {
      const int a = face[corner];
      const int b = face[(corner + 1) % 3];
      for (int other : stars[a])
      {
        if (other > triangle && std::binary_search(stars[b].begin(), stars[b].end(), other))
        {
          common.clear();
          std::set_intersection(adjacent[triangle].begin(), adjacent[triangle].end(),
            adjacent[other].begin(), adjacent[other].end(), std::back_inserter(common));
          AppendEdgeEdges(this->Triangles, common, { { std::min(a, b), std::max(a, b) } },
            this->EdgeEdges);
        }
      }
    }
  }
}

void CandidatePairs::VisitDisjointTriangles(const Motion& motion, double gap,
  const std::vector<char>& changed, std::vector<MotionBox>& boxes,
  const std::function<void(int one, int two)>& visit, const ParallelFor& parallelFor) const
{
  std::vector<ChangeFlag> flags;
  this->TreeOfTriangles.Refit(flags,
    [&](int triangle)
    {
      const int* const v = this->Triangles.row(triangle).data();
      return ChangeFlag{ static_cast<char>(changed[v[0]] | changed[v[1]] | changed[v[2]]) };
    });
  this->TreeOfTriangles.Refit(
    boxes,
    [&](int triangle) { return MotionBox(motion, FaceOf(this->Triangles, triangle), gap / 2); },
    parallelFor, [&](int node) { return flags[node].IsSet != 0; });
  const auto meet = [&](int node, int other)
  {
    return (flags[node].IsSet | flags[other].IsSet) != 0 &&
      !boxes[node].StaysApartFrom(boxes[other]);
  };
  parallelFor(0, this->TreeOfTriangles.NumberOfNodes(),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int node = static_cast<int>(first); node < last; ++node)
      {
        if (!flags[node].IsSet)
        {
          continue;
        }
        for (int index = this->FirstPartner[node]; index < this->FirstPartner[node + 1]; ++index)
        {
          // A pair of which both nodes have changed is left to the first one.
          const int other = this->Partners[index];
          if ((node < other || !flags[other].IsSet) && !boxes[node].StaysApartFrom(boxes[other]))
          {
            this->TreeOfTriangles.VisitPairsBelow({ node, other }, meet, visit);
          }
        }
      }
    });
}

} // namespace FlipFree

#include "Mesh/MidpointMesh.h"

#include "Error.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/SurfaceTopology.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace FlipFree
{
namespace
{

// From a neighbor of a vertex to the one before it, counter-clockwise seen from outside.
using RingLinks = std::vector<std::pair<int, int>>;

// The edges of a mesh, found by their ends.
class EdgeMidpoints
{
public:
  explicit EdgeMidpoints(const PolygonMesh& mesh)
    : Edges(CollectEdges(static_cast<int>(mesh.Points.rows()), mesh.Faces))
  {
  }

  const std::vector<SurfaceEdge>& GetEdges() const { return this->Edges; }

  int IndexOf(int from, int to) const
  {
    const std::pair<int, int> ends = std::minmax({ from, to });
    const auto found = std::lower_bound(this->Edges.begin(), this->Edges.end(), ends,
      [](const SurfaceEdge& edge, const std::pair<int, int>& wanted)
      { return std::make_pair(edge.Lower, edge.Higher) < wanted; });
    return static_cast<int>(found - this->Edges.begin());
  }

  PointList PointsOf(const PointList& points) const
  {
    PointList midpoints(static_cast<Eigen::Index>(this->Edges.size()), 3);
    for (std::size_t edge = 0; edge < this->Edges.size(); ++edge)
    {
      midpoints.row(static_cast<Eigen::Index>(edge)) =
        0.5 * (points.row(this->Edges[edge].Lower) + points.row(this->Edges[edge].Higher));
    }
    return midpoints;
  }

private:
  std::vector<SurfaceEdge> Edges; // in the order of their ends
};

// A face around a vertex: the midpoints of its edges, in the order of the links.
void AppendRing(int vertex, RingLinks& links, const EdgeMidpoints& midpoints,
  const std::string& name, FaceList& faces)
{
  if (links.size() < 3)
  {
    throw Error(ErrorCode::NotFourValent,
      "point " + std::to_string(vertex) + " of " + name +
        " has fewer than three neighbors; merge the faces around it");
  }
  std::sort(links.begin(), links.end());
  const int first = links.front().first;
  int neighbor = first;
  std::size_t length = 0;
  do
  {
    faces.Connectivity.push_back(midpoints.IndexOf(vertex, neighbor));
    const auto link = std::lower_bound(links.begin(), links.end(), std::make_pair(neighbor, -1));
    neighbor = link->second;
  } while (++length < links.size() && neighbor != first);
  if (length < links.size())
  {
    throw Error(ErrorCode::NotFourValent,
      "the faces around point " + std::to_string(vertex) + " of " + name +
        " do not form one ring; part what touches there, or merge it");
  }
  faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
}

} // namespace

PolygonMesh MakeMidpointMesh(const PolygonMesh& mesh, const std::string& name)
{
  const EdgeMidpoints midpoints(mesh);
  RequireManifoldEdges(mesh.Faces, midpoints.GetEdges(), name);
  PolygonMesh result;
  result.Points = midpoints.PointsOf(mesh.Points);
  std::vector<RingLinks> links(mesh.Points.rows());
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int* const vertices = mesh.Faces.Face(face);
    const int size = mesh.Faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const int before = vertices[(corner + size - 1) % size];
      const int after = vertices[(corner + 1) % size];
      result.Faces.Connectivity.push_back(midpoints.IndexOf(vertices[corner], after));
      links[vertices[corner]].emplace_back(after, before);
    }
    result.Faces.Offsets.push_back(static_cast<int>(result.Faces.Connectivity.size()));
  }
  for (std::size_t vertex = 0; vertex < links.size(); ++vertex)
  {
    if (!links[vertex].empty())
    {
      AppendRing(static_cast<int>(vertex), links[vertex], midpoints, name, result.Faces);
    }
  }
  return result;
}

PolygonMesh SplitTriangles(const PolygonMesh& mesh)
{
  const TriangleList triangles = Triangulate(mesh.Faces);
  const EdgeMidpoints midpoints({ mesh.Points, FacesOf(triangles) });
  const auto first = static_cast<int>(mesh.Points.rows());
  PolygonMesh result;
  result.Points.resize(first + static_cast<Eigen::Index>(midpoints.GetEdges().size()), 3);
  result.Points << mesh.Points, midpoints.PointsOf(mesh.Points);
  for (const auto triangle : triangles.rowwise())
  {
    const int a = triangle[0];
    const int b = triangle[1];
    const int c = triangle[2];
    const int ab = first + midpoints.IndexOf(a, b);
    const int bc = first + midpoints.IndexOf(b, c);
    const int ca = first + midpoints.IndexOf(c, a);
    result.Faces.Append({ a, ab, ca });
    result.Faces.Append({ b, bc, ab });
    result.Faces.Append({ c, ca, bc });
    result.Faces.Append({ ab, bc, ca });
  }
  return result;
}

PolygonMesh WithoutUnusedPoints(const PolygonMesh& mesh)
{
  std::vector<int> number(mesh.Points.rows(), -1);
  for (const int vertex : mesh.Faces.Connectivity)
  {
    number[vertex] = 0;
  }
  PolygonMesh result = mesh;
  int used = 0;
  for (std::size_t vertex = 0; vertex < number.size(); ++vertex)
  {
    if (number[vertex] == 0)
    {
      result.Points.row(used) = mesh.Points.row(static_cast<Eigen::Index>(vertex));
      number[vertex] = used++;
    }
  }
  result.Points.conservativeResize(used, 3);
  for (int& vertex : result.Faces.Connectivity)
  {
    vertex = number[vertex];
  }
  return result;
}

} // namespace FlipFree

#include "Mesh/ContourMesh.h"

#include "Error.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// The neighbors of a vertex in one face. Seen from outside, `Before` is the next neighbor after
// `After` counter-clockwise around the vertex.
struct CornerAtVertex
{
  int After;
  int Before;
};

[[noreturn]] void Refuse(const std::string& what)
{
  throw Error(ErrorCode::NotFourValent,
    what +
      "; FlipFree deforms closed, consistently oriented meshes in which every vertex has four "
      "neighbors (the edge midpoints of any closed mesh form one)");
}

std::array<int, 4> CyclicNeighbors(int vertex, const std::vector<CornerAtVertex>& corners)
{
  if (corners.size() != 4)
  {
    Refuse("vertex " + std::to_string(vertex) + " is a corner of " +
      std::to_string(corners.size()) + " faces instead of 4");
  }
  std::array<int, 4> ring{};
  int neighbor = corners[0].After;
  for (int slot = 0; slot < 4; ++slot)
  {
    ring[slot] = neighbor;
    int next = -1;
    for (const CornerAtVertex& corner : corners)
    {
      if (corner.After == neighbor)
      {
        if (next >= 0)
        {
          Refuse("the edge from vertex " + std::to_string(vertex) + " to vertex " +
            std::to_string(neighbor) + " is used twice in the same direction");
        }
        next = corner.Before;
      }
    }
    if (next < 0)
    {
      Refuse("the mesh is open at the edge between vertices " + std::to_string(vertex) + " and " +
        std::to_string(neighbor));
    }
    neighbor = next;
  }
  for (int slot = 0; slot < 4; ++slot)
  {
    for (int other = slot + 1; other < 4; ++other)
    {
      if (ring[slot] == ring[other])
      {
        Refuse("vertex " + std::to_string(vertex) + " has fewer than four different neighbors");
      }
    }
  }
  if (neighbor != ring[0])
  {
    Refuse("the faces around vertex " + std::to_string(vertex) + " do not form one ring");
  }
  return ring;
}

int SlotOf(const std::array<int, 4>& ring, int neighbor)
{
  for (int slot = 0; slot < 4; ++slot)
  {
    if (ring[slot] == neighbor)
    {
      return slot;
    }
  }
  return -1;
}

std::vector<std::vector<int>> TraceContours(const std::vector<std::array<int, 4>>& neighbors)
{
  std::vector<std::vector<int>> contours;
  // Two strands cross at a vertex: slots 0-2 and 1-3.
  std::vector<std::array<bool, 2>> visited(neighbors.size(), { { false, false } });
  for (std::size_t start = 0; start < neighbors.size(); ++start)
  {
    for (int strand = 0; strand < 2; ++strand)
    {
      if (visited[start][strand])
      {
        continue;
      }
      std::vector<int> contour;
      int vertex = static_cast<int>(start);
      int leaveBy = strand;
      while (!visited[vertex][leaveBy % 2])
      {
        visited[vertex][leaveBy % 2] = true;
        contour.push_back(vertex);
        const int next = neighbors[vertex][leaveBy];
        leaveBy = (SlotOf(neighbors[next], vertex) + 2) % 4;
        vertex = next;
      }
      contours.push_back(std::move(contour));
    }
  }
  return contours;
}

} // namespace

TriangleList Triangulate(const FaceList& faces)
{
  TriangleList triangles(
    static_cast<Eigen::Index>(faces.Connectivity.size()) - 2 * faces.NumberOfFaces(), 3);
  Eigen::Index row = 0;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* vertices = faces.Face(face);
    for (int corner = 2; corner < faces.FaceSize(face); ++corner)
    {
      triangles.row(row++) << vertices[0], vertices[corner - 1], vertices[corner];
    }
  }
  return triangles;
}

FaceList CutLargeFaces(const FaceList& faces)
{
  FaceList cut;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size <= 4)
    {
      cut.Connectivity.insert(cut.Connectivity.end(), vertices, vertices + size);
      cut.Offsets.push_back(static_cast<int>(cut.Connectivity.size()));
      continue;
    }
    for (int corner = 2; corner < size; ++corner)
    {
      cut.Append({ vertices[0], vertices[corner - 1], vertices[corner] });
    }
  }
  return cut;
}

int ContourMesh::EulerNumber() const
{
  const int edges = static_cast<int>(this->Faces.Connectivity.size()) / 2; // each on two faces
  return this->NumberOfPoints() - edges + this->Faces.NumberOfFaces();
}

ContourMesh BuildMeshAtRest(int numberOfPoints, const FaceList& faces)
{
  ContourMesh mesh;
  mesh.Faces = faces;
  mesh.Neighbors.resize(numberOfPoints);
  std::vector<int> found(numberOfPoints, 0);
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const int vertex = faces.Face(face)[corner];
      const int next = faces.Face(face)[(corner + 1) % size];
      // The last one found also takes the places of those that there are not.
      auto& ring = mesh.Neighbors[vertex];
      std::fill(ring.begin() + std::min(found[vertex], 4), ring.end(), next);
      ++found[vertex];
    }
  }
  mesh.Triangles = Triangulate(faces);
  return mesh;
}

ContourMesh BuildContourMesh(int numberOfPoints, const FaceList& faces)
{
  if (numberOfPoints == 0 || faces.NumberOfFaces() == 0)
  {
    Refuse("the mesh is empty");
  }
  std::vector<std::vector<CornerAtVertex>> corners(numberOfPoints);
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size < 3)
    {
      Refuse("face " + std::to_string(face) + " has fewer than three vertices");
    }
    for (int corner = 0; corner < size; ++corner)
    {
      const int vertex = vertices[corner];
      if (vertex < 0 || vertex >= numberOfPoints)
      {
        Refuse("face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
          ", which does not exist");
      }
      corners[vertex].push_back(
        { vertices[(corner + 1) % size], vertices[(corner + size - 1) % size] });
    }
  }

  ContourMesh mesh;
  mesh.Faces = faces;
  mesh.Neighbors.resize(numberOfPoints);
  for (int vertex = 0; vertex < numberOfPoints; ++vertex)
  {
    mesh.Neighbors[vertex] = CyclicNeighbors(vertex, corners[vertex]);
  }
  mesh.Contours = TraceContours(mesh.Neighbors);
  mesh.Triangles = Triangulate(faces);
  return mesh;
}

} // namespace FlipFree

#include "EmbeddingGuard.h"

#include "TriangleIntersection.h"

#include <algorithm>
#include <stdexcept>

namespace FlipFree
{
namespace
{

// Below this fraction of its displacement a vertex is not moved at all.
constexpr double LeastScale = 1.0 / 64;

// How much more of its displacement a neighbour may make: the held-back region fades out within a
// few vertices, instead of being torn off from the rest.
constexpr double ScaleDifference = 0.25;

// Normals are computed with rounding errors; the cosine keeps this distance from zero.
constexpr double LeastCosine = 1e-9;

struct MovedBox
{
  TriangleBox Box;
  bool Changed = false;

  void Merge(const MovedBox& other)
  {
    this->Box.Merge(other.Box);
    this->Changed = this->Changed || other.Changed;
  }
};

std::vector<std::array<int, 3>> ListCorners(const FaceList& faces)
{
  std::vector<std::array<int, 3>> corners;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const vertices = faces.Face(face);
    const int size = faces.FaceSize(face);
    // The corners of a triangle are all the same; the triangles that a larger face is cut into are
    // corners of it, except the middle ones of a fan.
    for (int corner = 0; corner < (size == 3 ? 1 : size); ++corner)
    {
      corners.push_back({ { vertices[(corner + size - 1) % size], vertices[corner],
        vertices[(corner + 1) % size] } });
    }
    for (int corner = 3; corner < size - 1; ++corner)
    {
      corners.push_back({ { vertices[0], vertices[corner - 1], vertices[corner] } });
    }
  }
  return corners;
}

Eigen::RowVector3d CornerNormal(const PointList& points, const std::array<int, 3>& corner)
{
  const Eigen::RowVector3d before = points.row(corner[0]) - points.row(corner[1]);
  const Eigen::RowVector3d after = points.row(corner[2]) - points.row(corner[1]);
  return after.cross(before);
}

} // namespace

EmbeddingGuard::EmbeddingGuard(const ContourMesh& mesh)
  : Neighbours(mesh.Neighbours)
  , Triangles(mesh.Triangles)
  , Corners(ListCorners(mesh.Faces))
  , Tree(TriangleTree::TopologicalLayout(mesh.NumberOfPoints(), mesh.Triangles), mesh.Triangles)
{
}

GuardReport EmbeddingGuard::Limit(const PointList& points, PointList& displacements,
  const ParallelFor& parallelFor, const Monitor& monitor) const
{
  const Eigen::Index count = static_cast<Eigen::Index>(this->Neighbours.size());
  if (points.rows() != count || displacements.rows() != count)
  {
    throw std::invalid_argument("The guard was made for a mesh of " + std::to_string(count) +
      " vertices and got " + std::to_string(points.rows()) + " points and " +
      std::to_string(displacements.rows()) + " displacements");
  }
  for (Eigen::Index vertex = 0; vertex < count; ++vertex)
  {
    if (!points.row(vertex).allFinite() || !displacements.row(vertex).allFinite())
    {
      throw std::invalid_argument("The position or displacement of vertex " +
        std::to_string(vertex) + " is not finite; check the targets");
    }
  }

  GuardReport report;
  std::vector<double> scales(count, 1.0);
  std::vector<char> changed(count, 1);
  std::vector<char> failed;
  PointList scaled = displacements;
  PointList moved;
  while (true)
  {
    moved = points + scaled;
    this->FindFailures(points, moved, changed, parallelFor, failed);
    ++report.Passes;
    const auto failure = std::find(failed.begin(), failed.end(), 1);
    if (failure == failed.end())
    {
      break;
    }
    if (!monitor(1 - 1.0 / report.Passes))
    {
      // Stopped from outside: the only motion known to be valid is none.
      std::fill(scales.begin(), scales.end(), 0.0);
      scaled.setZero();
      break;
    }
    if (!this->ScaleBack(failed, scales, changed))
    {
      throw std::invalid_argument("The surface intersects itself near vertex " +
        std::to_string(failure - failed.begin()) +
        " before it is moved; start from a surface without self-intersections");
    }
    for (Eigen::Index vertex = 0; vertex < count; ++vertex)
    {
      scaled.row(vertex) = scales[vertex] * displacements.row(vertex);
    }
  }
  for (Eigen::Index vertex = 0; vertex < count; ++vertex)
  {
    report.HeldBack += scales[vertex] < 1 && !displacements.row(vertex).isZero(0) ? 1 : 0;
  }
  displacements = scaled;
  return report;
}

void EmbeddingGuard::FindFailures(const PointList& points, const PointList& moved,
  const std::vector<char>& changed, const ParallelFor& parallelFor, std::vector<char>& failed) const
{
  failed.assign(changed.size(), 0);
  const auto hasChanged = [&](const int* vertices)
  { return changed[vertices[0]] || changed[vertices[1]] || changed[vertices[2]]; };

  std::vector<char> flipped(this->Corners.size(), 0);
  parallelFor(0, static_cast<std::ptrdiff_t>(this->Corners.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t index = first; index < last; ++index)
      {
        const Corner& corner = this->Corners[index];
        if (!hasChanged(corner.data()))
        {
          continue;
        }
        const Eigen::RowVector3d before = CornerNormal(points, corner);
        const Eigen::RowVector3d after = CornerNormal(moved, corner);
        flipped[index] =
          !before.isZero(0) && !(before.dot(after) > LeastCosine * before.norm() * after.norm());
      }
    });
  for (std::size_t index = 0; index < this->Corners.size(); ++index)
  {
    if (flipped[index])
    {
      for (int vertex : this->Corners[index])
      {
        failed[vertex] = 1;
      }
    }
  }

  std::vector<MovedBox> boxes;
  this->Tree.Refit(boxes,
    [&](int triangle)
    {
      MovedBox box;
      const int* const vertices = this->Triangles.row(triangle).data();
      for (int corner = 0; corner < 3; ++corner)
      {
        box.Box.Add(moved.row(vertices[corner]).data());
      }
      box.Changed = hasChanged(vertices);
      return box;
    });
  const auto pairs = this->Tree.SelfPairs(
    [&](int node, int other)
    {
      return (boxes[node].Changed || boxes[other].Changed) &&
        boxes[node].Box.Touches(boxes[other].Box);
    },
    [&](int one, int two) { return TrianglesIntersect(moved, this->Triangles, one, two); },
    parallelFor);
  for (const auto& pair : pairs)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      failed[this->Triangles(pair.first, corner)] = 1;
      failed[this->Triangles(pair.second, corner)] = 1;
    }
  }
}

bool EmbeddingGuard::ScaleBack(const std::vector<char>& failed, std::vector<double>& scales,
  std::vector<char>& changed) const
{
  changed.assign(failed.size(), 0);
  std::vector<int> queue;
  for (std::size_t vertex = 0; vertex < failed.size(); ++vertex)
  {
    if (failed[vertex] && scales[vertex] > 0)
    {
      scales[vertex] /= 2;
      if (scales[vertex] < LeastScale)
      {
        scales[vertex] = 0;
      }
      changed[vertex] = 1;
      queue.push_back(static_cast<int>(vertex));
    }
  }
  const bool progress = !queue.empty();
  for (std::size_t head = 0; head < queue.size(); ++head)
  {
    const double limit = scales[queue[head]] + ScaleDifference;
    for (int neighbour : this->Neighbours[queue[head]])
    {
      if (scales[neighbour] > limit)
      {
        scales[neighbour] = limit;
        changed[neighbour] = 1;
        queue.push_back(neighbour);
      }
    }
  }
  return progress;
}

} // namespace FlipFree

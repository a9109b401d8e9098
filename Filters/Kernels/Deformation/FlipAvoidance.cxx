#include "Deformation/FlipAvoidance.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

void MakeSolitary(int vertex, CorrespondenceField& field)
{
  field.States[vertex] = VertexState::Solitary;
  field.Displacements.row(vertex).setZero();
}

void ClearMarks(CorrespondenceField& field)
{
  std::replace(field.States.begin(), field.States.end(), VertexState::Flipping,
    VertexState::Matched);
}

// The vertices of a contour that have a target, in order.
void NonSolitary(const std::vector<int>& contour, const CorrespondenceField& field,
  std::vector<int>& chain)
{
  chain.clear();
  for (int vertex : contour)
  {
    if (field.States[vertex] != VertexState::Solitary)
    {
      chain.push_back(vertex);
    }
  }
}

bool Flips(const PointList& points, const CorrespondenceField& field, int i, int j, double r)
{
  const Eigen::RowVector3d u = points.row(i) - points.row(j);
  const Eigen::RowVector3d v = u + field.Displacements.row(i) - field.Displacements.row(j);
  const double lengths = u.norm() * v.norm();
  return lengths <= 0 || u.dot(v) < r * lengths;
}

// Marks the positions of the chain whose edge to the vertex before or after flips.
void FlipsAlong(const std::vector<int>& chain, const PointList& points, double r,
  const CorrespondenceField& field, std::vector<char>& flipping)
{
  const std::size_t size = chain.size();
  flipping.assign(size, 0);
  for (std::size_t position = 0; position < size; ++position)
  {
    const std::size_t next = (position + 1) % size;
    if (chain[position] != chain[next] && Flips(points, field, chain[position], chain[next], r))
    {
      flipping[position] = 1;
      flipping[next] = 1;
    }
  }
}

// Keeps the middle vertex of each maximal run of flipping vertices, and makes the others solitary.
// A contour that flips as a whole is one run, which may begin anywhere. Returns how many vertices
// became solitary.
int KeepMiddles(const std::vector<int>& chain, const std::vector<char>& flipping,
  CorrespondenceField& field)
{
  const std::size_t size = chain.size();
  std::size_t begin = 0;
  while (begin < size && flipping[begin])
  {
    ++begin;
  }
  begin = begin < size ? begin : 0;
  int dropped = 0;
  for (std::size_t offset = 0; offset < size;)
  {
    const std::size_t first = offset;
    while (offset < size && flipping[(begin + offset) % size])
    {
      ++offset;
    }
    const int middle = chain[(begin + first + (offset - first) / 2) % size];
    for (std::size_t position = first; position < offset; ++position)
    {
      // A contour may pass a vertex twice.
      const int vertex = chain[(begin + position) % size];
      if (vertex != middle && field.States[vertex] != VertexState::Solitary)
      {
        MakeSolitary(vertex, field);
        ++dropped;
      }
    }
    offset += offset == first;
  }
  return dropped;
}

} // namespace

int DetectFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field)
{
  ClearMarks(field);
  std::vector<int> chain;
  std::vector<char> flipping;
  for (const auto& contour : mesh.Contours)
  {
    NonSolitary(contour, field, chain);
    FlipsAlong(chain, points, r, field, flipping);
    for (std::size_t position = 0; position < chain.size(); ++position)
    {
      if (flipping[position])
      {
        field.States[chain[position]] = VertexState::Flipping;
      }
    }
  }
  return static_cast<int>(
    std::count(field.States.begin(), field.States.end(), VertexState::Flipping));
}

int AvoidFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field)
{
  ClearMarks(field);
  int dropped = 0;
  int droppedNow = 0;
  std::vector<int> chain;
  std::vector<char> flipping;
  // Only flips along the contour itself form its runs. A vertex that flips along its other contour
  // alone would be a run of length one here, which keeps its target. Each flip costs at least one
  // vertex its target, so the loop ends.
  do
  {
    droppedNow = 0;
    for (const auto& contour : mesh.Contours)
    {
      NonSolitary(contour, field, chain);
      FlipsAlong(chain, points, r, field, flipping);
      droppedNow += KeepMiddles(chain, flipping, field);
    }
    dropped += droppedNow;
  } while (droppedNow > 0);
  return dropped;
}

} // namespace FlipFree

#include "FlipAvoidance.h"

namespace FlipFree
{
namespace
{

void MakeSolitary(int vertex, CorrespondenceField& field)
{
  field.States[vertex] = VertexState::Solitary;
  field.Displacements.row(vertex).setZero();
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

// Of each maximal run of flipping vertices of one contour keeps the middle one. A contour that
// flips as a whole is one run that begins anywhere.
int KeepMiddles(const std::vector<int>& chain, CorrespondenceField& field)
{
  const std::size_t size = chain.size();
  const auto flipping = [&](std::size_t position)
  { return field.States[chain[position % size]] == VertexState::Flipping; };

  std::size_t begin = 0;
  while (begin < size && flipping(begin))
  {
    ++begin;
  }
  const bool wholeContour = begin == size;
  if (wholeContour)
  {
    begin = 0;
  }
  int dropped = 0;
  for (std::size_t offset = 0; offset < size;)
  {
    if (!flipping(begin + offset))
    {
      ++offset;
      continue;
    }
    const std::size_t first = offset;
    while (offset < size && flipping(begin + offset))
    {
      ++offset;
    }
    const std::size_t middle = first + (offset - first) / 2;
    for (std::size_t position = first; position < offset; ++position)
    {
      const int vertex = chain[(begin + position) % size];
      if (position == middle)
      {
        field.States[vertex] = VertexState::Matched;
      }
      else
      {
        MakeSolitary(vertex, field);
        ++dropped;
      }
    }
  }
  return dropped;
}

} // namespace

int DetectFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field)
{
  for (VertexState& state : field.States)
  {
    state = state == VertexState::Flipping ? VertexState::Matched : state;
  }
  std::vector<int> chain;
  for (const auto& contour : mesh.Contours)
  {
    NonSolitary(contour, field, chain);
    if (chain.size() < 2)
    {
      continue;
    }
    for (std::size_t position = 0; position < chain.size(); ++position)
    {
      const int i = chain[position];
      const int j = chain[(position + 1) % chain.size()];
      if (i != j && Flips(points, field, i, j, r))
      {
        field.States[i] = VertexState::Flipping;
        field.States[j] = VertexState::Flipping;
      }
    }
  }
  int count = 0;
  for (VertexState state : field.States)
  {
    count += state == VertexState::Flipping;
  }
  return count;
}

int AvoidFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field)
{
  int dropped = 0;
  std::vector<int> chain;
  // Each pass that finds a flip takes a target from at least one vertex, so this ends.
  while (DetectFlips(mesh, points, r, field) > 0)
  {
    int droppedNow = 0;
    for (const auto& contour : mesh.Contours)
    {
      NonSolitary(contour, field, chain);
      droppedNow += chain.empty() ? 0 : KeepMiddles(chain, field);
    }
    if (droppedNow == 0)
    {
      break;
    }
    dropped += droppedNow;
  }
  return dropped;
}

} // namespace FlipFree

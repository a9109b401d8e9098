#include "DisplacementDiffusion.h"

namespace FlipFree
{
namespace
{

// One pass of averaging. A vertex that no displacement has reached yet does not count as one that
// wants to rest: only `known` neighbours take part.
void AverageOnce(const ContourMesh& mesh, const std::vector<int>& vertices,
  PointList& displacements, std::vector<char>& known)
{
  std::vector<Eigen::RowVector3d> averages(vertices.size());
  std::vector<char> reached(vertices.size());
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    const int vertex = vertices[position];
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    int count = 0;
    const auto add = [&](int member)
    {
      if (known[member])
      {
        sum += displacements.row(member);
        ++count;
      }
    };
    add(vertex);
    for (int neighbour : mesh.Neighbours[vertex])
    {
      add(neighbour);
    }
    reached[position] = count > 0;
    averages[position] = count > 0 ? Eigen::RowVector3d(sum / count) : sum;
  }
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    displacements.row(vertices[position]) = averages[position];
    known[vertices[position]] = reached[position];
  }
}

} // namespace

void DiffuseDisplacements(const ContourMesh& mesh, const DiffusionSettings& settings,
  CorrespondenceField& field)
{
  std::vector<int> solitary;
  std::vector<int> all(mesh.NumberOfPoints());
  std::vector<char> known(mesh.NumberOfPoints());
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    all[vertex] = vertex;
    known[vertex] = field.States[vertex] != VertexState::Solitary;
    if (!known[vertex])
    {
      solitary.push_back(vertex);
    }
  }
  for (int pass = 0; pass < settings.Iterations && !solitary.empty(); ++pass)
  {
    AverageOnce(mesh, solitary, field.Displacements, known);
  }
  for (int pass = 0; pass < settings.SmoothingIterations; ++pass)
  {
    AverageOnce(mesh, all, field.Displacements, known);
  }
}

} // namespace FlipFree

#include "Deformation/DisplacementDiffusion.h"

#include <algorithm>
#include <vector>

namespace FlipFree
{
namespace
{

// Replaces the displacements of the listed vertices by the means over their neighbors and
// themselves. Only vertices that a displacement has reached take part: the others are undecided,
// which is not the same as no displacement.
void Average(const ContourMesh& mesh, const std::vector<int>& vertices, std::vector<char>& reached,
  PointList& displacements)
{
  PointList means(static_cast<Eigen::Index>(vertices.size()), 3);
  std::vector<int> counts(vertices.size(), 0);
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    const auto add = [&](int member)
    {
      if (reached[member])
      {
        sum += displacements.row(member);
        ++counts[position];
      }
    };
    add(vertices[position]);
    for (int neighbor : mesh.Neighbors[vertices[position]])
    {
      add(neighbor);
    }
    means.row(static_cast<Eigen::Index>(position)) = sum / std::max(1, counts[position]);
  }
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    displacements.row(vertices[position]) = means.row(static_cast<Eigen::Index>(position));
    reached[vertices[position]] = counts[position] > 0;
  }
}

} // namespace

void DiffuseDisplacements(const ContourMesh& mesh, const DiffusionSettings& settings,
  CorrespondenceField& field)
{
  std::vector<int> solitary;
  std::vector<int> all;
  std::vector<char> reached;
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    const bool isSolitary = field.States[vertex] == VertexState::Solitary;
    all.push_back(vertex);
    reached.push_back(isSolitary ? 0 : 1);
    if (isSolitary)
    {
      solitary.push_back(vertex);
    }
  }
  for (int pass = 0; pass < settings.Iterations && !solitary.empty(); ++pass)
  {
    Average(mesh, solitary, reached, field.Displacements);
  }
  for (int pass = 0; pass < settings.SmoothingIterations; ++pass)
  {
    Average(mesh, all, reached, field.Displacements);
  }
}

} // namespace FlipFree

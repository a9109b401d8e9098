#include "Deformation/DisplacementDiffusion.h"

#include <algorithm>
#include <vector>

namespace FlipFree
{
namespace
{

class Averaging
{
public:
  Averaging(const ContourMesh& mesh, PointList& displacements)
    : Mesh(mesh)
    , Displacements(displacements)
    , Known(mesh.NumberOfPoints())
  {
  }

  // One pass. A vertex that no displacement has reached yet does not count as one that wants to
  // rest: only known neighbors take part.
  void Average(const std::vector<int>& vertices)
  {
    this->Averages.resize(vertices.size());
    for (std::size_t position = 0; position < vertices.size(); ++position)
    {
      this->Averages[position] = this->AverageAround(vertices[position]);
    }
    for (std::size_t position = 0; position < vertices.size(); ++position)
    {
      const int vertex = vertices[position];
      this->Displacements.row(vertex) = this->Averages[position].head<3>();
      this->Known[vertex] = this->Averages[position][3] > 0;
    }
  }

  void SetKnown(int vertex) { this->Known[vertex] = 1; }

private:
  // The mean of the known ones around a vertex, itself among them, and their number.
  Eigen::RowVector4d AverageAround(int vertex) const
  {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    int count = 0;
    const auto add = [&](int member)
    {
      if (this->Known[member])
      {
        sum += this->Displacements.row(member);
        ++count;
      }
    };
    add(vertex);
    for (int neighbor : this->Mesh.Neighbors[vertex])
    {
      add(neighbor);
    }
    Eigen::RowVector4d average;
    average << sum / std::max(1, count), count;
    return average;
  }

  const ContourMesh& Mesh;
  PointList& Displacements;
  std::vector<char> Known;
  std::vector<Eigen::RowVector4d> Averages;
};

} // namespace

void DiffuseDisplacements(const ContourMesh& mesh, const DiffusionSettings& settings,
  CorrespondenceField& field)
{
  Averaging averaging(mesh, field.Displacements);
  std::vector<int> solitary;
  std::vector<int> all(mesh.NumberOfPoints());
  for (int vertex = 0; vertex < mesh.NumberOfPoints(); ++vertex)
  {
    all[vertex] = vertex;
    if (field.States[vertex] == VertexState::Solitary)
    {
      solitary.push_back(vertex);
    }
    else
    {
      averaging.SetKnown(vertex);
    }
  }
  for (int pass = 0; pass < settings.Iterations && !solitary.empty(); ++pass)
  {
    averaging.Average(solitary);
  }
  for (int pass = 0; pass < settings.SmoothingIterations; ++pass)
  {
    averaging.Average(all);
  }
}

} // namespace FlipFree

#include "Deformation/MobileComponents.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{

MobileComponents::MobileComponents(Eigen::VectorXd mobility)
  : Mobility(std::move(mobility))
{
}

void MobileComponents::BeginLevel(const ContourMesh& mesh)
{
  this->Components.clear();
  std::vector<bool> visited(this->Mobility.size(), false);
  const auto isNew = [&](int vertex) { return !visited[vertex] && this->Mobility[vertex] > 0; };
  for (int first = 0; first < this->Mobility.size(); ++first)
  {
    if (!isNew(first))
    {
      continue;
    }
    visited[first] = true;
    std::vector<int> vertices{ first };
    for (std::size_t next = 0; next < vertices.size(); ++next)
    {
      for (const int neighbor : mesh.Neighbors[vertices[next]])
      {
        if (isNew(neighbor))
        {
          visited[neighbor] = true;
          vertices.push_back(neighbor);
        }
      }
    }
    this->Components.push_back({ std::move(vertices), {}, false });
  }
}

double MobileComponents::MeasureDistances(const CorrespondenceField& field)
{
  double sumOfAll = 0;
  double countOfAll = 0;
  for (Component& component : this->Components)
  {
    double sum = 0;
    double count = 0;
    for (const int vertex : component.Vertices)
    {
      if (field.States[vertex] != VertexState::Solitary)
      {
        sum += this->Mobility[vertex] * field.Displacements.row(vertex).norm();
        count += this->Mobility[vertex];
      }
    }
    component.Distances.push_back(count > 0 ? sum / count : 0);
    sumOfAll += sum;
    countOfAll += count;
  }
  return countOfAll > 0 ? sumOfAll / countOfAll : 0;
}

void MobileComponents::Restrict(PointList& motion) const
{
  motion = this->Mobility.asDiagonal() * motion;
  for (const Component& component : this->Components)
  {
    if (component.IsAtRest)
    {
      for (const int vertex : component.Vertices)
      {
        motion.row(vertex).setZero();
      }
    }
  }
}

void MobileComponents::FindThoseAtRest(const ScheduleSettings& schedule, double voxel)
{
  for (Component& component : this->Components)
  {
    component.IsAtRest =
      component.IsAtRest || schedule.ReasonToStop(component.Distances, voxel) != StopReason::NotRun;
  }
}

bool MobileComponents::AreAllAtRest() const
{
  return std::all_of(this->Components.begin(), this->Components.end(),
    [](const Component& component) { return component.IsAtRest; });
}

void MobileComponents::FreePulled(const PointList& from, const PointList& to, double voxel)
{
  for (Eigen::Index vertex = 0; vertex < this->Mobility.size(); ++vertex)
  {
    const double pulled = (to.row(vertex) - from.row(vertex)).norm() / voxel;
    this->Mobility[vertex] = std::max(this->Mobility[vertex], std::min(1.0, 4 * pulled));
  }
}

} // namespace FlipFree

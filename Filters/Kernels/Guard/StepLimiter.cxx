#include "Guard/StepLimiter.h"

#include "Guard/SinglePrecision.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Below this fraction of its displacement a vertex is not moved at all.
constexpr double MinimumScale = 1.0 / 64;

} // namespace

StepLimiter::StepLimiter(const PointList& points, const PointList& displacements,
  const std::vector<std::array<int, 4>>& neighbors, double maximumShear, double edgeLength)
  : From(points)
  , Neighbors(neighbors)
  , MaximumShear(maximumShear)
  , EdgeLength(edgeLength)
  , Wanted(displacements)
  , To(points.rows(), 3)
  , Scales(points.rows(), 1.0)
  , SafeTimes(points.rows())
{
  std::fill(this->SafeTimes.begin(), this->SafeTimes.end(), 1.0);
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    this->Place(vertex);
  }
}

void StepLimiter::Place(Eigen::Index vertex)
{
  const Eigen::RowVector3d from = this->From.row(vertex);
  const Eigen::RowVector3d displacement = this->Scales[vertex] * this->Wanted.row(vertex);
  this->To.row(vertex) =
    displacement.isZero(0) ? from : RoundToSingle(from + displacement, this->EdgeLength);
}

std::vector<int> StepLimiter::ScaleDown()
{
  std::vector<int> queue; // a vertex again whenever its scale is lowered
  for (int vertex = 0; vertex < static_cast<int>(this->Scales.size()); ++vertex)
  {
    const double time = this->SafeTimes[vertex];
    if (time < 1 && this->Scales[vertex] > 0)
    {
      const double scale = this->Scales[vertex] *
        std::max(MinimumFraction, std::min(MaximumFraction, SafetyFactor * time));
      this->Scales[vertex] = scale < MinimumScale ? 0 : scale;
      queue.push_back(vertex);
    }
    this->SafeTimes[vertex] = 1;
  }
  for (std::size_t head = 0; head < queue.size(); ++head)
  {
    const double scale = this->Scales[queue[head]];
    for (int neighbor : this->Neighbors[queue[head]])
    {
      const double limit = scale + this->MaximumShear / this->Wanted.row(neighbor).norm();
      if (this->Scales[neighbor] > limit)
      {
        this->Scales[neighbor] = limit;
        queue.push_back(neighbor);
      }
    }
  }
  std::sort(queue.begin(), queue.end());
  queue.erase(std::unique(queue.begin(), queue.end()), queue.end());
  for (int vertex : queue)
  {
    this->Place(vertex);
  }
  this->NothingFailed = true;
  return queue;
}

} // namespace FlipFree

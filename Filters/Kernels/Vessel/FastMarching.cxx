#include "Vessel/FastMarching.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr float Never = std::numeric_limits<float>::infinity();
constexpr std::size_t VoxelsBetweenQuestions = 1 << 16;

class Front
{
public:
  Front(const ImageView<float>& speed, std::vector<float>& times)
    : Speed(speed)
    , Times(times)
    , Final(times.size(), 0)
    , Strides(StepsOf(speed.Geometry))
  {
  }

  void Start(std::size_t voxel)
  {
    this->Times[voxel] = 0;
    this->Trial.emplace(0.0F, voxel);
  }

  bool IsEmpty() const { return this->Trial.empty(); }

  /// Makes the earliest trial voxel final; false if it was already.
  bool Accept(std::size_t& voxel)
  {
    voxel = this->Trial.top().second;
    this->Trial.pop();
    if (this->Final[voxel])
    {
      return false;
    }
    this->Final[voxel] = 1;
    return true;
  }

  void UpdateNeighbors(std::size_t voxel)
  {
    const std::array<int, 3> place = IndexOf(voxel, this->Speed.Geometry);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int side : { -1, 1 })
      {
        std::array<int, 3> neighbor = place;
        neighbor[axis] += side;
        if (neighbor[axis] >= 0 && neighbor[axis] < this->Speed.Geometry.Dimensions[axis])
        {
          this->Update(voxel + side * this->Strides[axis], neighbor);
        }
      }
    }
  }

private:
  void Update(std::size_t voxel, const std::array<int, 3>& place)
  {
    const double speed = this->Speed.Data[voxel];
    if (this->Final[voxel] || !(speed > 0))
    {
      return;
    }
    const auto time = static_cast<float>(this->Solve(voxel, place, 1 / speed));
    if (time < this->Times[voxel])
    {
      this->Times[voxel] = time;
      this->Trial.emplace(time, voxel);
    }
  }

  // The quadratic of the axes whose earlier neighbors come before the solution.
  double Solve(std::size_t voxel, const std::array<int, 3>& place, double slowness) const
  {
    Eigen::Array3d before;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double back = place[axis] > 0 ? this->FinalTime(voxel - this->Strides[axis]) : Never;
      const bool isLast = place[axis] + 1 == this->Speed.Geometry.Dimensions[axis];
      const double ahead = isLast ? Never : this->FinalTime(voxel + this->Strides[axis]);
      before[axis] = std::min(back, ahead);
    }
    double a = 0;
    double b = 0;
    double c = -slowness * slowness;
    double time = Never;
    for (int count = 0; count < 3; ++count)
    {
      Eigen::Index axis = 0;
      const double earliest = before.minCoeff(&axis);
      if (!(earliest < time))
      {
        break;
      }
      before[axis] = Never;
      const double spacing = this->Speed.Geometry.Spacing[axis];
      const double weight = 1 / (spacing * spacing);
      a += weight;
      b += weight * earliest;
      c += weight * earliest * earliest;
      time = (b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
    }
    return time;
  }

  double FinalTime(std::size_t voxel) const
  {
    return this->Final[voxel] ? this->Times[voxel] : Never;
  }

  // Equal times by the voxel's place.
  using Entry = std::pair<float, std::size_t>;

  const ImageView<float>& Speed;
  std::vector<float>& Times;
  std::vector<char> Final;
  std::array<std::ptrdiff_t, 3> Strides;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> Trial;
};

} // namespace

Arrivals MarchFront(const ImageView<float>& speed, const std::vector<std::size_t>& sources,
  const std::vector<std::size_t>& targets, std::size_t count, const Monitor& monitor)
{
  Arrivals arrivals;
  arrivals.Times.assign(speed.Geometry.NumberOfVoxels(), Never);
  std::vector<char> isTarget(arrivals.Times.size(), 0);
  for (const std::size_t target : targets)
  {
    isTarget[target] = 1;
  }
  Front front(speed, arrivals.Times);
  for (const std::size_t source : sources)
  {
    front.Start(source);
  }
  std::size_t accepted = 0;
  while (!front.IsEmpty() && arrivals.Reached.size() < count)
  {
    std::size_t voxel = 0;
    if (!front.Accept(voxel))
    {
      continue;
    }
    if (++accepted % VoxelsBetweenQuestions == 0 &&
      !monitor(static_cast<double>(accepted) / static_cast<double>(arrivals.Times.size())))
    {
      arrivals.Reached.clear();
      return arrivals;
    }
    if (isTarget[voxel])
    {
      arrivals.Reached.push_back(voxel);
    }
    front.UpdateNeighbors(voxel);
  }
  return arrivals;
}

std::vector<std::size_t> DescendToSource(const Arrivals& arrivals, const ImageGeometry& geometry,
  std::size_t target)
{
  std::vector<std::size_t> path{ target };
  const auto& times = arrivals.Times;
  for (std::size_t voxel = target; times[voxel] > 0;)
  {
    const std::array<int, 3> place = IndexOf(voxel, geometry);
    double steepest = 0;
    std::size_t next = voxel;
    for (int code = 0; code < 27; ++code)
    {
      const int step[3] = { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 };
      if (code == 13 ||
        !geometry.Contains(place[0] + step[0], place[1] + step[1], place[2] + step[2]))
      {
        continue;
      }
      const std::size_t neighbor =
        geometry.Offset(place[0] + step[0], place[1] + step[1], place[2] + step[2]);
      const double length =
        geometry.Spacing.cwiseProduct(Eigen::Vector3d(step[0], step[1], step[2])).norm();
      const double slope = (times[voxel] - times[neighbor]) / length;
      if (slope > steepest)
      {
        steepest = slope;
        next = neighbor;
      }
    }
    if (next == voxel)
    {
      break; // equal times by rounding; the front came from nowhere else
    }
    path.push_back(next);
    voxel = next;
  }
  return path;
}

} // namespace FlipFree

#include "Vessel/FastMarching.h"

#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr float Never = std::numeric_limits<float>::infinity();
constexpr std::size_t VoxelsBetweenQuestions = 1 << 16;

// A voxel's speed and time side by side, since they are read together, and around the image a layer
// of voxels that cannot be entered, so that no voxel needs to know where it is.
class Front
{
public:
  explicit Front(const ImageView<float>& speed)
    : Size(speed.Geometry.Dimensions)
    , Row(this->Size[0] + 2)
    , Slice(this->Row * (this->Size[1] + 2))
    , Cells(this->Slice * (this->Size[2] + 2))
  {
    const Eigen::Vector3d& spacing = speed.Geometry.Spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Weights[axis] = 1 / (spacing[axis] * spacing[axis]);
    }
    this->ForEachRow(
      [&](std::size_t voxel, std::size_t cell)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          this->Cells[cell + i].Speed = std::max(0.0F, speed.Data[voxel + i]);
        }
      });
  }

  std::size_t CellOf(std::size_t voxel) const
  {
    const std::size_t row = this->Size[0];
    const std::size_t rows = this->Size[1];
    return voxel % row + 1 + this->Row * (voxel / row % rows + 1) +
      this->Slice * (voxel / row / rows + 1);
  }

  void Start(std::size_t cell)
  {
    this->Cells[cell].Speed = 1; // it may be a wall
    this->Arrive(0, cell);
  }

  /// Makes cells final in the order of their times, and calls visit(cell) for each before the front
  /// spreads from there, as long as goesOn(time of the next). Returns false if the monitor, asked
  /// now and then, stopped it.
  template <typename GoesOn, typename Visit>
  bool March(const GoesOn& goesOn, const Visit& visit, const Monitor& monitor)
  {
    const auto voxels =
      static_cast<double>(static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2]);
    std::size_t accepted = 0;
    while (!this->Trial.empty() && goesOn(this->EarliestTime()))
    {
      std::size_t cell = 0;
      if (!this->Accept(cell))
      {
        continue;
      }
      if (++accepted % VoxelsBetweenQuestions == 0 &&
        !monitor(static_cast<double>(accepted) / voxels))
      {
        return false;
      }
      visit(cell);
      this->UpdateNeighbors(cell);
    }
    return true;
  }

  /// From now on, cells remember from which source they were reached.
  void KeepOwners() { this->Owners.assign(this->Cells.size(), -1); }

  void StartAs(int owner, std::size_t cell)
  {
    this->Owners[cell] = owner;
    this->Start(cell);
  }

  /// Gives a cell that has just become final the owner of its earliest final neighbor.
  void Own(std::size_t cell)
  {
    float earliest = this->Cells[cell].Time > 0 ? Never : 0; // a source owns itself
    this->ForEachFinalNeighbor(cell,
      [&](std::size_t neighbor, double)
      {
        if (this->Cells[neighbor].Time < earliest)
        {
          earliest = this->Cells[neighbor].Time;
          this->Owners[cell] = this->Owners[neighbor];
        }
      });
  }

  /// Calls visit(neighbor, time from source to source) for each final neighbor of another owner.
  template <typename Visit>
  void ForEachMeeting(std::size_t cell, const Visit& visit) const
  {
    this->ForEachFinalNeighbor(cell,
      [&](std::size_t neighbor, double distance)
      {
        if (this->Owners[neighbor] != this->Owners[cell])
        {
          const Cell& here = this->Cells[cell];
          const Cell& there = this->Cells[neighbor];
          visit(neighbor,
            double(here.Time) + there.Time -
              0.5 * distance * (1.0 / here.Speed + 1.0 / there.Speed));
        }
      });
  }

  std::size_t VoxelOf(std::size_t cell) const
  {
    const std::size_t i = cell % this->Row - 1;
    const std::size_t j = cell % this->Slice / this->Row - 1;
    const std::size_t k = cell / this->Slice - 1;
    return i + this->Size[0] * (j + this->Size[1] * k);
  }

  std::vector<int> TakeOwners() const
  {
    std::vector<int> owners(
      static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2]);
    this->ForEachRow([&](std::size_t voxel, std::size_t cell)
      { std::copy_n(this->Owners.begin() + cell, this->Size[0], owners.begin() + voxel); });
    return owners;
  }

  std::vector<float> TakeTimes()
  {
    std::vector<float> times(
      static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2]);
    this->ForEachRow(
      [&](std::size_t voxel, std::size_t cell)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          times[voxel + i] = this->Cells[cell + i].Time;
        }
      });
    return times;
  }

private:
  struct Cell
  {
    float Speed = 0; // 0: a wall; negative: its time is final
    float Time = Never;
  };

  float EarliestTime() const
  {
    const auto bits = static_cast<std::uint32_t>(this->Trial.top() >> 32U);
    float time = 0;
    std::memcpy(&time, &bits, sizeof(time));
    return time;
  }

  // Makes the earliest trial cell final; false if it was already.
  bool Accept(std::size_t& cell)
  {
    cell = this->Trial.top() & 0xFFFFFFFFU;
    this->Trial.pop();
    if (!(this->Cells[cell].Speed > 0))
    {
      return false;
    }
    this->Cells[cell].Speed = -this->Cells[cell].Speed;
    return true;
  }

  void UpdateNeighbors(std::size_t cell)
  {
    for (const std::size_t step : { std::size_t(1), this->Row, this->Slice })
    {
      this->Update(cell - step);
      this->Update(cell + step);
    }
  }

  // Calls visit(first voxel, its cell).
  template <typename Visit>
  void ForEachRow(const Visit& visit) const
  {
    std::size_t voxel = 0;
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        visit(voxel, 1 + this->Row * (j + 1) + this->Slice * (k + 1));
        voxel += this->Size[0];
      }
    }
  }

  // Calls visit(neighbor, distance).
  template <typename Visit>
  void ForEachFinalNeighbor(std::size_t cell, const Visit& visit) const
  {
    const std::array<std::size_t, 3> steps{ { 1, this->Row, this->Slice } };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const std::size_t neighbor : { cell - steps[axis], cell + steps[axis] })
      {
        if (this->Cells[neighbor].Speed < 0)
        {
          visit(neighbor, 1 / std::sqrt(this->Weights[axis]));
        }
      }
    }
  }

  // Times are not negative, so that they are ordered as their bits; equal ones by the place.
  void Arrive(float time, std::size_t cell)
  {
    this->Cells[cell].Time = time;
    std::uint32_t bits = 0;
    std::memcpy(&bits, &time, sizeof(bits));
    this->Trial.push(std::uint64_t(bits) << 32U | cell);
  }

  void Update(std::size_t cell)
  {
    const double speed = this->Cells[cell].Speed;
    if (!(speed > 0))
    {
      return;
    }
    const auto time = static_cast<float>(this->Solve(cell, 1 / speed));
    if (time < this->Cells[cell].Time)
    {
      this->Arrive(time, cell);
    }
  }

  // The quadratic of the axes whose earlier neighbors come before the solution.
  double Solve(std::size_t cell, double slowness) const
  {
    std::array<double, 3> before{ { this->FinalTimeBeside(cell, 1),
      this->FinalTimeBeside(cell, this->Row), this->FinalTimeBeside(cell, this->Slice) } };
    double a = 0;
    double b = 0;
    double c = -slowness * slowness;
    double time = Never;
    for (int count = 0; count < 3; ++count)
    {
      int axis = before[1] < before[0] ? 1 : 0;
      axis = before[2] < before[axis] ? 2 : axis;
      const double earliest = before[axis];
      if (!(earliest < time))
      {
        break;
      }
      before[axis] = Never;
      const double weight = this->Weights[axis];
      a += weight;
      b += weight * earliest;
      c += weight * earliest * earliest;
      time = (b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
    }
    return time;
  }

  // The earlier one of the two neighbors along an axis.
  float FinalTimeBeside(std::size_t cell, std::size_t step) const
  {
    return std::min(this->FinalTime(cell - step), this->FinalTime(cell + step));
  }

  float FinalTime(std::size_t cell) const
  {
    return this->Cells[cell].Speed > 0 ? Never : this->Cells[cell].Time;
  }

  const std::array<int, 3> Size;
  const std::size_t Row;
  const std::size_t Slice;
  std::vector<Cell> Cells;
  std::vector<int> Owners; // where they are kept
  std::array<double, 3> Weights{};
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> Trial;
};

} // namespace

Arrivals MarchFront(const ImageView<float>& speed, const std::vector<std::size_t>& sources,
  const std::vector<std::size_t>& targets, std::size_t count, float latest, const Monitor& monitor)
{
  Front front(speed);
  for (const std::size_t source : sources)
  {
    front.Start(front.CellOf(source));
  }
  std::vector<std::pair<std::size_t, std::size_t>> cells; // of the targets
  cells.reserve(targets.size());
  for (const std::size_t target : targets)
  {
    cells.emplace_back(front.CellOf(target), target);
  }
  std::sort(cells.begin(), cells.end());
  Arrivals arrivals;
  const auto goesOn = [&](float earliest)
  { return arrivals.Reached.size() < count && earliest < latest; };
  const auto visit = [&](std::size_t cell)
  {
    const auto target =
      std::lower_bound(cells.begin(), cells.end(), std::pair(cell, std::size_t(0)));
    if (target != cells.end() && target->first == cell)
    {
      arrivals.Reached.push_back(target->second);
    }
  };
  if (!front.March(goesOn, visit, monitor))
  {
    arrivals.Reached.clear();
  }
  arrivals.Times = front.TakeTimes();
  return arrivals;
}

Meeting MeetFronts(const ImageView<float>& speed, const std::vector<std::size_t>& sources,
  const Monitor& monitor)
{
  Front front(speed);
  front.KeepOwners();
  for (std::size_t source = 0; source < sources.size(); ++source)
  {
    front.StartAs(static_cast<int>(source), front.CellOf(sources[source]));
  }
  double least = Never;
  std::pair<std::size_t, std::size_t> cells;
  // Two fronts that meet later need longer.
  const auto goesOn = [&](float earliest) { return 2 * double(earliest) < least; };
  const auto visit = [&](std::size_t cell)
  {
    front.Own(cell);
    front.ForEachMeeting(cell,
      [&](std::size_t neighbor, double time)
      {
        const auto pair = std::minmax(cell, neighbor);
        if (std::pair(time, std::pair<std::size_t, std::size_t>(pair)) < std::pair(least, cells))
        {
          least = time;
          cells = pair;
        }
      });
  };
  Meeting meeting;
  if (front.March(goesOn, visit, monitor) && least < Never)
  {
    meeting.Times.Times = front.TakeTimes();
    meeting.Times.Owners = front.TakeOwners();
    meeting.Voxels = { front.VoxelOf(cells.first), front.VoxelOf(cells.second) };
  }
  return meeting;
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
      const bool isOwn =
        arrivals.Owners.empty() || arrivals.Owners[voxel] == arrivals.Owners[neighbor];
      if (isOwn && slope > steepest)
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

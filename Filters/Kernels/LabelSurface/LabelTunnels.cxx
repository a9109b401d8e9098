#include "LabelSurface/LabelTunnels.h"

#include "Image/DistanceTransform.h"
#include "Image/VoxelOffsets.h"
#include "LabelSurface/LabelParts.h"
#include "LabelSurface/SimpleVoxel.h"

#include <queue>

namespace FlipFree
{
namespace
{

constexpr int Neighbors = 27; // with the voxel itself, numbered as in SimpleVoxel.h

std::array<int, 3> StepOf(int bit)
{
  return { { bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1 } };
}

bool IsAcrossFace(int bit)
{
  const std::array<int, 3> step = StepOf(bit);
  return std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) == 1;
}

// The first and the last voxel of a part along each axis.
struct Bounds
{
  std::array<int, 3> Low{ { std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
    std::numeric_limits<int>::max() } };
  std::array<int, 3> High{ { 0, 0, 0 } };
};

std::vector<Bounds> BoundsOf(const LabelParts& parts)
{
  std::vector<Bounds> bounds(parts.Parts.size());
  for (std::size_t row = 0; row + 1 < parts.RowBegin.size(); ++row)
  {
    const int j = static_cast<int>(row % parts.Size[1]);
    const int k = static_cast<int>(row / parts.Size[1]);
    for (std::size_t run = parts.RowBegin[row]; run < parts.RowBegin[row + 1]; ++run)
    {
      Bounds& it = bounds[parts.Runs[run].Part];
      const int first = parts.Runs[run].Begin;
      it.Low = { { std::min(it.Low[0], first), std::min(it.Low[1], j), std::min(it.Low[2], k) } };
      it.High = { { std::max(it.High[0], parts.EndOf(run, row) - 1), std::max(it.High[1], j),
        std::max(it.High[2], k) } };
    }
  }
  return bounds;
}

// The box around a part, with a layer all around that stays empty.
class PartBox
{
public:
  PartBox(const LabelParts& parts, int part, const Bounds& bounds, const Eigen::Vector3d& spacing)
    : Low{ { bounds.Low[0] - 1, bounds.Low[1] - 1, bounds.Low[2] - 1 } }
  {
    this->Geometry.Spacing = spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Geometry.Dimensions[axis] = bounds.High[axis] - bounds.Low[axis] + 3;
    }
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), Beyond);
    for (int bit = 0; bit < Neighbors; ++bit)
    {
      const std::array<int, 3> step = StepOf(bit);
      this->Steps[bit] = step[0] +
        static_cast<std::ptrdiff_t>(this->Geometry.Dimensions[0]) *
          (step[1] + static_cast<std::ptrdiff_t>(this->Geometry.Dimensions[1]) * step[2]);
    }
    this->ForEachInside(
      [this](std::size_t voxel, bool /*isOnBorder*/) { this->Voxels[voxel] = Filled; });
    for (int k = bounds.Low[2]; k <= bounds.High[2]; ++k)
    {
      for (int j = bounds.Low[1]; j <= bounds.High[1]; ++j)
      {
        const std::size_t row = j + static_cast<std::size_t>(parts.Size[1]) * k;
        for (std::size_t run = parts.RowBegin[row]; run < parts.RowBegin[row + 1]; ++run)
        {
          if (parts.Runs[run].Part == part)
          {
            const int begin = parts.Runs[run].Begin;
            const auto first = this->Voxels.begin() +
              static_cast<std::ptrdiff_t>(
                this->Geometry.Offset(begin - this->Low[0], j - this->Low[1], k - this->Low[2]));
            std::fill_n(first, parts.EndOf(run, row) - begin, Filled | OfPart);
          }
        }
      }
    }
  }

  // False if the monitor stopped it.
  bool Peel(const ParallelFor& parallelFor, const Monitor& monitor)
  {
    std::vector<unsigned char> part(this->Voxels.size());
    std::transform(this->Voxels.begin(), this->Voxels.end(), part.begin(),
      [](unsigned char voxel) { return (voxel & OfPart) != 0 ? 1 : 0; });
    this->Distances = SquaredDistance(part, this->Geometry, 1, parallelFor, monitor);
    if (this->Distances.empty())
    {
      return false;
    }
    this->ForEachInside(
      [this](std::size_t voxel, bool isOnBorder)
      {
        if (isOnBorder)
        {
          this->LetWait(voxel);
        }
      });
    std::size_t steps = 0;
    while (!this->Front.empty())
    {
      constexpr std::size_t StepsBetweenQuestions = 1 << 14;
      if (++steps % StepsBetweenQuestions == 0 && !monitor(0.5))
      {
        return false;
      }
      const std::size_t voxel = this->Front.top().Voxel;
      this->Front.pop();
      this->Voxels[voxel] &= ~Waits;
      if (IsSimpleAcrossFaces(this->NeighborsOf(voxel)))
      {
        this->Voxels[voxel] &= ~Filled;
        for (const std::ptrdiff_t step : this->Steps)
        {
          this->LetWait(voxel + step);
        }
      }
    }
    return true;
  }

  // After Peel(): calls visit(places, squaredDistance) for each sheet across a tunnel, with its
  // voxels in the grid and the greatest distance from the part.
  template <typename Visit>
  void VisitSheets(const Visit& visit)
  {
    this->ForEachInside(
      [this](std::size_t voxel, bool isOnBorder)
      {
        if (isOnBorder)
        {
          this->Flood(voxel, false,
            [this](std::size_t it)
            { return this->Mark(it, OfPart | Beyond | Outside, 0, Outside); });
        }
      });
    std::vector<std::array<int, 3>> places;
    this->ForEachInside(
      [&](std::size_t voxel, bool /*isOnBorder*/)
      {
        float farthest = 0;
        places.clear();
        this->Flood(voxel, true,
          [&](std::size_t it)
          {
            if (!this->Mark(it, Filled | Outside | Seen, Filled | Outside, Seen))
            {
              return false;
            }
            farthest = std::max(farthest, this->Distances[it]);
            const std::array<int, 3> place = IndexOf(it, this->Geometry);
            places.push_back(
              { { place[0] + this->Low[0], place[1] + this->Low[1], place[2] + this->Low[2] } });
            return true;
          });
        if (!places.empty())
        {
          visit(places, farthest);
        }
      });
  }

private:
  // What is said of a voxel.
  static constexpr unsigned char OfPart = 1;
  static constexpr unsigned char Filled = 2; // not taken away
  static constexpr unsigned char Waits = 4;
  static constexpr unsigned char Beyond = 8;   // the box
  static constexpr unsigned char Outside = 16; // of the part, and not in a cavity
  static constexpr unsigned char Seen = 32;    // as one of a sheet

  struct Candidate
  {
    float Distance;
    std::size_t Voxel;

    // The farthest first; of several, the first.
    bool operator<(const Candidate& other) const
    {
      return this->Distance != other.Distance ? this->Distance < other.Distance
                                              : this->Voxel > other.Voxel;
    }
  };

  // Calls visit(voxel, isOnBorder), the border being that of the box.
  template <typename Visit>
  void ForEachInside(const Visit& visit) const
  {
    const auto isFirstOrLast = [this](int place, int axis)
    { return place == 1 || place + 2 == this->Geometry.Dimensions[axis]; };
    for (int k = 1; k + 1 < this->Geometry.Dimensions[2]; ++k)
    {
      for (int j = 1; j + 1 < this->Geometry.Dimensions[1]; ++j)
      {
        for (int i = 1; i + 1 < this->Geometry.Dimensions[0]; ++i)
        {
          visit(this->Geometry.Offset(i, j, k),
            isFirstOrLast(i, 0) || isFirstOrLast(j, 1) || isFirstOrLast(k, 2));
        }
      }
    }
  }

  unsigned int NeighborsOf(std::size_t voxel) const
  {
    unsigned int set = 0;
    for (int bit = 0; bit < Neighbors; ++bit)
    {
      set |= (this->Voxels[voxel + this->Steps[bit]] & Filled) != 0 ? 1U << bit : 0;
    }
    return set & ~CenterVoxel;
  }

  // Sets a bit of a voxel if the bits in `mask` are `wanted`.
  bool Mark(std::size_t voxel, unsigned char mask, unsigned char wanted, unsigned char bit)
  {
    if ((this->Voxels[voxel] & mask) != wanted)
    {
      return false;
    }
    this->Voxels[voxel] |= bit;
    return true;
  }

  void LetWait(std::size_t voxel)
  {
    if (this->Mark(voxel, Filled | OfPart | Waits, Filled, Waits))
    {
      this->Front.push({ this->Distances[voxel], voxel });
    }
  }

  // From a voxel to all that are connected, as long as take(voxel) is true: once for each.
  template <typename Take>
  void Flood(std::size_t start, bool acrossFaces, const Take& take)
  {
    if (!take(start))
    {
      return;
    }
    std::vector<std::size_t> front{ start };
    while (!front.empty())
    {
      const std::size_t voxel = front.back();
      front.pop_back();
      for (int bit = 0; bit < Neighbors; ++bit)
      {
        if ((!acrossFaces || IsAcrossFace(bit)) && take(voxel + this->Steps[bit]))
        {
          front.push_back(voxel + this->Steps[bit]);
        }
      }
    }
  }

  std::array<int, 3> Low;
  ImageGeometry Geometry;
  std::vector<unsigned char> Voxels;
  std::vector<float> Distances;
  std::array<std::ptrdiff_t, Neighbors> Steps{};
  std::priority_queue<Candidate> Front;
};

} // namespace

bool CloseTunnels(LabelGrid& grid, const Eigen::Vector3d& spacing, double width,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  if (width <= 0)
  {
    return true;
  }
  constexpr std::size_t LeastAround = 8; // voxels around the narrowest tunnel
  const LabelParts parts(grid, LabelCells(grid, parallelFor));
  const std::vector<Bounds> bounds = BoundsOf(parts);
  for (std::size_t part = 1; part < parts.Parts.size(); ++part) // the first is the outside
  {
    const Monitor partMonitor =
      PartOf(monitor, static_cast<double>(part) / static_cast<double>(parts.Parts.size()),
        static_cast<double>(part + 1) / static_cast<double>(parts.Parts.size()));
    const int label = parts.Parts[part].Label;
    if (label == 0 || parts.Parts[part].Voxels < LeastAround)
    {
      continue;
    }
    PartBox box(parts, static_cast<int>(part), bounds[part], spacing);
    if (!box.Peel(parallelFor, partMonitor))
    {
      return false;
    }
    box.VisitSheets(
      [&](const std::vector<std::array<int, 3>>& places, float squaredDistance)
      {
        // From the middle of a voxel to that of the nearest one of the part.
        const bool isNarrow = 2 * std::sqrt(squaredDistance) - spacing.minCoeff() < width;
        const auto isFree = [&grid](const std::array<int, 3>& place)
        { return grid.Labels[grid.Offset(place[0], place[1], place[2])] == 0; };
        if (isNarrow && std::all_of(places.begin(), places.end(), isFree))
        {
          for (const std::array<int, 3>& place : places)
          {
            grid.Labels[grid.Offset(place[0], place[1], place[2])] =
              static_cast<LabelGrid::Index>(label);
          }
        }
      });
  }
  return true;
}

} // namespace FlipFree

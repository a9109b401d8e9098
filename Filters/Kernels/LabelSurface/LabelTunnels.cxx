#include "LabelSurface/LabelTunnels.h"

#include "Image/DistanceTransform.h"
#include "Image/VoxelBox.h"
#include "Image/VoxelOffsets.h"
#include "LabelSurface/LabelParts.h"
#include "LabelSurface/SimpleVoxel.h"
#include "LabelSurface/WallTriangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

namespace FlipFree
{
namespace
{

constexpr int Neighbors = 27; // with the voxel itself, numbered as in SimpleVoxel.h

std::array<int, 3> StepOf(int bit)
{
  return { { bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1 } };
}

std::vector<VoxelBox> BoxesOf(const LabelParts& parts)
{
  std::vector<VoxelBox> boxes(parts.Parts.size());
  for (std::size_t row = 0; row + 1 < parts.RowBegin.size(); ++row)
  {
    const int j = static_cast<int>(row % parts.Size[1]);
    const int k = static_cast<int>(row / parts.Size[1]);
    for (std::size_t run = parts.RowBegin[row]; run < parts.RowBegin[row + 1]; ++run)
    {
      VoxelBox& box = boxes[parts.Runs[run].Part];
      box = box.Joined(
        { { { parts.Runs[run].Begin, j, k } }, { { parts.EndOf(run, row), j + 1, k + 1 } } });
    }
  }
  return boxes;
}

// Asks a monitor now and then, and tells it how much is done of what there is to do.
class Work
{
public:
  Work(const Monitor& monitor, double all)
    : Ask(monitor)
    , All(all)
  {
  }

  // False once the monitor has stopped it.
  bool Do(double part)
  {
    constexpr double BetweenQuestions = 1 << 14;
    this->Done += part;
    if (this->Done >= this->Asked + BetweenQuestions)
    {
      this->Asked = this->Done;
      this->Goes = this->Goes && this->Ask(std::min(1.0, this->Done / this->All));
    }
    return this->Goes;
  }

private:
  const Monitor& Ask;
  const double All;
  double Done = 0;
  double Asked = 0;
  bool Goes = true;
};

using Places = std::vector<std::array<int, 3>>; // of voxels in the grid

// The box around a part, with a layer all around that stays empty. What returns false was stopped.
class PartBox
{
public:
  // How many steps the work on a box of so many voxels has at most, as a guess.
  static constexpr double StepsPerVoxel = 3;

  PartBox(const VoxelBox& box, const Eigen::Vector3d& spacing)
    : Low{ { box.Begin[0] - 1, box.Begin[1] - 1, box.Begin[2] - 1 } }
  {
    this->Geometry.Spacing = spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Geometry.Dimensions[axis] = box.Size(axis) + 2;
    }
    for (int bit = 0; bit < Neighbors; ++bit)
    {
      const std::array<int, 3> step = StepOf(bit);
      this->Steps[bit] = step[0] +
        static_cast<std::ptrdiff_t>(this->Geometry.Dimensions[0]) *
          (step[1] + static_cast<std::ptrdiff_t>(this->Geometry.Dimensions[1]) * step[2]);
    }
  }

  bool Fill(const LabelParts& parts, int part, Work& work)
  {
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), 0);
    const std::array<int, 3>& size = this->Geometry.Dimensions;
    for (int k = 1; k + 1 < size[2]; ++k)
    {
      for (int j = 1; j + 1 < size[1]; ++j)
      {
        std::fill_n(this->RowAt(j, k) + 1, size[0] - 2, Filled);
        const std::size_t row = this->Low[1] + j +
          static_cast<std::size_t>(parts.Size[1]) * static_cast<std::size_t>(this->Low[2] + k);
        for (std::size_t run = parts.RowBegin[row]; run < parts.RowBegin[row + 1]; ++run)
        {
          if (parts.Runs[run].Part == part)
          {
            const int begin = parts.Runs[run].Begin;
            std::fill_n(this->RowAt(j, k) + begin - this->Low[0], parts.EndOf(run, row) - begin,
              Filled | OfPart);
          }
        }
        if (!work.Do(size[0]))
        {
          return false;
        }
      }
    }
    return true;
  }

  bool Peel(const ParallelFor& parallelFor, Work& work)
  {
    {
      std::vector<unsigned char> part(this->Voxels.size());
      std::transform(this->Voxels.begin(), this->Voxels.end(), part.begin(),
        [](unsigned char voxel) { return static_cast<unsigned char>(voxel & OfPart); });
      this->Distances = SquaredDistance(part, this->Geometry, OfPart, parallelFor,
        [&work](double) { return work.Do(0); });
    }
    if (this->Distances.empty())
    {
      return false;
    }
    const bool proceeds = this->ForEachInside(work,
      [this](std::size_t voxel, bool isOnBorder)
      {
        if (isOnBorder)
        {
          this->LetWait(voxel);
        }
      });
    while (proceeds && !this->Front.empty())
    {
      if (!work.Do(1))
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
    return proceeds;
  }

  // After Peel(): calls visit(places, squaredDistance) for each sheet across a tunnel, with the
  // greatest distance of a voxel from the part.
  template <typename Visit>
  bool VisitSheets(Work& work, const Visit& visit)
  {
    Places places;
    return this->ForEachInside(work,
      [&](std::size_t voxel, bool /*isOnBorder*/)
      {
        if (!this->Mark(voxel, Filled | OfPart | Seen, Filled, Seen))
        {
          return;
        }
        places.clear();
        float farthest = 0;
        bool isBesideEmpty = false; // which no voxel of a cavity is
        std::vector<std::size_t> front{ voxel };
        while (!front.empty())
        {
          const std::size_t it = front.back();
          front.pop_back();
          places.push_back(this->PlaceOf(it));
          farthest = std::max(farthest, this->Distances[it]);
          for (int bit = 0; bit < Neighbors; ++bit)
          {
            const std::size_t next = it + this->Steps[bit];
            isBesideEmpty = isBesideEmpty || (this->Voxels[next] & Filled) == 0;
            if (this->Mark(next, Filled | OfPart | Seen, Filled, Seen))
            {
              front.push_back(next);
            }
          }
        }
        if (isBesideEmpty)
        {
          visit(places, farthest);
        }
      });
  }

  // Of a voxel of the grid.
  bool IsOfPart(const std::array<int, 3>& place) const
  {
    std::array<int, 3> index;
    for (int axis = 0; axis < 3; ++axis)
    {
      index[axis] = place[axis] - this->Low[axis];
    }
    return this->Geometry.Contains(index[0], index[1], index[2]) &&
      (this->Voxels[this->Geometry.Offset(index[0], index[1], index[2])] & OfPart) != 0;
  }

private:
  // What is said of a voxel.
  static constexpr unsigned char OfPart = 1;
  static constexpr unsigned char Filled = 2; // not taken away
  static constexpr unsigned char Waits = 4;
  static constexpr unsigned char Seen = 8; // as one of a sheet

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

  unsigned char* RowAt(int j, int k) { return &this->Voxels[this->Geometry.Offset(0, j, k)]; }

  std::array<int, 3> PlaceOf(std::size_t voxel) const
  {
    std::array<int, 3> place = IndexOf(voxel, this->Geometry);
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] += this->Low[axis];
    }
    return place;
  }

  // Calls visit(voxel, isOnBorder), the border being that of the box.
  template <typename Visit>
  bool ForEachInside(Work& work, const Visit& visit)
  {
    const std::array<int, 3>& size = this->Geometry.Dimensions;
    const auto isFirstOrLast = [&size](int place, int axis)
    { return place == 1 || place + 2 == size[axis]; };
    for (int k = 1; k + 1 < size[2]; ++k)
    {
      for (int j = 1; j + 1 < size[1]; ++j)
      {
        for (int i = 1; i + 1 < size[0]; ++i)
        {
          visit(this->Geometry.Offset(i, j, k),
            isFirstOrLast(i, 0) || isFirstOrLast(j, 1) || isFirstOrLast(k, 2));
        }
        if (!work.Do(size[0]))
        {
          return false;
        }
      }
    }
    return true;
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

  std::array<int, 3> Low;
  ImageGeometry Geometry;
  std::vector<unsigned char> Voxels;
  std::vector<float> Distances;
  std::array<std::ptrdiff_t, Neighbors> Steps{};
  std::priority_queue<Candidate> Front;
};

// A label alone around a sheet, as far as the sheet changes its surface, and a voxel more.
LabelGrid SurroundingsOf(const Places& sheet, const LabelGrid& grid, int label)
{
  constexpr int Reach = 2;
  VoxelBox box;
  for (const auto& [i, j, k] : sheet)
  {
    box = box.Joined({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } });
  }
  LabelGrid around;
  around.Values = { 0, 1 };
  for (int axis = 0; axis < 3; ++axis)
  {
    around.First[axis] = box.Begin[axis] - Reach - 1;
    around.Size[axis] = box.Size(axis) + 2 * Reach + 2;
  }
  around.Labels.resize(static_cast<std::size_t>(around.Size[0]) * around.Size[1] * around.Size[2]);
  for (int k = 1; k + 1 < around.Size[2]; ++k)
  {
    for (int j = 1; j + 1 < around.Size[1]; ++j)
    {
      for (int i = 1; i + 1 < around.Size[0]; ++i)
      {
        around.Labels[around.Offset(i, j, k)] =
          grid.At(around.First[0] + i, around.First[1] + j, around.First[2] + k) == label ? 1 : 0;
      }
    }
  }
  return around;
}

int EulerNumberOf(const LabelGrid& grid)
{
  const LabelCells cells(grid, SerialFor);
  const LabelWalls walls(grid, cells, SerialFor);
  const SharedWalls surface = CutWalls(walls, cells,
    Displacements(walls.NumberOfVertices(), Eigen::Array4f::Zero()), nullptr, SerialFor);
  return static_cast<int>(surface.Points.rows() - surface.Triangles.rows() / 2);
}

// Where voxels of the label touch by an edge, its surface may have no tunnel although its voxels
// have.
bool ClosesTunnel(const Places& sheet, const LabelGrid& grid, int label)
{
  LabelGrid around = SurroundingsOf(sheet, grid, label);
  const int before = EulerNumberOf(around);
  for (const auto& [i, j, k] : sheet)
  {
    around.Labels[around.Offset(i - around.First[0], j - around.First[1], k - around.First[2])] = 1;
  }
  return EulerNumberOf(around) > before;
}

// Whether a sheet of background would join its part with another one of the label.
bool TouchesOtherPart(const Places& sheet, const PartBox& box, const LabelGrid& grid, int label)
{
  return std::any_of(sheet.begin(), sheet.end(),
    [&](const std::array<int, 3>& place)
    {
      for (int bit = 0; bit < Neighbors; ++bit)
      {
        const std::array<int, 3> step = StepOf(bit);
        const std::array<int, 3> next{ { place[0] + step[0], place[1] + step[1],
          place[2] + step[2] } };
        if (grid.At(next[0], next[1], next[2]) == label && !box.IsOfPart(next))
        {
          return true;
        }
      }
      return false;
    });
}

} // namespace

bool CloseTunnels(LabelGrid& grid, const Eigen::Vector3d& spacing, double width,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  if (width <= 0)
  {
    return true;
  }
  constexpr std::size_t LeastAround = 6; // voxels around the narrowest tunnel
  const LabelParts parts(grid);
  const std::vector<VoxelBox> boxes = BoxesOf(parts);
  const auto mayHaveTunnels = [&parts](std::size_t part)
  { return parts.Parts[part].Label != 0 && parts.Parts[part].Voxels >= LeastAround; };
  double voxels = 1;
  for (std::size_t part = 0; part < boxes.size(); ++part)
  {
    const VoxelBox& box = boxes[part];
    voxels += mayHaveTunnels(part) ? 1.0 * box.Size(0) * box.Size(1) * box.Size(2) : 0;
  }
  Work work(monitor, PartBox::StepsPerVoxel * voxels);
  for (std::size_t part = 0; part < boxes.size(); ++part)
  {
    if (!mayHaveTunnels(part))
    {
      continue;
    }
    const int label = parts.Parts[part].Label;
    Places found;
    PartBox box(boxes[part], spacing);
    const auto take = [&](const Places& sheet, float squaredDistance)
    {
      // From the middle of a voxel to that of the nearest one of the part.
      const bool isNarrow = 2 * std::sqrt(squaredDistance) - spacing.minCoeff() < width;
      const auto isFree = [&grid](const std::array<int, 3>& place)
      { return grid.At(place[0], place[1], place[2]) == 0; };
      if (isNarrow && std::all_of(sheet.begin(), sheet.end(), isFree) &&
        !TouchesOtherPart(sheet, box, grid, label) && ClosesTunnel(sheet, grid, label))
      {
        found.insert(found.end(), sheet.begin(), sheet.end());
      }
    };
    if (!box.Fill(parts, static_cast<int>(part), work) || !box.Peel(parallelFor, work) ||
      !box.VisitSheets(work, take))
    {
      return false;
    }
    for (const std::array<int, 3>& place : found)
    {
      grid.Labels[grid.Offset(place[0], place[1], place[2])] = static_cast<LabelGrid::Index>(label);
    }
  }
  return work.Do(0);
}

} // namespace FlipFree

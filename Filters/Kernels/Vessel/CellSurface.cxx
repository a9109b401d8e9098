#include "Vessel/CellSurface.h"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

namespace FlipFree
{
namespace
{

// The neighbors of a cell that share a side, an edge or a corner with it, as offsets -1, 0, 1.
using Neighborhood = std::array<bool, 27>;

int CodeOf(int i, int j, int k)
{
  return (i + 1) + 3 * (j + 1) + 9 * (k + 1);
}

// Whether the sides in `marked` are in one piece, stepping from side to side across an edge. All
// sides but the opposite one are adjacent.
bool AreConnected(const std::array<bool, 6>& marked)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int others = static_cast<int>(std::count(marked.begin(), marked.end(), true)) -
      marked[2 * axis] - marked[2 * axis + 1];
    if (marked[2 * axis] && marked[2 * axis + 1] && others == 0)
    {
      return false;
    }
  }
  return true;
}

// Whether a cell touches those of its neighbors that are there in a disk: in some sides that are in
// one piece, and so are the others; and in no further edge or corner.
bool TouchesInDisk(const Neighborhood& there)
{
  std::array<bool, 6> sides{};
  std::array<bool, 6> others{};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int sign = 0; sign < 2; ++sign)
    {
      int offset[3] = { 0, 0, 0 };
      offset[axis] = 2 * sign - 1;
      sides[2 * axis + sign] = there[CodeOf(offset[0], offset[1], offset[2])];
      others[2 * axis + sign] = !sides[2 * axis + sign];
    }
  }
  const auto count = std::count(sides.begin(), sides.end(), true);
  if (count == 0 || count == 6 || !AreConnected(sides) || !AreConnected(others))
  {
    return false;
  }
  for (int code = 0; code < 27; ++code)
  {
    const int offset[3] = { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 };
    bool covered = code == 13 || !there[code];
    for (int axis = 0; axis < 3; ++axis)
    {
      covered = covered || (offset[axis] != 0 && sides[2 * axis + (offset[axis] > 0)]);
    }
    if (!covered)
    {
      return false;
    }
  }
  return true;
}

class BallGrowth
{
public:
  BallGrowth(const BitMask& cells, const std::vector<float>& depth)
    : Cells(cells)
    , Depth(depth)
    , Size(cells.GetGeometry().Dimensions)
    , Ball(cells.GetGeometry())
  {
  }

  BitMask Grow(std::size_t start)
  {
    this->Add(start);
    while (!this->Candidates.empty())
    {
      const std::size_t cell = this->Candidates.top().second;
      this->Candidates.pop();
      const auto [i, j, k] = this->PlaceOf(cell);
      if (!this->Ball(i, j, k) && TouchesInDisk(this->Around(i, j, k)))
      {
        this->Add(cell);
      }
    }
    return this->Ball;
  }

private:
  std::array<int, 3> PlaceOf(std::size_t cell) const
  {
    const std::size_t row = cell / this->Size[0];
    return { { static_cast<int>(cell % this->Size[0]), static_cast<int>(row % this->Size[1]),
      static_cast<int>(row / this->Size[1]) } };
  }

  Neighborhood Around(int i, int j, int k) const
  {
    Neighborhood there{};
    for (int code = 0; code < 27; ++code)
    {
      const int place[3] = { i + code % 3 - 1, j + code / 3 % 3 - 1, k + code / 9 - 1 };
      there[code] = this->Cells.GetGeometry().Contains(place[0], place[1], place[2]) &&
        this->Ball(place[0], place[1], place[2]);
    }
    return there;
  }

  // What may be added has changed for all cells around.
  void Add(std::size_t cell)
  {
    const auto [i, j, k] = this->PlaceOf(cell);
    this->Ball.Insert(i, j, k);
    for (int code = 0; code < 27; ++code)
    {
      const int place[3] = { i + code % 3 - 1, j + code / 3 % 3 - 1, k + code / 9 - 1 };
      if (this->Cells.GetGeometry().Contains(place[0], place[1], place[2]) &&
        this->Cells(place[0], place[1], place[2]) && !this->Ball(place[0], place[1], place[2]))
      {
        const std::size_t neighbor = this->Cells.GetGeometry().Offset(place[0], place[1], place[2]);
        this->Candidates.emplace(this->Depth[neighbor], neighbor);
      }
    }
  }

  const BitMask& Cells;
  const std::vector<float>& Depth;
  const std::array<int, 3> Size;
  BitMask Ball;
  std::priority_queue<std::pair<float, std::size_t>> Candidates;
};

// Corners of cells as keys; corner (0, 0, 0) is the first one of cell (0, 0, 0).
using Corner = std::array<int, 3>;
using DirectedEdge = std::pair<Corner, Corner>;

class SurfaceBuilder
{
public:
  explicit SurfaceBuilder(const BitMask& cells)
    : Cells(cells)
  {
    const auto& size = cells.GetGeometry().Dimensions;
    cells.ForEachRun(0, size[2],
      [this](int begin, int end, int j, int k)
      {
        for (int i = begin; i < end; ++i)
        {
          this->AddSides(i, j, k);
        }
      });
  }

  CellSurface Build() const
  {
    CellSurface surface;
    surface.Points.resize(static_cast<Eigen::Index>(this->Centers.size()), 3);
    for (std::size_t side = 0; side < this->Centers.size(); ++side)
    {
      surface.Points.row(static_cast<Eigen::Index>(side)) = this->Centers[side];
    }
    for (const auto& [corner, side] : this->FirstSides)
    {
      int now = side;
      do
      {
        surface.Faces.Connectivity.push_back(now);
        now = this->Next(now, corner);
      } while (now != side);
      surface.Faces.Offsets.push_back(static_cast<int>(surface.Faces.Connectivity.size()));
    }
    return surface;
  }

private:
  bool Holds(int i, int j, int k) const
  {
    return this->Cells.GetGeometry().Contains(i, j, k) && this->Cells(i, j, k);
  }

  void AddSides(int i, int j, int k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int sign = 0; sign < 2; ++sign)
      {
        std::array<int, 3> neighbor{ { i, j, k } };
        neighbor[axis] += 2 * sign - 1;
        if (!this->Holds(neighbor[0], neighbor[1], neighbor[2]))
        {
          this->AddSide({ { i, j, k } }, axis, sign);
        }
      }
    }
  }

  // Corners counter-clockwise seen from outside, in a right-handed frame.
  void AddSide(const std::array<int, 3>& cell, int axis, int sign)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<Corner, 4> corners;
    for (int turn = 0; turn < 4; ++turn)
    {
      corners[turn] = cell;
      corners[turn][axis] += sign;
      corners[turn][u] += turn == 1 || turn == 2;
      corners[turn][v] += turn >= 2;
    }
    const bool leftHanded = this->Cells.GetGeometry().Direction.determinant() < 0;
    if ((sign == 0) != leftHanded)
    {
      std::reverse(corners.begin(), corners.end());
    }
    const int side = static_cast<int>(this->Sides.size());
    this->Sides.push_back(corners);
    Eigen::Vector3d center(cell[0], cell[1], cell[2]);
    center[axis] += sign - 0.5;
    this->Centers.push_back(this->Cells.GetGeometry().ToPhysical(center));
    for (int turn = 0; turn < 4; ++turn)
    {
      this->Edges[{ corners[turn], corners[(turn + 1) % 4] }] = side;
      this->FirstSides.emplace(corners[turn], side);
    }
  }

  // The side that follows around a corner, counter-clockwise.
  int Next(int side, const Corner& corner) const
  {
    const auto& corners = this->Sides[side];
    const auto turn = std::find(corners.begin(), corners.end(), corner) - corners.begin();
    return this->Edges.at({ corner, corners[(turn + 3) % 4] });
  }

  const BitMask& Cells;
  std::vector<std::array<Corner, 4>> Sides;
  std::vector<Eigen::Vector3d> Centers;
  std::map<DirectedEdge, int> Edges;
  std::map<Corner, int> FirstSides;
};

} // namespace

BitMask GrowBall(const BitMask& cells, const std::vector<float>& depth, std::size_t start)
{
  return BallGrowth(cells, depth).Grow(start);
}

CellSurface MakeCellSurface(const BitMask& cells)
{
  return SurfaceBuilder(cells).Build();
}

} // namespace FlipFree

#include "LabelSurface/LabelWalls.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <unordered_map>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

bool IsReversedPair(int first, int second)
{
  return first == 0 || (second != 0 && second < first);
}

// The four cells around the edge from a voxel along an axis, counter-clockwise seen from its end.
std::array<std::array<int, 3>, 4> CellsAround(const std::array<int, 3>& voxel, int axis)
{
  std::array<std::array<int, 3>, 4> ring{ { voxel, voxel, voxel, voxel } };
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  --ring[0][u];
  --ring[0][v];
  --ring[1][v];
  --ring[3][u];
  return ring;
}

// Makes the walls around cells that have a label, in the tetrahedra there.
class TetrahedralWalls
{
public:
  TetrahedralWalls(const LabelGrid& grid, const LabelCells& cells, LabelWalls& walls)
    : Grid(grid)
    , Cells(cells)
    , Walls(walls)
  {
  }

  void Make()
  {
    for (int cell = 0; cell < this->Cells.Grid.NumberOfPlaces(); ++cell)
    {
      if (this->Cells.Labels[cell] != LabelCells::OnWalls)
      {
        this->AddSides(cell);
        this->AddRings(cell);
      }
    }
    // Means come after all edges.
    for (auto& triangle : this->Walls.Triangles)
    {
      for (int& vertex : triangle)
      {
        vertex = vertex < MeanBase ? vertex : vertex - MeanBase + this->Walls.FirstMean();
      }
    }
  }

private:
  static constexpr int MeanBase = 1 << 30;
  static constexpr int Most = 4;

  // Where walls may run. A label of OnWalls means a vertex of its own.
  struct Corner
  {
    LatticeNode Node;
    int Label = 0;
    int Vertex = -1;
    std::int64_t Key = 0;
  };

  std::int64_t KeyOf(const LatticeNode& node) const
  {
    // Cells begin one place before the first voxel.
    const auto& size = this->Grid.Size;
    const std::int64_t row =
      (node.Place[2] + 1) * static_cast<std::int64_t>(size[1] + 2) + node.Place[1] + 1;
    return 2 * (row * (size[0] + 2) + node.Place[0] + 1) + (node.IsCell ? 1 : 0);
  }

  Corner VoxelAt(const std::array<int, 3>& place) const
  {
    Corner corner;
    corner.Node = { place, false };
    corner.Label = this->Grid.At(place[0], place[1], place[2]);
    corner.Key = this->KeyOf(corner.Node);
    return corner;
  }

  Corner CellAt(const std::array<int, 3>& place) const
  {
    Corner corner;
    corner.Node = { place, true };
    corner.Key = this->KeyOf(corner.Node);
    const int cell = this->Cells.Grid.Find(place[0], place[1], place[2]);
    if (cell < 0)
    {
      // All its corners have one label.
      corner.Label = this->Grid.At(place[0], place[1], place[2]);
      return corner;
    }
    corner.Label = this->Cells.Labels[cell];
    corner.Vertex = this->Walls.VertexOfCell[cell];
    return corner;
  }

  // The tetrahedra across the sides of the cell, of which those between two such cells are left to
  // the first.
  void AddSides(int cell)
  {
    const auto place = this->Cells.Grid.PlaceOf(cell);
    const Corner center = this->CellAt(place);
    for (int side = 0; side < 6; ++side)
    {
      const int axis = side / 2;
      auto across = place;
      across[axis] += side % 2 == 0 ? -1 : 1;
      const int neighbor = this->Cells.Grid.Find(across[0], across[1], across[2]);
      if (neighbor >= 0 && neighbor < cell && this->Cells.Labels[neighbor] != LabelCells::OnWalls)
      {
        continue;
      }
      const Corner other = this->CellAt(across);
      std::array<Corner, 4> around;
      for (int turn = 0; turn < 4; ++turn)
      {
        auto voxel = place;
        voxel[axis] += side % 2;
        voxel[(axis + 1) % 3] += turn == 1 || turn == 2;
        voxel[(axis + 2) % 3] += turn >= 2;
        around[turn] = this->VoxelAt(voxel);
      }
      for (int turn = 0; turn < 4; ++turn)
      {
        this->AddTetrahedron({ { center, other, around[turn], around[(turn + 1) % 4] } });
      }
    }
  }

  // The other tetrahedra around the edges of the cell, whose wall is not one of four corners. Those
  // of an edge between several such cells are left to the first.
  void AddRings(int cell)
  {
    const auto place = this->Cells.Grid.PlaceOf(cell);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int turn = 0; turn < 4; ++turn)
      {
        auto voxel = place;
        voxel[(axis + 1) % 3] += turn % 2;
        voxel[(axis + 2) % 3] += turn / 2;
        auto next = voxel;
        ++next[axis];
        const Corner lower = this->VoxelAt(voxel);
        const Corner upper = this->VoxelAt(next);
        if (lower.Label == upper.Label)
        {
          continue;
        }
        const auto ring = CellsAround(voxel, axis);
        std::array<Corner, 4> centers;
        bool isFirst = true;
        for (int i = 0; i < 4; ++i)
        {
          centers[i] = this->CellAt(ring[i]);
          isFirst = isFirst &&
            (centers[i].Label == LabelCells::OnWalls ||
              centers[i].Key >= this->KeyOf({ place, true }));
        }
        for (int i = 0; isFirst && i < 4; ++i)
        {
          const Corner& one = centers[i];
          const Corner& two = centers[(i + 1) % 4];
          if (one.Label == LabelCells::OnWalls && two.Label == LabelCells::OnWalls)
          {
            this->AddTetrahedron({ { one, two, lower, upper } });
          }
        }
      }
    }
  }

  void AddTetrahedron(std::array<Corner, 4> corners)
  {
    // Labels in order, so that corners of one label are neighbors; those without a label first.
    std::stable_sort(corners.begin(), corners.end(),
      [](const Corner& one, const Corner& two) { return one.Label < two.Label; });
    const auto begin = std::find_if(corners.begin(), corners.end(),
      [](const Corner& corner) { return corner.Label != LabelCells::OnWalls; });
    const auto first = static_cast<std::size_t>(begin - corners.begin());
    const Corner* const labeled = corners.data() + first;
    if (first == 2)
    {
      if (labeled[0].Label != labeled[1].Label)
      {
        this->AddWall(labeled[0], labeled[1], corners[0].Vertex, corners[1].Vertex);
      }
    }
    else if (first == 1)
    {
      this->AddCone(labeled, corners[0].Vertex);
    }
    else
    {
      this->AddWhole(labeled);
    }
  }

  // Over the walls in a triangle.
  void AddCone(const Corner* corners, int apex)
  {
    const bool isLowEqual = corners[0].Label == corners[1].Label;
    const bool isHighEqual = corners[1].Label == corners[2].Label;
    if (isLowEqual && isHighEqual)
    {
      return;
    }
    if (isLowEqual || isHighEqual)
    {
      const Corner& odd = corners[isLowEqual ? 2 : 0];
      const Corner& other = corners[isLowEqual ? 0 : 2];
      this->AddWall(odd, corners[1], this->OnEdge(odd, other), apex);
      return;
    }
    const int middle = this->InTriangle(corners[0], corners[1], corners[2]);
    for (int i = 0; i < 3; ++i)
    {
      this->AddWall(corners[i], corners[(i + 1) % 3], middle, apex);
    }
  }

  void AddWhole(const Corner* c)
  {
    std::vector<int> begins; // of runs of one label
    for (int i = 0; i < Most; ++i)
    {
      if (i == 0 || c[i].Label != c[i - 1].Label)
      {
        begins.push_back(i);
      }
    }
    if (begins.size() == 2)
    {
      const int count = begins[1];
      if (count == 2)
      {
        const int opposite = this->OnEdge(c[1], c[3]);
        this->AddWall(c[0], c[2], this->OnEdge(c[1], c[2]), opposite);
        this->AddWall(c[0], c[2], this->OnEdge(c[0], c[3]), opposite);
        return;
      }
      const Corner& odd = c[count == 1 ? 0 : 3];
      const Corner* const others = c + (count == 1 ? 1 : 0);
      // In an order of their own: that of arguments is each compiler's.
      const int third = this->OnEdge(odd, others[2]);
      const int second = this->OnEdge(odd, others[1]);
      this->AddWall(odd, others[0], second, third);
    }
    else if (begins.size() == 3)
    {
      // Two corners of one label, and two more.
      const int twin = begins[1] == 2 ? 0 : begins[2] == 3 ? 1 : 2;
      const Corner& one = c[twin];
      const Corner& two = c[twin + 1];
      const Corner& three = c[twin == 0 ? 2 : 0];
      const Corner& four = c[twin == 2 ? 1 : 3];
      const int here = this->InTriangle(one, three, four);
      const int there = this->InTriangle(two, three, four);
      this->AddWall(three, four, here, there);
      for (const Corner* other : { &three, &four })
      {
        this->AddWall(one, *other, this->OnEdge(two, *other), there);
        this->AddWall(one, *other, here, there);
      }
    }
    else if (begins.size() == 4)
    {
      const int middle = this->InTetrahedron(c);
      for (int i = 0; i < Most; ++i)
      {
        for (int j = i + 1; j < Most; ++j)
        {
          for (int k = 0; k < Most; ++k)
          {
            if (k != i && k != j)
            {
              this->AddWall(c[i], c[j], middle, this->InTriangle(c[i], c[j], c[k]));
            }
          }
        }
      }
    }
  }

  // A triangle between two corners of different labels, with a vertex on the edge between them.
  void AddWall(const Corner& one, const Corner& two, int second, int third)
  {
    const bool isReversed = IsReversedPair(one.Label, two.Label);
    const Corner& from = isReversed ? two : one;
    const Corner& to = isReversed ? one : two;
    std::array<int, 3> triangle{ { this->OnEdge(one, two), second, third } };
    const Vector3d vertex = this->AtRest(triangle[0]);
    const Vector3d normal = (this->AtRest(second) - vertex).cross(this->AtRest(third) - vertex);
    if (normal.dot(to.Node.AtRest() - from.Node.AtRest()) < 0)
    {
      std::swap(triangle[1], triangle[2]);
    }
    this->Walls.Triangles.push_back(triangle);
    this->Walls.TriangleLabels.push_back({ { from.Label, to.Label } });
  }

  int OnEdge(const Corner& one, const Corner& two)
  {
    const auto found = this->Add({ { one.Key, two.Key, -1, -1 } },
      this->Walls.FirstEdge() + static_cast<int>(this->Walls.Edges.size()));
    if (found.second)
    {
      this->Walls.Edges.push_back({ { one.Node, two.Node } });
    }
    return found.first;
  }

  int InTriangle(const Corner& one, const Corner& two, const Corner& three)
  {
    const LabelWalls::Mean mean{ 3,
      { { this->OnEdge(one, two), this->OnEdge(two, three), this->OnEdge(one, three) } } };
    return this->AddMean({ { one.Key, two.Key, three.Key, -1 } }, mean);
  }

  int InTetrahedron(const Corner* c)
  {
    const LabelWalls::Mean mean{ 6,
      { { this->OnEdge(c[0], c[1]), this->OnEdge(c[0], c[2]), this->OnEdge(c[0], c[3]),
        this->OnEdge(c[1], c[2]), this->OnEdge(c[1], c[3]), this->OnEdge(c[2], c[3]) } } };
    return this->AddMean({ { c[0].Key, c[1].Key, c[2].Key, c[3].Key } }, mean);
  }

  using Simplex = std::array<std::int64_t, 4>;

  int AddMean(const Simplex& simplex, const LabelWalls::Mean& mean)
  {
    const auto found = this->Add(simplex, MeanBase + static_cast<int>(this->Walls.Means.size()));
    if (found.second)
    {
      this->Walls.Means.push_back(mean);
    }
    return found.first;
  }

  // The vertex of a simplex, and whether it is new.
  std::pair<int, bool> Add(Simplex simplex, int vertex)
  {
    std::sort(simplex.begin(), simplex.end());
    const auto inserted = this->Vertices.emplace(simplex, vertex);
    return { inserted.first->second, inserted.second };
  }

  Vector3d AtRest(int vertex) const
  {
    if (vertex >= MeanBase)
    {
      const LabelWalls::Mean& mean = this->Walls.Means[vertex - MeanBase];
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i < mean.Count; ++i)
      {
        sum += this->AtRest(mean.Of[i]);
      }
      return sum / mean.Count;
    }
    if (vertex < this->Walls.FirstEdge())
    {
      return LatticeNode{ this->Cells.Grid.PlaceOf(this->Walls.Cells[vertex]), true }.AtRest();
    }
    const auto& edge = this->Walls.Edges[vertex - this->Walls.FirstEdge()];
    return (edge[0].AtRest() + edge[1].AtRest()) / 2;
  }

  struct Hash
  {
    std::size_t operator()(const Simplex& simplex) const
    {
      std::uint64_t hash = 0;
      for (const std::int64_t key : simplex)
      {
        hash = (hash ^ static_cast<std::uint64_t>(key)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
      }
      return static_cast<std::size_t>(hash);
    }
  };

  const LabelGrid& Grid;
  const LabelCells& Cells;
  LabelWalls& Walls;
  std::unordered_map<Simplex, int, Hash> Vertices;
};

struct QuadList
{
  std::vector<std::array<int, 4>> Quads;
  std::vector<std::array<int, 2>> Labels;
  std::vector<LabelWalls::VoxelPair> Voxels;
};

// The walls between the first voxel of a cell and the next one along each axis.
void AddQuads(const LabelGrid& grid, const LabelCells& cells, const std::vector<int>& vertexOfCell,
  int cell, QuadList& list)
{
  const auto place = cells.Grid.PlaceOf(cell);
  const std::size_t voxel = grid.Offset(place[0], place[1], place[2]);
  const std::array<std::size_t, 3> steps{ { 1, static_cast<std::size_t>(grid.Size[0]),
    static_cast<std::size_t>(grid.Size[0]) * grid.Size[1] } };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int lower = grid.Labels[voxel];
    const int upper = grid.Labels[voxel + steps[axis]];
    if (lower == upper)
    {
      continue;
    }
    const auto ring = CellsAround(place, axis);
    std::array<int, 4> quad;
    for (int i = 0; i < 4; ++i)
    {
      quad[i] = vertexOfCell[i == 2 ? cell : cells.Grid.Find(ring[i][0], ring[i][1], ring[i][2])];
    }
    if (*std::min_element(quad.begin(), quad.end()) < 0)
    {
      continue;
    }
    const bool isReversed = IsReversedPair(lower, upper);
    if (isReversed)
    {
      std::swap(quad[1], quad[3]);
    }
    list.Quads.push_back(quad);
    list.Labels.push_back({ { isReversed ? upper : lower, isReversed ? lower : upper } });
    list.Voxels.push_back({ cell, static_cast<signed char>(axis), isReversed });
  }
}

template <typename T>
void AppendTo(std::vector<T>& all, const std::vector<T>& some)
{
  all.insert(all.end(), some.begin(), some.end());
}

} // namespace

LabelWalls::LabelWalls(const LabelGrid& grid, const LabelCells& cells,
  const ParallelFor& parallelFor)
{
  const int count = cells.Grid.NumberOfPlaces();
  this->VertexOfCell.resize(count);
  for (int cell = 0; cell < count; ++cell)
  {
    const bool isOnWalls = cells.Labels[cell] == LabelCells::OnWalls;
    this->VertexOfCell[cell] = isOnWalls ? static_cast<int>(this->Cells.size()) : -1;
    if (isOnWalls)
    {
      this->Cells.push_back(cell);
    }
  }

  constexpr int Chunk = 8192;
  std::vector<QuadList> lists((count + Chunk - 1) / Chunk);
  parallelFor(0, static_cast<std::ptrdiff_t>(lists.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int chunk = static_cast<int>(first); chunk < last; ++chunk)
      {
        for (int cell = chunk * Chunk; cell < std::min(count, (chunk + 1) * Chunk); ++cell)
        {
          AddQuads(grid, cells, this->VertexOfCell, cell, lists[chunk]);
        }
      }
    });
  for (const QuadList& list : lists)
  {
    AppendTo(this->Quads, list.Quads);
    AppendTo(this->QuadLabels, list.Labels);
    AppendTo(this->QuadVoxels, list.Voxels);
  }
  TetrahedralWalls(grid, cells, *this).Make();
}

std::array<LatticeNode, 2> LabelWalls::NodesOf(const VoxelPair& pair, const LabelCells& cells) const
{
  const LatticeNode lower{ cells.Grid.PlaceOf(pair.Cell), false };
  LatticeNode upper = lower;
  ++upper.Place[pair.Axis];
  return pair.IsReversed ? std::array<LatticeNode, 2>{ { upper, lower } }
                         : std::array<LatticeNode, 2>{ { lower, upper } };
}

} // namespace FlipFree

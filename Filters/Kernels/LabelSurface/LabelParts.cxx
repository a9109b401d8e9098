#include "LabelSurface/LabelParts.h"

#include <map>
#include <numeric>

namespace FlipFree
{
namespace
{

// Sets of runs, each named by its first one.
class RunSets
{
public:
  explicit RunSets(std::size_t count)
    : Parents(count)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  int Find(int run)
  {
    while (this->Parents[run] != run)
    {
      this->Parents[run] = this->Parents[this->Parents[run]];
      run = this->Parents[run];
    }
    return run;
  }

  void Unite(int one, int other)
  {
    const auto [first, second] = std::minmax({ this->Find(one), this->Find(other) });
    this->Parents[second] = first;
  }

private:
  std::vector<int> Parents;
};

// Calls visit(run, other, voxels) where runs of two rows lie side by side.
template <typename Visit>
void VisitBeside(const LabelParts& parts, std::size_t row, std::size_t otherRow, const Visit& visit)
{
  std::size_t run = parts.RowBegin[row];
  std::size_t other = parts.RowBegin[otherRow];
  while (run < parts.RowBegin[row + 1] && other < parts.RowBegin[otherRow + 1])
  {
    const int end = parts.EndOf(run, row);
    const int otherEnd = parts.EndOf(other, otherRow);
    visit(static_cast<int>(run), static_cast<int>(other),
      std::min(end, otherEnd) - std::max(parts.Runs[run].Begin, parts.Runs[other].Begin));
    run += end <= otherEnd ? 1 : 0;
    other += otherEnd <= end ? 1 : 0;
  }
}

// The pairs of rows that lie side by side.
template <typename Visit>
void VisitRows(const std::array<int, 3>& size, const Visit& visit)
{
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const std::size_t row = j + static_cast<std::size_t>(size[1]) * k;
      if (j > 0)
      {
        visit(row - 1, row);
      }
      if (k > 0)
      {
        visit(row - size[1], row);
      }
    }
  }
}

// The parts that are connected as cells with labels connect them.
class CellJoints
{
public:
  CellJoints(const LabelGrid& grid, const LabelCells& cells, const LabelParts& parts, RunSets& sets)
    : Grid(grid)
    , Cells(cells)
    , Parts(parts)
    , Sets(sets)
  {
  }

  void Unite()
  {
    for (int cell = 0; cell < this->Cells.Grid.NumberOfPlaces(); ++cell)
    {
      if (this->Cells.Labels[cell] != LabelCells::OnWalls)
      {
        this->UniteAround(cell);
      }
    }
  }

private:
  void UniteAround(int cell)
  {
    const int label = this->Cells.Labels[cell];
    const auto place = this->Cells.Grid.PlaceOf(cell);
    const int first = this->FirstRunOf(place, label);
    for (int corner = 0; corner < 8; ++corner)
    {
      const auto voxel = CornerOf(place, corner);
      if (this->Grid.At(voxel[0], voxel[1], voxel[2]) == label)
      {
        this->Sets.Unite(first, this->RunAt(voxel));
      }
    }
    for (int side = 0; side < 6; ++side)
    {
      const int neighbor = this->Cells.Neighbor(cell, side);
      if (neighbor >= 0 && this->Cells.Labels[neighbor] == label)
      {
        this->Sets.Unite(first, this->FirstRunOf(this->Cells.Grid.PlaceOf(neighbor), label));
      }
    }
  }

  static std::array<int, 3> CornerOf(const std::array<int, 3>& place, int corner)
  {
    return { { place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2) } };
  }

  // A cell has the label of some of its corners.
  int FirstRunOf(const std::array<int, 3>& place, int label) const
  {
    int corner = 0;
    std::array<int, 3> voxel = place;
    while (this->Grid.At(voxel[0], voxel[1], voxel[2]) != label)
    {
      voxel = CornerOf(place, ++corner);
    }
    return this->RunAt(voxel);
  }

  int RunAt(const std::array<int, 3>& voxel) const
  {
    const std::size_t row = voxel[1] + static_cast<std::size_t>(this->Grid.Size[1]) * voxel[2];
    const auto begin = this->Parts.Runs.begin();
    const auto after = std::upper_bound(begin + this->At(row), begin + this->At(row + 1), voxel[0],
      [](int i, const LabelParts::Run& run) { return i < run.Begin; });
    return static_cast<int>(after - begin) - 1;
  }

  std::ptrdiff_t At(std::size_t row) const
  {
    return static_cast<std::ptrdiff_t>(this->Parts.RowBegin[row]);
  }

  const LabelGrid& Grid;
  const LabelCells& Cells;
  const LabelParts& Parts;
  RunSets& Sets;
};

// What labels the parts have that go.
class Takeover
{
public:
  Takeover(const LabelParts& parts, const LabelPartSettings& settings)
    : Parts(parts)
    , Labels(parts.Parts.size(), Undecided)
  {
    for (std::size_t part = 0; part < this->Labels.size(); ++part)
    {
      const auto& it = parts.Parts[part];
      const bool goes =
        it.Label == 0 ? part > 0 && settings.FillCavities : it.Voxels < settings.SmallestPart;
      this->Labels[part] = goes ? Undecided : it.Label;
      this->NumberThatGo += goes ? 1 : 0;
    }
  }

  bool IsNeeded() const { return this->NumberThatGo > 0; }

  // By part.
  std::vector<int> Decide()
  {
    BorderFaces rest = this->Borders();
    while (!rest.empty())
    {
      this->DecideSome(rest);
    }
    return this->Labels;
  }

private:
  static constexpr int Undecided = -1;
  using BorderFaces =
    std::map<int, std::map<int, std::size_t>>; // faces, by part that goes and neighbor

  BorderFaces Borders() const
  {
    BorderFaces borders;
    const auto add = [&](int one, int other, std::size_t faces)
    {
      if (this->Labels[one] == Undecided)
      {
        borders[one][other] += faces;
      }
    };
    this->Parts.VisitBorders(
      [&](int one, int other, std::size_t faces)
      {
        add(one, other, faces);
        add(other, one, faces);
      });
    return borders;
  }

  // By what is decided so far, so that the order means nothing.
  void DecideSome(BorderFaces& rest)
  {
    std::map<int, int> decided;
    for (const auto& [part, neighbors] : rest)
    {
      const int label = this->LabelAmong(neighbors);
      if (label != Undecided)
      {
        decided[part] = label;
      }
    }
    for (const auto& [part, label] : decided)
    {
      this->Labels[part] = label;
      rest.erase(part);
    }
  }

  int LabelAmong(const std::map<int, std::size_t>& neighbors) const
  {
    std::map<int, std::size_t> faces; // by label
    for (const auto& [part, count] : neighbors)
    {
      faces[this->Labels[part]] += count;
    }
    faces.erase(Undecided);
    std::size_t most = 0;
    for (const auto& [label, count] : faces)
    {
      most = std::max(most, count);
    }
    const auto background = faces.find(0);
    if (background != faces.end() && background->second == most)
    {
      return 0;
    }
    for (const auto& [part, count] : neighbors) // in the order of their voxels
    {
      const auto found = faces.find(this->Labels[part]);
      if (found != faces.end() && found->second == most)
      {
        return found->first;
      }
    }
    return Undecided;
  }

  const LabelParts& Parts;
  std::vector<int> Labels;
  int NumberThatGo = 0;
};

} // namespace

LabelParts::LabelParts(const LabelGrid& grid, const LabelCells& cells)
  : LabelParts(grid, &cells)
{
}

LabelParts::LabelParts(const LabelGrid& grid)
  : LabelParts(grid, nullptr)
{
}

LabelParts::LabelParts(const LabelGrid& grid, const LabelCells* cells)
  : Size(grid.Size)
{
  std::vector<int> labels; // of the runs
  for (int k = 0; k < grid.Size[2]; ++k)
  {
    for (int j = 0; j < grid.Size[1]; ++j)
    {
      this->RowBegin.push_back(this->Runs.size());
      const LabelGrid::Index* const row = &grid.Labels[grid.Offset(0, j, k)];
      for (int i = 0; i < grid.Size[0]; ++i)
      {
        if (i == 0 || row[i] != row[i - 1])
        {
          this->Runs.push_back({ i, -1 });
          labels.push_back(row[i]);
        }
      }
    }
  }
  this->RowBegin.push_back(this->Runs.size());
  RunSets sets(this->Runs.size());
  VisitRows(this->Size,
    [&](std::size_t row, std::size_t next)
    {
      VisitBeside(*this, row, next,
        [&](int run, int other, int /*voxels*/)
        {
          if (labels[run] == labels[other])
          {
            sets.Unite(run, other);
          }
        });
    });
  if (cells)
  {
    CellJoints(grid, *cells, *this, sets).Unite();
  }
  for (std::size_t row = 0; row + 1 < this->RowBegin.size(); ++row)
  {
    for (std::size_t run = this->RowBegin[row]; run < this->RowBegin[row + 1]; ++run)
    {
      const int first = sets.Find(static_cast<int>(run));
      if (first == static_cast<int>(run))
      {
        this->Runs[run].Part = static_cast<int>(this->Parts.size());
        this->Parts.push_back({ labels[run], 0 });
      }
      this->Runs[run].Part = this->Runs[first].Part;
      this->Parts[this->Runs[run].Part].Voxels += this->EndOf(run, row) - this->Runs[run].Begin;
    }
  }
}

template <typename Visit>
void LabelParts::VisitBorders(const Visit& visit) const
{
  for (std::size_t row = 0; row + 1 < this->RowBegin.size(); ++row)
  {
    for (std::size_t run = this->RowBegin[row] + 1; run < this->RowBegin[row + 1]; ++run)
    {
      visit(this->Runs[run - 1].Part, this->Runs[run].Part, 1);
    }
  }
  VisitRows(this->Size,
    [&](std::size_t row, std::size_t next)
    {
      VisitBeside(*this, row, next,
        [&](int run, int other, int voxels)
        {
          if (this->Runs[run].Part != this->Runs[other].Part)
          {
            visit(this->Runs[run].Part, this->Runs[other].Part, voxels);
          }
        });
    });
}

LabelGrid KeepParts(LabelGrid grid, const LabelPartSettings& settings,
  const ParallelFor& parallelFor)
{
  // What takes a label may change which labels are joined, and so what is a part.
  while (!settings.KeepsAll())
  {
    const LabelParts parts(grid, LabelCells(grid, parallelFor));
    Takeover takeover(parts, settings);
    if (!takeover.IsNeeded())
    {
      break;
    }
    const std::vector<int> labels = takeover.Decide();
    for (std::size_t row = 0; row + 1 < parts.RowBegin.size(); ++row)
    {
      LabelGrid::Index* const voxels = grid.Labels.data() + row * grid.Size[0];
      for (std::size_t run = parts.RowBegin[row]; run < parts.RowBegin[row + 1]; ++run)
      {
        const LabelParts::Run& it = parts.Runs[run];
        std::fill(voxels + it.Begin, voxels + parts.EndOf(run, row),
          static_cast<LabelGrid::Index>(labels[it.Part]));
      }
    }
  }
  return grid;
}

} // namespace FlipFree

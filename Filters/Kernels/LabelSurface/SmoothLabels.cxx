#include "LabelSurface/SmoothLabels.h"

#include <cstdlib>

namespace FlipFree
{
namespace
{

// What stands in for several labels at once.
constexpr int Contested = -1;

// Voxels may become simple when others have changed.
constexpr int MaximumPasses = 4;

// The 27 voxels around one, and which are next to each other by a face, or by an edge or corner
// too.
struct Neighborhood
{
  static constexpr unsigned int Center = 1U << 13;

  Neighborhood()
  {
    for (int one = 0; one < 27; ++one)
    {
      for (int two = 0; two < 27; ++two)
      {
        const int steps[3] = { std::abs(one % 3 - two % 3), std::abs(one / 3 % 3 - two / 3 % 3),
          std::abs(one / 9 - two / 9) };
        const int sum = steps[0] + steps[1] + steps[2];
        const bool isNear = std::max({ steps[0], steps[1], steps[2] }) == 1;
        this->ByFace[one] |= static_cast<unsigned int>(sum == 1) << two;
        this->ByCorner[one] |= static_cast<unsigned int>(isNear) << two;
        if (one == 13 && isNear && sum <= 2)
        {
          this->WithoutCorners |= 1U << two;
        }
      }
    }
  }

  std::array<unsigned int, 27> ByFace{};
  std::array<unsigned int, 27> ByCorner{};
  unsigned int WithoutCorners = 0;
};

// Whether all voxels of `seeds`, some of `set`, are connected within the set, and there is one.
bool AreOnePiece(unsigned int seeds, unsigned int set, const std::array<unsigned int, 27>& adjacent)
{
  unsigned int reached = seeds & (~seeds + 1);
  unsigned int front = reached;
  while (front != 0)
  {
    unsigned int next = 0;
    for (int voxel = 0; voxel < 27; ++voxel)
    {
      if ((front >> voxel & 1) != 0)
      {
        next |= adjacent[voxel];
      }
    }
    front = next & set & ~reached;
    reached |= front;
  }
  return seeds != 0 && (seeds & ~reached) == 0;
}

// The label of each voxel of the grid's box by the surfaces, or Contested.
std::vector<int> LabelsBySurface(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor)
{
  std::vector<int> labels(grid.Labels.size(), 0);
  VisitVoxelsInside(walls, grid, parallelFor,
    [&](int label, const VoxelRun& run)
    {
      int* const row = &labels[grid.Offset(0, run.J, run.K)];
      for (int i = run.Begin; i < run.End; ++i)
      {
        row[i] = row[i] == 0 ? label : Contested;
      }
    });
  return labels;
}

class Relabeling
{
public:
  explicit Relabeling(LabelGrid& grid)
    : Grid(grid)
  {
  }

  bool MayChange(std::size_t voxel, int label) const
  {
    const unsigned int former = this->MaskOf(voxel, this->Grid.Labels[voxel]);
    const unsigned int next = this->MaskOf(voxel, label);
    return IsSimpleVoxel(former) && IsSimpleVoxel(next);
  }

private:
  unsigned int MaskOf(std::size_t voxel, int label) const
  {
    unsigned int mask = 0;
    int bit = 0;
    for (int k = -1; k <= 1; ++k)
    {
      for (int j = -1; j <= 1; ++j)
      {
        const int* const row = &this->Grid.Labels[voxel] +
          this->Grid.Size[0] * (j + static_cast<std::ptrdiff_t>(this->Grid.Size[1]) * k);
        for (int i = -1; i <= 1; ++i, ++bit)
        {
          mask |= static_cast<unsigned int>(row[i] == label) << bit;
        }
      }
    }
    return mask & ~Neighborhood::Center;
  }

  const LabelGrid& Grid;
};

} // namespace

bool IsSimpleVoxel(unsigned int neighbors)
{
  static const Neighborhood around;
  const unsigned int others = ~neighbors & ((1U << 27) - 1) & ~Neighborhood::Center;
  const auto isSimple = [](unsigned int set, unsigned int rest)
  {
    const unsigned int sides = around.ByFace[13];
    return AreOnePiece(set, set, around.ByCorner) &&
      AreOnePiece(rest & sides, rest & around.WithoutCorners, around.ByFace);
  };
  return isSimple(neighbors, others) && isSimple(others, neighbors);
}

LabelGrid SmoothLabels(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor)
{
  const std::vector<int> wanted = LabelsBySurface(grid, walls, parallelFor);
  std::vector<std::size_t> candidates;
  for (int k = 1; k + 1 < grid.Size[2]; ++k)
  {
    for (int j = 1; j + 1 < grid.Size[1]; ++j)
    {
      const std::size_t row = grid.Offset(0, j, k);
      for (std::size_t voxel = row + 1; voxel + 1 < row + grid.Size[0]; ++voxel)
      {
        if (wanted[voxel] != grid.Labels[voxel] && wanted[voxel] != Contested)
        {
          candidates.push_back(voxel);
        }
      }
    }
  }
  LabelGrid smooth = grid;
  const Relabeling relabeling(smooth);
  // A simple voxel has a neighbor with either label.
  for (int pass = 0; pass < MaximumPasses && !candidates.empty(); ++pass)
  {
    const auto rest = std::remove_if(candidates.begin(), candidates.end(),
      [&](std::size_t voxel)
      {
        const bool mayChange = relabeling.MayChange(voxel, wanted[voxel]);
        smooth.Labels[voxel] = mayChange ? wanted[voxel] : smooth.Labels[voxel];
        return mayChange;
      });
    if (rest == candidates.end())
    {
      break;
    }
    candidates.erase(rest, candidates.end());
  }
  return smooth;
}

} // namespace FlipFree

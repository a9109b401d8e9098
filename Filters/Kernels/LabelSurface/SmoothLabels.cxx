#include "LabelSurface/SmoothLabels.h"

#include "LabelSurface/SimpleVoxel.h"

namespace FlipFree
{
namespace
{

// What stands in for several labels at once.
constexpr LabelGrid::Index Contested = MaximumLabels + 1;

// Voxels may become simple when others have changed.
constexpr int MaximumPasses = 4;

// The label of each voxel of the grid's box by the surfaces, or Contested.
std::vector<LabelGrid::Index> LabelsBySurface(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor)
{
  std::vector<LabelGrid::Index> labels(grid.Labels.size(), 0);
  VisitVoxelsInside(walls, grid, parallelFor,
    [&](int label, const VoxelRun& run)
    {
      LabelGrid::Index* const row = &labels[grid.Offset(0, run.J, run.K)];
      for (int i = run.Begin; i < run.End; ++i)
      {
        row[i] = row[i] == 0 ? static_cast<LabelGrid::Index>(label) : Contested;
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
        const LabelGrid::Index* const row = &this->Grid.Labels[voxel] +
          this->Grid.Size[0] * (j + static_cast<std::ptrdiff_t>(this->Grid.Size[1]) * k);
        for (int i = -1; i <= 1; ++i, ++bit)
        {
          mask |= static_cast<unsigned int>(row[i] == label) << bit;
        }
      }
    }
    return mask & ~CenterVoxel;
  }

  const LabelGrid& Grid;
};

} // namespace

LabelGrid SmoothLabels(const LabelGrid& grid, const SharedWalls& walls,
  const ParallelFor& parallelFor)
{
  const std::vector<LabelGrid::Index> wanted = LabelsBySurface(grid, walls, parallelFor);
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

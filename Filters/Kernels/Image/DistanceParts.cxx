#include "Image/DistanceParts.h"

#include "Image/DistanceOrder.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{
namespace
{

class MaxTree
{
public:
  MaxTree(const std::vector<float>& squaredDistance, const ImageGeometry& geometry,
    const std::vector<std::size_t>& seed, double ratio)
    : Distance(squaredDistance)
    , Size(geometry.Dimensions)
    , SquaredRatio(static_cast<float>(ratio * ratio))
    , Parent(squaredDistance.size(), Outside)
    , IsSeed(squaredDistance.size(), false)
  {
    for (const std::size_t voxel : seed)
    {
      this->IsSeed[voxel] = true;
    }
  }

  DistanceParts Execute()
  {
    const std::vector<int> order = OrderByDistance(this->Distance);
    for (const int voxel : order)
    {
      this->Enter(voxel);
    }
    return this->Number(order);
  }

private:
  int Root(int voxel)
  {
    while (this->Parent[voxel] != voxel)
    {
      this->Parent[voxel] = this->Parent[this->Parent[voxel]];
      voxel = this->Parent[voxel];
    }
    return voxel;
  }

  // Roots are peaks: the one of greater distance, or earlier in the order, stays.
  bool IsBefore(int a, int b) const
  {
    return this->Distance[a] != this->Distance[b] ? this->Distance[a] > this->Distance[b] : a < b;
  }

  void Enter(int voxel)
  {
    const int row = this->Size[0];
    const int slice = row * this->Size[1];
    const int i = voxel % row;
    const int j = voxel / row % this->Size[1];
    const int k = voxel / slice;
    std::array<int, 6> roots{};
    int count = 0;
    // The greatest peak comes first: it stays.
    const auto add = [&](bool exists, int neighbor)
    {
      if (exists && this->Parent[neighbor] >= 0)
      {
        roots[count] = this->Root(neighbor);
        if (this->IsBefore(roots[count], roots[0]))
        {
          std::swap(roots[0], roots[count]);
        }
        ++count;
      }
    };
    add(i > 0, voxel - 1);
    add(i + 1 < row, voxel + 1);
    add(j > 0, voxel - row);
    add(j + 1 < this->Size[1], voxel + row);
    add(k > 0, voxel - slice);
    add(k + 1 < this->Size[2], voxel + slice);
    if (count == 0)
    {
      this->Parent[voxel] = voxel;
      return;
    }
    int root = roots[0];
    const bool seed = this->IsSeed[voxel];
    this->Parent[voxel] = root;
    if (seed)
    {
      this->IsSeed[root] = true;
    }
    for (int other = 1; other < count; ++other)
    {
      const int smaller = this->Root(roots[other]);
      root = this->Root(root);
      if (smaller == root)
      {
        continue;
      }
      const bool wide = this->Distance[voxel] >= this->SquaredRatio * this->Distance[smaller];
      if (wide || (this->IsSeed[smaller] && this->IsSeed[root]))
      {
        this->Parent[smaller] = root;
        this->IsSeed[root] = this->IsSeed[root] || this->IsSeed[smaller];
      }
    }
  }

  // The numbers replace the parents in place.
  DistanceParts Number(const std::vector<int>& order)
  {
    for (const int voxel : order)
    {
      this->Parent[voxel] = this->Root(voxel);
    }
    DistanceParts parts;
    for (const int voxel : order) // roots come before the other voxels of their parts
    {
      int& parent = this->Parent[voxel];
      if (parent == voxel)
      {
        parent = MarkOf(static_cast<int>(parts.Peaks.size()));
        parts.Peaks.push_back(this->Distance[voxel]);
        parts.HoldsSeed.push_back(this->IsSeed[voxel]);
      }
      else
      {
        parent = this->Parent[parent];
      }
    }
    for (int& parent : this->Parent)
    {
      parent = parent == Outside ? DistanceParts::Outside : MarkOf(parent);
    }
    parts.PartOf = std::move(this->Parent);
    return parts;
  }

  static constexpr int Outside = -1;

  // Of a part's number, and back: neither a voxel nor Outside.
  static int MarkOf(int number) { return -2 - number; }

  const std::vector<float>& Distance;
  const std::array<int, 3> Size;
  const float SquaredRatio;
  std::vector<int> Parent;
  std::vector<bool> IsSeed; // at a root: of the whole part
};

} // namespace

DistanceParts FindDistanceParts(const std::vector<float>& squaredDistance,
  const ImageGeometry& geometry, const std::vector<std::size_t>& seed, double ratio)
{
  return MaxTree(squaredDistance, geometry, seed, ratio).Execute();
}

} // namespace FlipFree

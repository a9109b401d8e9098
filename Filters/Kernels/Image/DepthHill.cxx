#include "Image/DepthHill.h"

#include "Image/DistanceOrder.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// Sets of voxels that have joined.
class Components
{
public:
  explicit Components(std::size_t size)
    : Members(size)
  {
  }

  bool Has(std::size_t voxel) const { return this->Members[voxel].IsIn; }

  void Add(std::size_t voxel, float depth) { this->Members[voxel] = { voxel, depth, true }; }

  std::size_t RootOf(std::size_t voxel)
  {
    while (this->Members[voxel].Parent != voxel)
    {
      Member& member = this->Members[voxel];
      member.Parent = this->Members[member.Parent].Parent;
      voxel = member.Parent;
    }
    return voxel;
  }

  float PeakOf(std::size_t voxel) { return this->Members[this->RootOf(voxel)].Peak; }

  void Join(std::size_t one, std::size_t two)
  {
    Member& from = this->Members[this->RootOf(one)];
    const std::size_t root = this->RootOf(two);
    Member& to = this->Members[root];
    to.Peak = std::max(from.Peak, to.Peak);
    from.Parent = root;
  }

private:
  struct Member
  {
    std::size_t Parent = 0; // itself: the root
    float Peak = 0;
    bool IsIn = false;
  };
  std::vector<Member> Members;
};

} // namespace

DepthHill FindDepthHill(const std::vector<float>& squaredDistance, const ImageGeometry& geometry,
  std::size_t own, std::size_t other)
{
  DepthHill hill;
  const std::vector<int> order = OrderByDistance(squaredDistance);
  Components components(squaredDistance.size());
  for (const int voxel : order)
  {
    components.Add(voxel, squaredDistance[voxel]);
    // What the voxel is about to join: the parts of both points, or they meet later.
    bool joinsOwn = false;
    bool joinsOther = false;
    if (components.Has(own) && components.Has(other))
    {
      VisitNeighbors(voxel, geometry,
        [&](std::size_t neighbor)
        {
          if (components.Has(neighbor))
          {
            const std::size_t root = components.RootOf(neighbor);
            joinsOwn = joinsOwn || root == components.RootOf(own);
            joinsOther = joinsOther || root == components.RootOf(other);
          }
        });
    }
    const auto isEnd =
      static_cast<std::size_t>(voxel) == own || static_cast<std::size_t>(voxel) == other;
    if (joinsOwn && joinsOther && !isEnd && components.RootOf(own) != components.RootOf(other))
    {
      hill.Saddle = squaredDistance[voxel];
      hill.Peak = components.PeakOf(own);
      hill.Holds.assign(squaredDistance.size(), false);
      const std::size_t root = components.RootOf(own);
      for (const int deep : order)
      {
        if (deep == voxel)
        {
          break;
        }
        hill.Holds[deep] = components.RootOf(deep) == root;
      }
      return hill;
    }
    VisitNeighbors(voxel, geometry,
      [&](std::size_t neighbor)
      {
        if (components.Has(neighbor))
        {
          components.Join(voxel, neighbor);
        }
      });
    if (components.Has(own) && components.Has(other) &&
      components.RootOf(own) == components.RootOf(other))
    {
      return hill;
    }
  }
  return hill;
}

} // namespace FlipFree

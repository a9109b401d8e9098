#include "Vessel/MinimalPaths.h"

#include "Error.h"
#include "Image/VoxelOffsets.h"
#include "MessageText.h"
#include "Vessel/FastMarching.h"
#include "Vessel/Polyline.h"
#include "Vessel/VesselImage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

class PathTree
{
public:
  PathTree(const ImageView<float>& speed, const PointList& points, const PointList& names,
    double prolong, const Monitor& monitor)
    : Speed(speed)
    , Names(names)
    , Prolong(prolong)
    , Ask(monitor)
  {
    for (Eigen::Index point = 0; point < points.rows(); ++point)
    {
      const Eigen::Vector3d index = speed.Geometry.ToIndex(points.row(point).transpose());
      std::array<int, 3> voxel;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = std::min(speed.Geometry.Dimensions[axis] - 1,
          std::max(0, static_cast<int>(std::lround(index[axis]))));
      }
      this->Voxels.push_back(speed.Geometry.Offset(voxel[0], voxel[1], voxel[2]));
    }
  }

  std::vector<MinimalPath> Grow()
  {
    if (!this->JoinNearestPair())
    {
      return {};
    }
    while (!this->Open.empty())
    {
      if (!this->JoinNext())
      {
        return {};
      }
    }
    return this->Paths;
  }

private:
  PointList LineOf(const std::vector<std::size_t>& voxels) const
  {
    PointList line(static_cast<Eigen::Index>(voxels.size()), 3);
    for (std::size_t place = 0; place < voxels.size(); ++place)
    {
      const std::size_t voxel = voxels[place];
      line.row(static_cast<Eigen::Index>(place)) = CenterOf(voxel, this->Speed.Geometry);
    }
    return line;
  }

  [[noreturn]] void ThrowUnreached(std::size_t voxel) const
  {
    const auto point = std::find(this->Voxels.begin(), this->Voxels.end(), voxel);
    throw Error(ErrorCode::NoContrast,
      "no path leads to the point " + TextOf(this->Names.row(point - this->Voxels.begin())) +
        " mm; put all points into the same vessel");
  }

  bool JoinNearestPair()
  {
    const Meeting meeting = MeetFronts(this->Speed, this->Voxels, this->Ask);
    if (!this->Ask(0))
    {
      return false;
    }
    if (meeting.Voxels.empty())
    {
      this->ThrowUnreached(this->Voxels[1]);
    }
    // From the point that was given first to the other one.
    std::array<std::vector<std::size_t>, 2> halves;
    for (int side = 0; side < 2; ++side)
    {
      halves[side] = DescendToSource(meeting.Times, this->Speed.Geometry, meeting.Voxels[side]);
    }
    const auto ownerOf = [&](int side) { return meeting.Times.Owners[meeting.Voxels[side]]; };
    if (ownerOf(1) < ownerOf(0))
    {
      halves[0].swap(halves[1]);
    }
    std::vector<std::size_t> chain(halves[0].rbegin(), halves[0].rend());
    chain.insert(chain.end(), halves[1].begin(), halves[1].end());
    for (const std::size_t voxel : this->Voxels)
    {
      if (voxel != chain.front() && voxel != chain.back())
      {
        this->Open.push_back(voxel);
      }
    }
    this->Paths.push_back({ this->LineOf(chain), -1, 0 });
    this->Chains.push_back(std::move(chain));
    return true;
  }

  // The point from which a front first reaches a path: fronts from points are smaller than those
  // from whole paths.
  bool JoinNext()
  {
    std::vector<std::size_t> targets;
    for (const auto& chain : this->Chains)
    {
      targets.insert(targets.end(), chain.begin(), chain.end());
    }
    const Arrivals arrivals = MarchFront(this->Speed, this->Open, targets, 1,
      std::numeric_limits<float>::infinity(), this->Ask);
    if (!this->Ask(0))
    {
      return false;
    }
    if (arrivals.Reached.empty())
    {
      this->ThrowUnreached(this->Open.front());
    }
    const std::vector<std::size_t> way =
      DescendToSource(arrivals, this->Speed.Geometry, arrivals.Reached.front());
    this->Open.erase(std::find(this->Open.begin(), this->Open.end(), way.back()));
    this->Attach(way);
    return true;
  }

  void Attach(const std::vector<std::size_t>& way)
  {
    if (way.size() < 2)
    {
      return; // on a path already
    }
    for (std::size_t path = 0; path < this->Chains.size(); ++path)
    {
      std::vector<std::size_t>& chain = this->Chains[path];
      const auto place = std::find(chain.begin(), chain.end(), way.front());
      if (place == chain.end())
      {
        continue;
      }
      const Eigen::Index junction = place - chain.begin();
      const Eigen::VectorXd lengths = ArcLengths(this->Paths[path].Line);
      const bool isMain = path == 0;
      if (lengths[lengths.size() - 1] - lengths[junction] < this->Prolong)
      {
        chain.erase(place + 1, chain.end());
        chain.insert(chain.end(), way.begin() + 1, way.end());
        this->Paths[path].Line = this->LineOf(chain);
      }
      else if (isMain && lengths[junction] < this->Prolong)
      {
        std::vector<std::size_t> longer(way.rbegin(), way.rend());
        longer.insert(longer.end(), place + 1, chain.end());
        const auto shift =
          static_cast<Eigen::Index>(longer.size()) - static_cast<Eigen::Index>(chain.size());
        for (MinimalPath& other : this->Paths)
        {
          other.Junction += other.Parent == 0 ? shift : 0;
        }
        chain = longer;
        this->Paths[path].Line = this->LineOf(chain);
      }
      else
      {
        this->Chains.push_back(way);
        this->Paths.push_back({ this->LineOf(way), static_cast<int>(path), junction });
      }
      return;
    }
  }

  const ImageView<float>& Speed;
  const PointList& Names; // of the points, in messages
  double Prolong;
  const Monitor& Ask;
  std::vector<std::size_t> Voxels;
  std::vector<std::size_t> Open; // not yet joined
  std::vector<std::vector<std::size_t>> Chains;
  std::vector<MinimalPath> Paths;
};

} // namespace

std::vector<MinimalPath> JoinPoints(const ImageView<float>& speed, const PointList& points,
  const PointList& names, double prolong, const Monitor& monitor)
{
  return PathTree(speed, points, names, prolong, monitor).Grow();
}

} // namespace FlipFree

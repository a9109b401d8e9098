#include "Vessel/MinimalPaths.h"

#include "Error.h"
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
  PathTree(const ImageView<float>& speed, const PointList& points, double prolong,
    const Monitor& monitor)
    : Speed(speed)
    , Points(points)
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
      line.row(static_cast<Eigen::Index>(place)) =
        this->Speed.Geometry.ToPhysical(IndexOf(this->Speed.Geometry, voxel));
    }
    return line;
  }

  // Names the point at a voxel.
  [[noreturn]] void RefusePoint(std::size_t voxel) const
  {
    const auto point = std::find(this->Voxels.begin(), this->Voxels.end(), voxel);
    throw Error(ErrorCode::NoContrast,
      "no path leads to the point " + TextOf(this->Points.row(point - this->Voxels.begin())) +
        " mm; put all points into the same vessel");
  }

  bool JoinNearestPair()
  {
    std::vector<std::vector<std::size_t>> groups;
    for (const std::size_t voxel : this->Voxels)
    {
      groups.push_back({ voxel });
    }
    const Meeting meeting = MeetFronts(this->Speed, groups, false, this->Ask);
    if (!this->Ask(0))
    {
      return false;
    }
    if (meeting.Way.empty())
    {
      this->RefusePoint(this->Voxels[1]);
    }
    this->Chains.push_back(meeting.Way);
    this->Paths.push_back({ this->LineOf(meeting.Way), -1, 0 });
    for (std::size_t point = 0; point < this->Voxels.size(); ++point)
    {
      if (point != meeting.From && point != meeting.To)
      {
        this->Open.push_back(this->Voxels[point]);
      }
    }
    return true;
  }

  bool JoinNext()
  {
    std::vector<std::vector<std::size_t>> groups(1);
    for (const auto& chain : this->Chains)
    {
      groups[0].insert(groups[0].end(), chain.begin(), chain.end());
    }
    for (const std::size_t voxel : this->Open)
    {
      groups.push_back({ voxel });
    }
    const Meeting meeting = MeetFronts(this->Speed, groups, true, this->Ask);
    if (!this->Ask(0))
    {
      return false;
    }
    if (meeting.Way.empty())
    {
      this->RefusePoint(this->Open.front());
    }
    this->Open.erase(this->Open.begin() + static_cast<std::ptrdiff_t>(meeting.To) - 1);
    this->Attach(meeting.Way);
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
  const PointList& Points;
  double Prolong;
  const Monitor& Ask;
  std::vector<std::size_t> Voxels;
  std::vector<std::size_t> Open; // not yet joined
  std::vector<std::vector<std::size_t>> Chains;
  std::vector<MinimalPath> Paths;
};

} // namespace

std::vector<MinimalPath> JoinPoints(const ImageView<float>& speed, const PointList& points,
  double prolong, const Monitor& monitor)
{
  return PathTree(speed, points, prolong, monitor).Grow();
}

} // namespace FlipFree

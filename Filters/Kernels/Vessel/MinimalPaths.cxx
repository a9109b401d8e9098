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

  void RequireReached(const Arrivals& arrivals, const std::vector<std::size_t>& targets) const
  {
    if (arrivals.Reached.empty() && !targets.empty())
    {
      const auto point = std::find(this->Voxels.begin(), this->Voxels.end(), targets.front());
      throw Error(ErrorCode::NoContrast,
        "no path leads to the point " + TextOf(this->Points.row(point - this->Voxels.begin())) +
          " mm; put all points into the same vessel");
    }
  }

  bool JoinNearestPair()
  {
    float earliest = std::numeric_limits<float>::infinity();
    std::vector<std::size_t> best;
    std::size_t from = 0;
    for (std::size_t source = 0; source + 1 < this->Voxels.size(); ++source)
    {
      const std::vector<std::size_t> targets(
        this->Voxels.begin() + static_cast<std::ptrdiff_t>(source) + 1, this->Voxels.end());
      // No later than the nearest pair so far.
      const Arrivals arrivals =
        MarchFront(this->Speed, { this->Voxels[source] }, targets, 1, earliest, this->Ask);
      if (!this->Ask(0))
      {
        return false;
      }
      if (best.empty())
      {
        this->RequireReached(arrivals, targets);
      }
      if (!arrivals.Reached.empty())
      {
        const std::size_t target = arrivals.Reached.front();
        earliest = arrivals.Times[target];
        best = DescendToSource(arrivals, this->Speed.Geometry, target);
        from = source;
      }
    }
    std::reverse(best.begin(), best.end());
    this->Chains.push_back(best);
    this->Paths.push_back({ this->LineOf(best), -1, 0 });
    for (std::size_t point = 0; point < this->Voxels.size(); ++point)
    {
      if (this->Voxels[point] != best.back() && point != from)
      {
        this->Open.push_back(this->Voxels[point]);
      }
    }
    return true;
  }

  bool JoinNext()
  {
    std::vector<std::size_t> sources;
    for (const auto& chain : this->Chains)
    {
      sources.insert(sources.end(), chain.begin(), chain.end());
    }
    const Arrivals arrivals = MarchFront(this->Speed, sources, this->Open, 1,
      std::numeric_limits<float>::infinity(), this->Ask);
    if (!this->Ask(0))
    {
      return false;
    }
    this->RequireReached(arrivals, this->Open);
    const std::size_t target = arrivals.Reached.front();
    this->Open.erase(std::find(this->Open.begin(), this->Open.end(), target));
    std::vector<std::size_t> way = DescendToSource(arrivals, this->Speed.Geometry, target);
    std::reverse(way.begin(), way.end());
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

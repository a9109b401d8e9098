#include "Intensity/LeakDepth.h"

#include "Image/DepthHill.h"
#include "Image/DistanceTransform.h"

#include <cmath>

namespace FlipFree
{
namespace
{

// A neck is narrower than this part of the hill's depth, whose core is deeper than the other part.
constexpr double NeckRatio = 0.85;
constexpr double CoreShare = 0.6;
// No deeper place than a point on top is farther away than this part of its depth.
constexpr double PeakPart = 0.5;
// No organ is deeper than this many seed radii, as far as the seed tells.
constexpr double DeepInSeedRadii = 1.5;

// Else the point lies on the slope of some other depth, such as the organ's own.
bool IsOnTop(const std::vector<float>& squaredDepth, const BlockGrid& grid,
  const Eigen::Vector3d& point, double depth)
{
  double most = 0;
  double away = 0;
  for (std::size_t block = 0; block < squaredDepth.size(); ++block)
  {
    if (squaredDepth[block] > most)
    {
      const double distance = (grid.CenterOf(block) - point).norm();
      if (distance <= depth)
      {
        most = squaredDepth[block];
        away = distance;
      }
    }
  }
  return away < PeakPart * depth;
}

} // namespace

bool FindLeakDepth(const std::vector<unsigned char>& inside, const BlockGrid& grid,
  const Eigen::Vector3d& point, const SeedSphere& seed, bool looksLikeSeed,
  const ParallelFor& parallelFor, const Monitor& monitor, LeakDepth& result)
{
  const std::vector<float> squaredDepth =
    SquaredDistance(inside, grid.Blocks, 0, parallelFor, monitor);
  if (squaredDepth.empty())
  {
    return false;
  }
  const std::size_t own = grid.BlockAt(point);
  const double depth = std::sqrt(squaredDepth[own]);
  const bool isOnTop = IsOnTop(squaredDepth, grid, point, depth);
  result.IsDeep = looksLikeSeed && (depth > DeepInSeedRadii * seed.Radius || isOnTop);
  const DepthHill hill = FindDepthHill(squaredDepth, grid.Blocks, own, grid.BlockAt(seed.Center));
  result.HasNeck =
    !hill.Holds.empty() && isOnTop && std::sqrt(hill.Saddle) < NeckRatio * std::sqrt(hill.Peak);
  result.IsCore.assign(squaredDepth.size(), false);
  if (result.HasNeck)
  {
    const double least = std::max<double>(hill.Saddle, CoreShare * CoreShare * hill.Peak);
    for (std::size_t block = 0; block < squaredDepth.size(); ++block)
    {
      result.IsCore[block] = hill.Holds[block] && squaredDepth[block] >= least;
    }
  }
  return true;
}

} // namespace FlipFree

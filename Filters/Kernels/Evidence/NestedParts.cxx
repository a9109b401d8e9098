#include "Evidence/NestedParts.h"

#include <algorithm>
#include <utility>

namespace FlipFree
{
namespace
{

// How narrow a neck is, in comparison with the smaller of the parts that it connects: up to the
// widest, by steps.
constexpr double WidestNeck = 0.9;
constexpr double NeckStep = 0.1;

} // namespace

NestedParts::NestedParts(std::vector<float> squaredDistances, const ImageGeometry& geometry,
  const std::vector<std::size_t>& seed, double narrowest)
  : Squared(std::move(squaredDistances))
{
  for (int step = 0; narrowest + step * NeckStep < WidestNeck + NeckStep / 2; ++step)
  {
    const double ratio = narrowest + step * NeckStep;
    this->Levels.emplace_back(ratio, FindDistanceParts(this->Squared, geometry, seed, ratio));
  }
}

NestedPart NestedParts::PartAround(std::size_t voxel, const std::vector<std::size_t>& others,
  double top) const
{
  std::vector<std::size_t> part;
  bool isPart = false;
  for (const auto& levelOfRatio : this->Levels)
  {
    const DistanceParts& level = levelOfRatio.second;
    const int own = level.PartOf[voxel];
    if (own == DistanceParts::Outside || level.HoldsSeed[own])
    {
      continue;
    }
    if (!isPart)
    {
      for (std::size_t other = 0; other < level.PartOf.size(); ++other)
      {
        if (level.PartOf[other] == own)
        {
          part.push_back(other);
        }
      }
      isPart = true;
    }
    else
    {
      part.erase(std::remove_if(part.begin(), part.end(),
                   [&](std::size_t other) { return level.PartOf[other] != own; }),
        part.end());
    }
    float peak = 0;
    for (const std::size_t other : part)
    {
      peak = std::max(peak, this->Squared[other]);
    }
    if (this->Squared[voxel] < top * top * peak)
    {
      continue;
    }
    if (std::none_of(others.begin(), others.end(),
          [&](std::size_t other) { return std::binary_search(part.begin(), part.end(), other); }))
    {
      return { std::move(part), levelOfRatio.first };
    }
  }
  return {};
}

} // namespace FlipFree

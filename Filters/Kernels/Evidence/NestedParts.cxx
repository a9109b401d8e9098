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
    this->NeckRatios.push_back(ratio);
    this->Levels.push_back(FindDistanceParts(this->Squared, geometry, seed, ratio));
  }
}

NestedPart NestedParts::PartAround(std::size_t voxel, const std::vector<std::size_t>& others,
  double top) const
{
  std::vector<std::size_t> part;
  bool isPart = false;
  for (std::size_t index = 0; index < this->Levels.size(); ++index)
  {
    const DistanceParts& level = this->Levels[index];
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
      return { std::move(part), this->NeckRatios[index] };
    }
  }
  return {};
}

} // namespace FlipFree

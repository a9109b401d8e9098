#include "LeakControl.h"

#include "BallMorphology.h"

#include <algorithm>

namespace FlipFree
{

void KeepConnected(std::vector<unsigned char>& mask, const ImageGeometry& geometry,
  const std::vector<std::size_t>& sources)
{
  constexpr unsigned char reached = 2;
  const auto& size = geometry.Dimensions;
  const std::size_t row = size[0];
  const std::size_t slice = row * size[1];
  std::vector<std::size_t> front;
  const auto visit = [&](std::size_t voxel)
  {
    if (mask[voxel] == 1)
    {
      mask[voxel] = reached;
      front.push_back(voxel);
    }
  };
  std::for_each(sources.begin(), sources.end(), visit);
  while (!front.empty())
  {
    const std::size_t voxel = front.back();
    front.pop_back();
    const std::size_t i = voxel % row;
    const std::size_t j = voxel / row % size[1];
    const std::size_t k = voxel / slice;
    if (i > 0)
    {
      visit(voxel - 1);
    }
    if (i + 1 < row)
    {
      visit(voxel + 1);
    }
    if (j > 0)
    {
      visit(voxel - row);
    }
    if (j + 1 < static_cast<std::size_t>(size[1]))
    {
      visit(voxel + row);
    }
    if (k > 0)
    {
      visit(voxel - slice);
    }
    if (k + 1 < static_cast<std::size_t>(size[2]))
    {
      visit(voxel + slice);
    }
  }
  for (unsigned char& voxel : mask)
  {
    voxel = voxel == reached;
  }
}

void ControlLeaks(std::vector<unsigned char>& mask, const ImageGeometry& geometry,
  const SeedSphere& seed, const LeakControlSettings& settings, const ParallelFor& parallelFor)
{
  const std::vector<std::size_t> sources = VoxelsInSphere(geometry, seed);
  const auto holdsSeed = [&]
  {
    return std::any_of(sources.begin(), sources.end(),
      [&](std::size_t voxel) { return mask[voxel] != 0; });
  };
  if (settings.ClosingRadius > 0)
  {
    GrowValue(mask, geometry, settings.ClosingRadius, 1, parallelFor);
    GrowValue(mask, geometry, settings.ClosingRadius, 0, parallelFor);
  }
  if (settings.OpeningRadius > 0)
  {
    const std::vector<unsigned char> closed = mask;
    GrowValue(mask, geometry, settings.OpeningRadius, 0, parallelFor);
    if (holdsSeed())
    {
      KeepConnected(mask, geometry, sources);
      GrowValue(mask, geometry, settings.OpeningRadius, 1, parallelFor);
    }
    else
    {
      mask = closed;
    }
  }
  KeepConnected(mask, geometry, sources);
}

} // namespace FlipFree

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

bool ControlLeaks(std::vector<unsigned char>& mask, const ImageGeometry& geometry,
  const SeedSphere& seed, const LeakControlSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  const std::vector<std::size_t> sources = VoxelsInSphere(geometry, seed);
  const auto holdsSeed = [&]
  {
    return std::any_of(sources.begin(), sources.end(),
      [&](std::size_t voxel) { return mask[voxel] != 0; });
  };
  const auto grow = [&](double radius, unsigned char value, double first, double last)
  { return GrowValue(mask, geometry, radius, value, parallelFor, PartOf(monitor, first, last)); };
  if (settings.ClosingRadius > 0 &&
    !(grow(settings.ClosingRadius, 1, 0, 0.15) && grow(settings.ClosingRadius, 0, 0.15, 0.3)))
  {
    return false;
  }
  if (settings.OpeningRadius > 0)
  {
    const std::vector<unsigned char> closed = mask;
    if (!grow(settings.OpeningRadius, 0, 0.3, 0.6))
    {
      return false;
    }
    if (!holdsSeed())
    {
      mask = closed;
    }
    else
    {
      if (!monitor(0.6))
      {
        return false;
      }
      KeepConnected(mask, geometry, sources);
      if (!grow(settings.OpeningRadius, 1, 0.6, 0.9))
      {
        return false;
      }
    }
  }
  if (!monitor(0.9))
  {
    return false;
  }
  KeepConnected(mask, geometry, sources);
  return true;
}

} // namespace FlipFree

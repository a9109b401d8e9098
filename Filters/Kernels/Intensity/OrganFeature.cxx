#include "Intensity/OrganFeature.h"

#include "Error.h"
#include "Image/BallMorphology.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace FlipFree
{
namespace
{

// A region with less background than this part has no contrast.
constexpr double MinimumBackground = 1e-3;

} // namespace

bool FindForeground(const ImageView<float>& smooth, const IntensityModel& model,
  const SeedSphere& seed, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground)
{
  if (!monitor(0))
  {
    return false;
  }
  foreground = model.Foreground(smooth, WholeBox(smooth.Geometry), parallelFor);
  if (settings.ControlLeaks &&
    !ControlLeaks(foreground, seed, RadiiOf(settings.Leaks, seed.Radius, smooth.Geometry),
      parallelFor, PartOf(monitor, 0.1, 1)))
  {
    return false;
  }
  RemoveNoData(ReaderOf(smooth), parallelFor, foreground); // that leak control has closed
  return true;
}

bool FindForegroundInBox(const ImageView<float>& smooth, const VoxelBox& box,
  const IntensityModel& model, const SeedSphere& seed, const LeakControlRadii& leaks,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground)
{
  if (!WholeBox(smooth.Geometry).Holds(box))
  {
    throw Error(ErrorCode::OutOfRange,
      "a box in which foreground is sought must lie in the image; crop it");
  }
  if (!monitor(0))
  {
    return false;
  }
  BitMask part = model.Foreground(smooth, box, parallelFor);
  // The seed's voxels on the whole grid, whose rounding decides.
  std::vector<std::size_t> sources;
  for (const std::size_t voxel : VoxelsInSphere(smooth.Geometry, seed))
  {
    std::array<int, 3> index = IndexOf(voxel, smooth.Geometry);
    std::transform(index.begin(), index.end(), box.Begin.begin(), index.begin(), std::minus<>());
    if (!part.GetGeometry().Contains(index[0], index[1], index[2]))
    {
      throw Error(ErrorCode::OutOfRange,
        "a box in which foreground is sought must hold the seed sphere; widen it");
    }
    sources.push_back(part.GetGeometry().Offset(index[0], index[1], index[2]));
  }
  if (!ControlLeaks(part, sources, leaks, parallelFor, PartOf(monitor, 0.1, 1)))
  {
    return false;
  }
  RemoveNoData(ReaderOf(smooth, box.Begin), parallelFor, part);
  foreground = BitMask(smooth.Geometry);
  foreground.Insert(part, box.Begin);
  return true;
}

std::array<int, 3> ForegroundMargin(const ImageGeometry& geometry, const LeakControlRadii& leaks)
{
  const std::array<int, 3> closing = BallReach(leaks.Closing, geometry);
  const std::array<int, 3> opening = BallReach(leaks.Opening, geometry);
  std::array<int, 3> margin{};
  for (int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = 2 * closing[axis] + opening[axis] + 1;
  }
  return margin;
}

std::vector<float> MakeFeature(const ImageView<float>& smooth, const IntensityModel& model,
  const BitMask& foreground, const ParallelFor& parallelFor)
{
  const auto& size = smooth.Geometry.Dimensions;
  const float threshold = model.ThresholdRoundedUp();
  const float below = 0.5F * threshold;
  std::vector<float> feature(smooth.Geometry.NumberOfVoxels());
  parallelFor(0, size[2],
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (int k = static_cast<int>(first); k < last; ++k)
      {
        for (int j = 0; j < size[1]; ++j)
        {
          for (int i = 0; i < size[0]; ++i)
          {
            const float value = model(smooth(i, j, k));
            const bool wanted = foreground(i, j, k);
            float& result = feature[smooth.Geometry.Offset(i, j, k)];
            result = (value >= model.Threshold) == wanted ? value : (wanted ? threshold : below);
            if (!wanted && !HasData(smooth(i, j, k)))
            {
              result = std::numeric_limits<float>::quiet_NaN();
            }
          }
        }
      }
    });
  return feature;
}

void RequireContrast(const BitMask& foreground)
{
  const std::size_t size = foreground.GetGeometry().NumberOfVoxels();
  const std::size_t background = size - foreground.Count();
  if (static_cast<double>(background) < MinimumBackground * static_cast<double>(size))
  {
    throw Error(ErrorCode::NoContrast,
      "the seed has no contrast to its surroundings: of the " + std::to_string(size) +
        " voxels within reach only " + std::to_string(background) +
        " differ from its intensities; check the image, or narrow the foreground's intensities "
        "({ForegroundMass}, {NoiseWidening})");
  }
}

} // namespace FlipFree

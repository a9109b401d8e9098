#include "OrganFeature.h"

#include "SurfaceVoxelisation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace FlipFree
{
namespace
{

// Fewer voxels do not make a histogram.
constexpr std::size_t LeastSample = 200;
// A region with a smaller part of background than this has no contrast.
constexpr double LeastBackground = 1e-3;

} // namespace

IntensityModel FitToSeed(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const IntensitySettings& settings)
{
  std::vector<float> values;
  for (std::size_t voxel : VoxelsInSphere(smooth.Geometry, seed))
  {
    if (!std::isfinite(smooth.Data[voxel]))
    {
      throw std::invalid_argument(
        "the seed sphere holds voxels that are not finite numbers; replace them first");
    }
    values.push_back(smooth.Data[voxel]);
  }
  if (values.empty())
  {
    throw std::invalid_argument(
      "no voxel centre lies in the seed sphere; enlarge its radius beyond "
      "a voxel, or move its centre into the image");
  }
  return IntensityModel::FromSeed(values, noise, settings);
}

bool RefitToSurface(const ImageView<float>& smooth, const PointList& points,
  const TriangleList& triangles, double noise, const IntensitySettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor, IntensityModel& model)
{
  // Remembers, since no voxels at all may also mean that the surface holds none.
  bool stopped = false;
  const Monitor proceed = [&](double fraction)
  {
    stopped = stopped || !monitor(fraction);
    return !stopped;
  };
  std::vector<unsigned char> mask(smooth.Geometry.NumberOfVoxels(), 0);
  FillRuns<unsigned char>(
    VoxeliseSurface(points, triangles, smooth.Geometry, parallelFor, PartOf(proceed, 0, 0.2)), 1,
    smooth.Geometry, mask.data());
  std::vector<float> inside;
  std::vector<float> shell;
  if (!SampleInsideAndShell(smooth, mask, settings, parallelFor, PartOf(proceed, 0.2, 0.9), inside,
        shell) ||
    !proceed(0.9))
  {
    return false;
  }
  if (inside.size() > LeastSample)
  {
    model.Reestimate(inside, shell, noise, settings);
  }
  return true;
}

std::vector<float> MakeFeature(const ImageView<float>& smooth, const IntensityModel& model,
  const SeedSphere& seed, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  if (!monitor(0))
  {
    return {};
  }
  const auto size = static_cast<std::ptrdiff_t>(smooth.Geometry.NumberOfVoxels());
  // The mask first, since the feature and what leak control needs would be too much at once.
  std::vector<unsigned char> mask;
  if (settings.ControlLeaks)
  {
    mask.resize(size);
    parallelFor(0, size,
      [&](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        std::transform(smooth.Data + first, smooth.Data + last, mask.begin() + first,
          [&model](float z) { return static_cast<unsigned char>(model(z) >= model.Threshold); });
      });
    if (!ControlLeaks(mask, smooth.Geometry, seed, settings.Leaks, parallelFor,
          PartOf(monitor, 0.1, 0.9)))
    {
      return {};
    }
  }
  if (!monitor(0.9))
  {
    return {};
  }
  // Rounded towards the foreground, so that a voxel at the threshold stays above it as a double.
  const float threshold =
    std::nextafter(static_cast<float>(model.Threshold), std::numeric_limits<float>::infinity());
  const float below = 0.5F * threshold;
  std::vector<float> feature(size);
  parallelFor(0, size,
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t voxel = first; voxel < last; ++voxel)
      {
        const float value = model(smooth.Data[voxel]);
        feature[voxel] = mask.empty() ? value
          : mask[voxel]               ? std::max(value, threshold)
                                      : std::min(value, below);
      }
    });
  return feature;
}

void RequireContrast(const std::vector<float>& feature, double threshold)
{
  const auto background = std::count_if(feature.begin(), feature.end(),
    [threshold](float value) { return value < threshold; });
  if (static_cast<double>(background) < LeastBackground * static_cast<double>(feature.size()))
  {
    throw std::invalid_argument("the seed has no contrast to its surroundings: of the " +
      std::to_string(feature.size()) + " voxels within reach only " + std::to_string(background) +
      " differ from its intensities; check the image, or narrow the foreground's intensities "
      "(ForegroundMass, NoiseWidening)");
  }
}

} // namespace FlipFree

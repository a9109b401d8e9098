#include "Intensity/OrganFeature.h"

#include "Error.h"
#include "Image/BallMorphology.h"
#include "Image/FloatOrder.h"
#include "Mesh/SurfaceVoxelization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace FlipFree
{
namespace
{

// A region with a smaller part of background than this has no contrast.
constexpr double MinimumBackground = 1e-3;

// All voxels within millimeters along the axes of the runs, of which there is one at least, and one
// more, which is not in them.
VoxelBox BoxAround(const std::vector<VoxelRun>& runs, const ImageGeometry& geometry, double reach)
{
  VoxelBox box{ geometry.Dimensions, { { 0, 0, 0 } } };
  const auto include = [&box](int axis, int begin, int end)
  {
    box.Begin[axis] = std::min(box.Begin[axis], begin);
    box.End[axis] = std::max(box.End[axis], end);
  };
  for (const VoxelRun& run : runs)
  {
    include(0, run.Begin, run.End);
    include(1, run.J, run.J + 1);
    include(2, run.K, run.K + 1);
  }
  std::array<int, 3> voxels = BallReach(reach, geometry);
  for (int& more : voxels)
  {
    ++more;
  }
  return box.Widened(voxels, { { { 0, 0, 0 } }, geometry.Dimensions });
}

} // namespace

IntensityModel FitToSeed(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const IntensitySettings& settings)
{
  std::vector<float> values;
  for (std::size_t voxel : VoxelsInSphere(smooth.Geometry, seed))
  {
    if (!std::isfinite(smooth.Data[voxel]))
    {
      throw Error(ErrorCode::NonFiniteValue,
        "the seed sphere holds voxels that are not finite numbers; replace them first");
    }
    values.push_back(smooth.Data[voxel]);
  }
  if (values.empty())
  {
    throw Error(ErrorCode::SeedWithoutVoxels,
      "no voxel center lies in the seed sphere; enlarge its radius beyond "
      "a voxel, or move its center into the image");
  }
  return IntensityModel::FromSeed(values, noise, settings);
}

Refit RefitToSurface(const ImageView<float>& smooth, const PointList& points,
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
  // In the index space of the whole, so that its rounding decides; the rest in a box.
  const std::vector<VoxelRun> runs =
    VoxelizeSurface(points, triangles, smooth.Geometry, parallelFor, PartOf(proceed, 0, 0.2));
  if (runs.empty())
  {
    return stopped ? Refit::Stopped : Refit::NothingInside;
  }
  const VoxelBox box = BoxAround(runs, smooth.Geometry, settings.ShellEnd);
  const auto [i, j, k] = box.Begin;
  BitMask inside(CropGeometry(smooth.Geometry, box));
  for (const VoxelRun& run : runs)
  {
    inside.InsertRun(run.Begin - i, run.End - i, run.J - j, run.K - k);
  }
  BitMask shell;
  if (!MakeInsideAndShell(settings, parallelFor, PartOf(proceed, 0.2, 0.9), inside, shell) ||
    !proceed(0.9))
  {
    return Refit::Stopped;
  }
  if (inside.Count() <= MinimumRefitSample)
  {
    return Refit::TooFewInside;
  }
  model.Reestimate(smooth, box.Begin, inside, shell, noise, settings, parallelFor);
  return Refit::Done;
}

bool FindForeground(const ImageView<float>& smooth, const IntensityModel& model,
  const SeedSphere& seed, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground)
{
  if (!monitor(0))
  {
    return false;
  }
  foreground = VoxelsIn(model.Foreground(), smooth, { { { 0, 0, 0 } }, smooth.Geometry.Dimensions },
    parallelFor);
  return !settings.ControlLeaks ||
    ControlLeaks(foreground, seed, RadiiOf(settings.Leaks, seed.Radius, smooth.Geometry),
      parallelFor, PartOf(monitor, 0.1, 1));
}

bool FindForegroundInBox(const ImageView<float>& smooth, const VoxelBox& box,
  const IntensityModel& model, const SeedSphere& seed, const LeakControlRadii& leaks,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& foreground)
{
  const auto [i, j, k] = box.Begin;
  if (i % BitMask::BitsOfWord != 0)
  {
    throw std::invalid_argument(
      "a box in which foreground is looked for must begin at a multiple of " +
      std::to_string(BitMask::BitsOfWord) + " along x, and not at " + std::to_string(i));
  }
  if (!VoxelBox{ { { 0, 0, 0 } }, smooth.Geometry.Dimensions }.Holds(box))
  {
    throw std::invalid_argument(
      "a box in which foreground is looked for must lie in the image; cut it off there");
  }
  if (!monitor(0))
  {
    return false;
  }
  BitMask part = VoxelsIn(model.Foreground(), smooth, box, parallelFor);
  const ImageGeometry geometry = part.GetGeometry();
  // As the whole image finds them, so that its rounding decides.
  std::vector<std::size_t> sources;
  for (const std::size_t voxel : VoxelsInSphere(smooth.Geometry, seed))
  {
    const auto& size = smooth.Geometry.Dimensions;
    const std::size_t row = voxel / size[0];
    const std::array<int, 3> index{ { static_cast<int>(voxel % size[0]) - i,
      static_cast<int>(row % size[1]) - j, static_cast<int>(row / size[1]) - k } };
    if (!geometry.Contains(index[0], index[1], index[2]))
    {
      throw std::invalid_argument(
        "a box in which foreground is looked for must hold the seed sphere; widen it");
    }
    sources.push_back(geometry.Offset(index[0], index[1], index[2]));
  }
  if (!ControlLeaks(part, sources, leaks, parallelFor, PartOf(monitor, 0.1, 1)))
  {
    return false;
  }
  foreground = BitMask(smooth.Geometry);
  for (int slice = 0; slice < geometry.Dimensions[2]; ++slice)
  {
    for (int row = 0; row < geometry.Dimensions[1]; ++row)
    {
      std::copy_n(part.Row(row, slice), part.GetWordsPerRow(),
        foreground.Row(j + row, k + slice) + i / BitMask::BitsOfWord);
    }
  }
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
  const float threshold = MinimumFloatFrom(model.Threshold);
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
            feature[smooth.Geometry.Offset(i, j, k)] =
              (value >= model.Threshold) == wanted ? value : (wanted ? threshold : below);
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

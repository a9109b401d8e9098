#include "Intensity/ModelFit.h"

#include "Error.h"
#include "Image/BallMorphology.h"
#include "Image/NoData.h"
#include "Mesh/SurfaceVoxelization.h"

#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

// The box of all voxels within a distance of the runs, of which there is at least one, with one
// more voxel on each side.
VoxelBox DilatedBounds(const std::vector<VoxelRun>& runs, const ImageGeometry& geometry,
  double reach)
{
  VoxelBox box;
  for (const VoxelRun& run : runs)
  {
    box = box.Joined({ { { run.Begin, run.J, run.K } }, { { run.End, run.J + 1, run.K + 1 } } });
  }
  std::array<int, 3> voxels = BallReach(reach, geometry);
  for (int& more : voxels)
  {
    ++more;
  }
  return box.Widened(voxels, WholeBox(geometry));
}

} // namespace

IntensityModel FitToSeed(const ImageView<float>& smooth, const SeedSphere& seed, double noise,
  const IntensitySettings& settings)
{
  RequireData(ReaderOf(smooth), smooth.Geometry, seed);
  std::vector<float> values;
  for (std::size_t voxel : VoxelsInSphere(smooth.Geometry, seed))
  {
    values.push_back(smooth.Data[voxel]);
  }
  if (values.empty())
  {
    throw Error(ErrorCode::SeedWithoutVoxels,
      "no voxel center lies in the seed sphere; raise {SeedRadius} beyond a voxel, or move the "
      "sphere onto one");
  }
  return IntensityModel::FromSeed(values, noise, settings);
}

Refit RefitToSurface(const ImageView<float>& smooth, const PointList& points,
  const TriangleList& triangles, double noise, const IntensitySettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor, IntensityModel& model)
{
  // Voxelized on the whole grid, whose rounding decides; the rest is done in a box.
  std::vector<VoxelRun> runs;
  if (!VoxelizeSurface(points, triangles, smooth.Geometry, parallelFor, PartOf(monitor, 0, 0.2),
        runs))
  {
    return Refit::Stopped;
  }
  if (runs.empty())
  {
    return Refit::NothingInside;
  }
  const VoxelBox box = DilatedBounds(runs, smooth.Geometry, settings.ShellEnd);
  BitMask inside(CropGeometry(smooth.Geometry, box));
  inside.InsertRuns(runs, box.Begin);
  return RefitToInside(smooth, box.Begin, std::move(inside), noise, settings, parallelFor,
    PartOf(monitor, 0.2, 1), model);
}

Refit RefitToInside(const ImageView<float>& smooth, const std::array<int, 3>& first, BitMask inside,
  double noise, const IntensitySettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, IntensityModel& model)
{
  BitMask shell;
  if (!MakeInsideAndShell(settings, parallelFor, monitor, inside, shell))
  {
    return Refit::Stopped;
  }
  if (inside.Count() <= MinimumRefitSample)
  {
    return Refit::TooFewInside;
  }
  model.Reestimate(smooth, first, inside, shell, noise, settings, parallelFor);
  return Refit::Done;
}

bool MakeInsideAndShell(const IntensitySettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& inside, BitMask& shell)
{
  shell = inside;
  if (!Dilate(shell, settings.ShellEnd, parallelFor, PartOf(monitor, 0, 0.5)))
  {
    return false;
  }
  BitMask rim = inside;
  if (!Dilate(rim, settings.ShellBegin, parallelFor, PartOf(monitor, 0.5, 0.7)))
  {
    return false;
  }
  shell.Remove(rim);
  rim = BitMask();
  return Erode(inside, settings.InnerMargin, parallelFor, PartOf(monitor, 0.7, 0.9)) &&
    monitor(0.9);
}

} // namespace FlipFree

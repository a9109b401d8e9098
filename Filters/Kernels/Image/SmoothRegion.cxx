#include "Image/SmoothRegion.h"

#include "Error.h"
#include "Image/NoData.h"
#include "MessageText.h"

#include <algorithm>

namespace FlipFree
{

double ReachOf(const SmoothingSettings& settings, double seedRadius)
{
  constexpr double radii = 10;
  constexpr double minimum = 100;
  constexpr double maximum = 250;
  return settings.Reach > 0 ? settings.Reach
                            : std::max(minimum, std::min(maximum, radii * seedRadius));
}

void RequireReach(const SmoothingSettings& settings, double seedRadius)
{
  const double reach = settings.Reach;
  constexpr double rounding = 1e-6;
  if (reach > 0 && reach < (1 - rounding) * seedRadius)
  {
    throw Error(ErrorCode::OutOfRange,
      "{Reach} is " + TextOf(reach) + " mm, less than the seed's radius of " + TextOf(seedRadius) +
        " mm; raise {Reach}, or lower {SeedRadius}");
  }
}

AnisotropicDiffusionSettings DiffusionOf(const SmoothingSettings& settings,
  double noiseStandardDeviation)
{
  AnisotropicDiffusionSettings diffusion;
  diffusion.Iterations = settings.Iterations;
  diffusion.Contrast = ContrastOfNoise(noiseStandardDeviation);
  return diffusion;
}

SmoothRegion::SmoothRegion(VoxelReader read, const ImageGeometry& geometry,
  const AnisotropicDiffusionSettings& settings, ParallelFor parallelFor, bool complete)
  : Read(std::move(read))
  , Geometry(geometry)
  , Settings(settings)
  , Parallel(std::move(parallelFor))
  , NoData(complete ? BitMask() : FindNoData(this->Read, geometry, this->Parallel))
  , Voxels(new float[geometry.NumberOfVoxels()]) // uninitialized, so that no page is touched
{
}

bool SmoothRegion::MakeAll(const Monitor& monitor)
{
  this->Made = WholeBox(this->Geometry);
  return DiffuseAnisotropically(this->Read, this->Geometry, this->Settings, this->Parallel, monitor,
    this->Voxels.get());
}

bool SmoothRegion::Make(const VoxelBox& wanted, const Monitor& monitor)
{
  if (this->Made.Holds(wanted))
  {
    return true;
  }
  if (this->Settings.Iterations > DiffusionIterationsAtOnce)
  {
    return this->MakeAll(monitor);
  }
  const auto make = [this, &monitor](const VoxelBox& box)
  {
    return DiffuseBox(this->Read, this->Geometry, this->Settings, box, this->Parallel, monitor,
      this->Voxels.get());
  };
  if (this->Made.IsEmpty())
  {
    this->Made = wanted;
    return make(wanted);
  }
  // What is missing, side by side.
  const VoxelBox grown = this->Made.Joined(wanted);
  VoxelBox rest = grown;
  for (int axis = 2; axis >= 0; --axis)
  {
    VoxelBox before = rest;
    before.End[axis] = this->Made.Begin[axis];
    VoxelBox behind = rest;
    behind.Begin[axis] = this->Made.End[axis];
    if ((!before.IsEmpty() && !make(before)) || (!behind.IsEmpty() && !make(behind)))
    {
      return false;
    }
    rest.Begin[axis] = this->Made.Begin[axis];
    rest.End[axis] = this->Made.End[axis];
  }
  this->Made = grown;
  return true;
}

} // namespace FlipFree

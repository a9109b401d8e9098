#include "Intensity/OrganForeground.h"

#include "Stopwatch.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// What is smoothed before anything is known of the organ, in seed radii around the seed's center.
constexpr double FirstReach = 3;
// By how much of its size the box grows on a side that the foreground has reached.
constexpr double Growth = 0.25;

// For leak control, and for the intensities that are read around the foreground's rim.
std::array<int, 3> MarginOf(const ImageGeometry& geometry, const LeakControlRadii& leaks,
  double rim)
{
  std::array<int, 3> margin = ForegroundMargin(geometry, leaks);
  const Eigen::Vector3d voxels = geometry.IndexReach(rim + geometry.Spacing.minCoeff());
  for (int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = std::max(margin[axis], static_cast<int>(std::ceil(voxels[axis])) + 2);
  }
  return margin;
}

} // namespace

OrganForeground::OrganForeground(SmoothRegion& region, const SeedSphere& seed,
  const OrganFeatureSettings& settings, double rim, const ParallelFor& parallelFor)
  : Region(region)
  , Geometry(region.View().Geometry)
  , Whole(WholeBox(this->Geometry))
  , Seed(seed)
  , Settings(settings)
  , Parallel(parallelFor)
  , Leaks(RadiiOf(settings.Leaks, seed.Radius, this->Geometry))
  , Margin(MarginOf(this->Geometry, this->Leaks, rim))
{
}

bool OrganForeground::Smooth(const VoxelBox& box, const Monitor& monitor)
{
  Stopwatch watch;
  const bool made = this->Region.Make(box, monitor);
  this->SmoothingSeconds += watch.Lap();
  return made;
}

bool OrganForeground::SmoothAroundSeed(const Monitor& monitor)
{
  return this->Smooth(this->Settings.ControlLeaks
      ? this->BoundsOfBalls(this->Seed.Center.transpose(), FirstReach * this->Seed.Radius,
          ForegroundMargin(this->Geometry, this->Leaks))
      : this->Whole,
    monitor);
}

bool OrganForeground::SmoothAround(const PointList& points, double reach, const Monitor& monitor)
{
  return this->Smooth(this->BoundsOfBalls(points, reach, { { 2, 2, 2 } }), monitor);
}

VoxelBox OrganForeground::BoundsOfBalls(const PointList& points, double reach,
  const std::array<int, 3>& margin) const
{
  return BoxAroundPoints(this->Geometry, points, reach).Widened(margin, this->Whole);
}

// At first all that has been smoothed; later where the foreground was before, and the seed.
VoxelBox OrganForeground::FirstSearched() const
{
  const VoxelBox made = this->Region.GetMade();
  if (this->Bounds.IsEmpty())
  {
    return made;
  }
  // A little more than the margin that the foreground must keep, so that it may grow a little.
  std::array<int, 3> margin = this->Margin;
  for (int& voxels : margin)
  {
    voxels += voxels / 2;
  }
  return this->Bounds.Joined(BoxAround(this->Geometry, this->Seed.Center, this->Seed.Radius))
    .Widened(margin, made);
}

// Widens the box on the sides that the foreground has come near.
VoxelBox OrganForeground::Grown(const VoxelBox& searched) const
{
  VoxelBox box = searched;
  for (int axis = 0; axis < 3 && !this->Bounds.IsEmpty(); ++axis)
  {
    const int size = this->Geometry.Dimensions[axis];
    const int margin = this->Margin[axis];
    const int step = std::max(margin, static_cast<int>(Growth * searched.Size(axis)));
    if (searched.Begin[axis] > 0 && this->Bounds.Begin[axis] - margin < searched.Begin[axis])
    {
      box.Begin[axis] = std::max(0, searched.Begin[axis] - step);
    }
    if (searched.End[axis]<size&& this->Bounds.End[axis] + margin> searched.End[axis])
    {
      box.End[axis] = std::min(size, searched.End[axis] + step);
    }
  }
  return box;
}

bool OrganForeground::Update(const IntensityModel& model, const Monitor& monitor)
{
  if (!this->Settings.ControlLeaks)
  {
    return FindForeground(this->GetImage(), model, this->Seed, this->Settings, this->Parallel,
      monitor, this->Mask);
  }
  VoxelBox searched = this->FirstSearched();
  while (FindForegroundInBox(this->GetImage(), searched, model, this->Seed, this->Leaks,
    this->Parallel, monitor, this->Mask))
  {
    this->Bounds = this->Mask.Bounds();
    const VoxelBox grown = this->Grown(searched);
    if (searched.Holds(grown))
    {
      return true;
    }
    searched = grown;
    this->Clear(); // smoothing needs the memory
    if (!this->Smooth(grown, monitor))
    {
      return false;
    }
  }
  return false;
}

Modality OrganForeground::GetModality() const
{
  return ResolveModality(this->Settings.Modality, this->Region.GetReader(), this->Geometry);
}

void OrganForeground::SetMask(BitMask mask)
{
  this->Mask = std::move(mask);
  this->Bounds = this->Mask.Bounds();
}

} // namespace FlipFree

#include "Evidence/TissueGrowth.h"

#include "Intensity/ModelFit.h"
#include "Intensity/OrganForeground.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

// The sphere around a point that it grows from, in millimeters and voxels.
constexpr double TissueSeed = 4;
constexpr double TissueSeedVoxels = 2;

// As many as a stroke may have points, and more.
constexpr std::size_t MostKept = 128;

} // namespace

TissueGrowth::TissueGrowth(SmoothRegion& region, double noise, const OrganFeatureSettings& settings,
  const ParallelFor& parallelFor)
  : Region(region)
  , Noise(noise)
  , Settings(settings)
  , Parallel(parallelFor)
{
}

std::shared_ptr<const MaskPart> TissueGrowth::From(const Eigen::Vector3d& place,
  const Monitor& monitor)
{
  const auto kept = std::find_if(this->Kept.begin(), this->Kept.end(),
    [&](const auto& other) { return other.first == place; });
  if (kept != this->Kept.end())
  {
    return kept->second;
  }
  const auto tissue = std::make_shared<MaskPart>();
  if (!this->Grow(place, monitor, *tissue))
  {
    return nullptr;
  }
  if (this->Kept.size() == MostKept)
  {
    this->Kept.erase(this->Kept.begin());
  }
  this->Kept.emplace_back(place, tissue);
  return tissue;
}

bool TissueGrowth::Grow(const Eigen::Vector3d& place, const Monitor& monitor, MaskPart& tissue)
{
  const ImageGeometry& geometry = this->Region.View().Geometry;
  // Between thick slices, a sphere may hold no voxel.
  const std::array<int, 3> nearest = NearestVoxel(geometry, place);
  const Eigen::Vector3d center =
    geometry.ToPhysical(Eigen::Vector3d(nearest[0], nearest[1], nearest[2]));
  const SeedSphere seed{ center,
    std::max(TissueSeed, TissueSeedVoxels * geometry.Spacing.minCoeff()) };
  OrganForeground growing(this->Region, seed, this->Settings, 0, this->Parallel);
  if (!growing.SmoothAroundSeed(monitor))
  {
    return false;
  }
  BitMask start(geometry);
  const BitMask& noData = this->Region.GetNoData();
  for (const std::size_t voxel : VoxelsInSphere(geometry, seed))
  {
    if (noData.HasGrid() && noData(voxel))
    {
      return true;
    }
    start.Insert(voxel);
  }
  const IntensityModel model =
    FitToSeed(growing.GetImage(), seed, this->Noise, this->Settings.Intensity);
  growing.SetMask(std::move(start)); // what is searched begins there
  if (!growing.Update(model, monitor))
  {
    return false;
  }
  const BitMask found = growing.TakeMask();
  tissue.Box = found.Bounds();
  tissue.Voxels = found.Cropped(tissue.Box);
  return true;
}

} // namespace FlipFree

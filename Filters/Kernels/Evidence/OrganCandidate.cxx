#include "Evidence/OrganCandidate.h"

#include "Intensity/LeakControl.h"
#include "Intensity/ModelFit.h"

#include <algorithm>

namespace FlipFree
{

bool AddForeground(const ImageView<float>& smooth, const ImageMaker& makeSmooth,
  const SeedSphere& seed, double noise, const OrganFeatureSettings& settings,
  const OrganCandidateSettings& limits, const ParallelFor& parallelFor, const Monitor& monitor,
  BitMask& mask)
{
  if (settings.Modality != Modality::CT || !settings.ControlLeaks ||
    !settings.ReestimateIntensities)
  {
    return true;
  }
  const ImageGeometry& geometry = smooth.Geometry;
  const LeakControlRadii leaks = RadiiOf(settings.Leaks, seed.Radius, geometry);
  const VoxelBox reach =
    WidenedBy(mask.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)),
      std::max(limits.Reach, settings.Intensity.ShellEnd), 1, geometry);
  const VoxelBox searched = reach.Widened(ForegroundMargin(geometry, leaks), WholeBox(geometry));
  if (!makeSmooth(searched))
  {
    return false;
  }
  IntensityModel model = FitToSeed(smooth, seed, noise, settings.Intensity);
  const Refit refit = RefitToInside(smooth, reach.Begin, mask.Cropped(reach), noise,
    settings.Intensity, parallelFor, PartOf(monitor, 0, 0.4), model);
  if (refit != Refit::Done)
  {
    return refit != Refit::Stopped;
  }
  BitMask found;
  if (!FindForegroundInBox(smooth, searched, model, seed, leaks, parallelFor,
        PartOf(monitor, 0.4, 0.9), found))
  {
    return false;
  }
  if (static_cast<double>(found.Count()) >
    limits.GreatestGrowth * static_cast<double>(mask.Count()))
  {
    return true;
  }
  BitMask within(geometry);
  within.Insert(found.Cropped(reach), reach.Begin);
  mask.Unite(within);
  return KeepConnected(mask, VoxelsAround(geometry, seed), PartOf(monitor, 0.9, 1));
}

} // namespace FlipFree

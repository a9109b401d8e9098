#include "Evidence/OrganCandidate.h"

#include "Intensity/LeakControl.h"
#include "Intensity/ModelFit.h"

#include <algorithm>

namespace FlipFree
{

bool AddForeground(const ImageView<float>& smooth, const ImageMaker& makeSmooth,
  const PointList& points, const TriangleList& triangles, const SeedSphere& seed, double noise,
  const OrganFeatureSettings& settings, const OrganCandidateSettings& limits,
  const ParallelFor& parallelFor, const Monitor& monitor, BitMask& mask)
{
  if (settings.Modality != Modality::CT || !settings.ControlLeaks ||
    !settings.ReestimateIntensities)
  {
    return true;
  }
  const ImageGeometry& geometry = smooth.Geometry;
  const VoxelBox box =
    WidenedBy(mask.Bounds().Joined(BoxAround(geometry, seed.Center, seed.Radius)),
      std::max(limits.Reach, settings.Intensity.ShellEnd), 1, geometry);
  if (!makeSmooth(box))
  {
    return false;
  }
  IntensityModel model = FitToSeed(smooth, seed, noise, settings.Intensity);
  if (RefitToSurface(smooth, points, triangles, noise, settings.Intensity, parallelFor,
        PartOf(monitor, 0, 0.4), model) == Refit::Stopped)
  {
    return false;
  }
  BitMask found;
  if (!FindForegroundInBox(smooth, box, model, seed, RadiiOf(settings.Leaks, seed.Radius, geometry),
        parallelFor, PartOf(monitor, 0.4, 0.9), found))
  {
    return false;
  }
  if (static_cast<double>(found.Count()) >
    limits.GreatestGrowth * static_cast<double>(mask.Count()))
  {
    return true;
  }
  mask.Unite(found);
  return KeepConnected(mask, VoxelsAround(geometry, seed), PartOf(monitor, 0.9, 1));
}

} // namespace FlipFree

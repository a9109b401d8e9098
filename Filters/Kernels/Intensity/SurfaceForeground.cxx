#include "Intensity/SurfaceForeground.h"

#include "Intensity/OrganCarving.h"
#include "Intensity/OrganConsensus.h"

namespace FlipFree
{

bool ForegroundOfSurface(const ImageView<float>& smooth, const ImageMaker& make,
  const PointList& points, const TriangleList& triangles, const SeedSphere& seed, double noise,
  Modality modality, const OrganFeatureSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, double& unanimity)
{
  // No runs may mean a stop or a surface that holds no voxel.
  const RememberingMonitor remembering(monitor);
  const Monitor& proceed = remembering.Get();
  const std::vector<VoxelRun> inside =
    VoxelizeSurface(points, triangles, smooth.Geometry, parallelFor, PartOf(proceed, 0, 0.1));
  if (remembering.HasStopped() || !make(CarvingBox(smooth.Geometry, inside, seed)) ||
    !CarveOrgan(smooth, inside, seed, noise, modality, parallelFor, PartOf(proceed, 0.1, 0.4),
      foreground))
  {
    return false;
  }
  unanimity = 1;
  const bool seeks = settings.Consensus && settings.ControlLeaks && IsDoubtful(inside, foreground);
  return !seeks ||
    (make(ConsensusBox(foreground, seed)) &&
      SeekConsensus(smooth, seed, noise, modality, settings, parallelFor, PartOf(proceed, 0.4, 1),
        foreground, &unanimity));
}

} // namespace FlipFree

#include "Intensity/CarvedForeground.h"

#include "Intensity/OrganCarving.h"
#include "Intensity/OrganConsensus.h"

namespace FlipFree
{

bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, double& unanimity)
{
  const ImageView<float>& smooth = inputs.Smooth;
  const SeedSphere& seed = inputs.Seed;
  const OrganFeatureSettings& settings = inputs.Settings;
  // No runs may mean a stop or a surface that holds no voxel.
  const RememberingMonitor remembering(monitor);
  const Monitor& proceed = remembering.Get();
  const std::vector<VoxelRun> inside = VoxelizeSurface(*inputs.Points, *inputs.Triangles,
    smooth.Geometry, parallelFor, PartOf(proceed, 0, 0.1));
  if (remembering.HasStopped() || !inputs.MakeSmooth(CarvingBox(smooth.Geometry, inside, seed)) ||
    !CarveOrgan(smooth, inside, seed, inputs.Noise, settings.Modality, parallelFor,
      PartOf(proceed, 0.1, 0.4), foreground))
  {
    return false;
  }
  unanimity = 1;
  const bool seeks = settings.Consensus && settings.ControlLeaks && IsDoubtful(inside, foreground);
  return !seeks ||
    (inputs.MakeSmooth(ConsensusBox(foreground, seed)) &&
      SeekConsensus(smooth, seed, inputs.Noise, settings.Modality, settings, parallelFor,
        PartOf(proceed, 0.4, 1), foreground, &unanimity));
}

} // namespace FlipFree

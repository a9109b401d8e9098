#include "Intensity/CarvedForeground.h"

#include "Intensity/LeakControl.h"
#include "Intensity/OrganCarving.h"
#include "Intensity/OrganConsensus.h"
#include "Intensity/VenaCavaCarving.h"

namespace FlipFree
{

bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, double& unanimity)
{
  const ImageView<float>& smooth = inputs.Smooth;
  const SeedSphere& seed = inputs.Seed;
  const OrganFeatureSettings& settings = inputs.Settings;
  std::vector<VoxelRun> inside;
  if (!VoxelizeSurface(*inputs.Points, *inputs.Triangles, smooth.Geometry, parallelFor,
        PartOf(monitor, 0, 0.1), inside) ||
    !inputs.MakeSmooth(CarvingBox(smooth.Geometry, inside, seed)) ||
    !CarveOrgan(smooth, inside, seed, inputs.Noise, settings.Modality, parallelFor,
      PartOf(monitor, 0.1, 0.4), foreground))
  {
    return false;
  }
  unanimity = 1;
  const bool seeks = settings.Consensus && settings.ControlLeaks && IsDoubtful(inside, foreground);
  const bool done = (!seeks ||
                      (inputs.MakeSmooth(ConsensusBox(foreground, seed)) &&
                        SeekConsensus(smooth, seed, inputs.Noise, settings, parallelFor,
                          PartOf(monitor, 0.4, 0.95), foreground, &unanimity))) &&
    CarveVenaCava(smooth, inputs.MakeSmooth, inside, seed, settings.Modality, parallelFor,
      PartOf(monitor, 0.95, 1), foreground);
  return done && CutAtNoData(ReaderOf(smooth), seed, parallelFor, monitor, foreground);
}

} // namespace FlipFree

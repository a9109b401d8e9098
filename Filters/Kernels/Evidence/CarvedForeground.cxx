#include "Evidence/CarvedForeground.h"

#include "Evidence/OrganCandidate.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/OrganConsensus.h"
#include "Evidence/VenaCavaCarving.h"
#include "Intensity/LeakControl.h"

namespace FlipFree
{

bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, BitMask& foreground, BitMask& candidate, CarvingReport& report)
{
  const ImageView<float>& smooth = inputs.Smooth;
  const SeedSphere& seed = inputs.Seed;
  const OrganFeatureSettings& settings = inputs.Settings;
  std::vector<VoxelRun> inside;
  if (!VoxelizeSurface(*inputs.Points, *inputs.Triangles, smooth.Geometry, parallelFor,
        PartOf(monitor, 0, 0.1), inside))
  {
    return false;
  }
  BitMask enclosed(smooth.Geometry);
  for (const VoxelRun& run : inside)
  {
    enclosed.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  candidate = enclosed;
  report = {};
  if (!AddForeground(smooth, inputs.MakeSmooth, seed, inputs.Noise, settings, {}, parallelFor,
        PartOf(monitor, 0.1, 0.2), candidate) ||
    !inputs.MakeSmooth(CarvingBox(candidate, seed)) ||
    !CarveOrgan(smooth, candidate, &enclosed, seed, inputs.Noise, settings.Modality, parallelFor,
      PartOf(monitor, 0.2, 0.4), foreground, report.Doubts))
  {
    return false;
  }
  const bool seeks =
    settings.Consensus && settings.ControlLeaks && IsDoubtful(enclosed, foreground);
  const bool done = (!seeks ||
                      (inputs.MakeSmooth(ConsensusBox(foreground, seed)) &&
                        SeekConsensus(smooth, seed, inputs.Noise, settings, parallelFor,
                          PartOf(monitor, 0.4, 0.95), foreground, candidate, report))) &&
    CarveVenaCava(smooth, inputs.MakeSmooth, inside, seed, settings.Modality, parallelFor,
      PartOf(monitor, 0.95, 1), foreground);
  return done && CutAtNoData(ReaderOf(smooth), seed, parallelFor, monitor, foreground);
}

} // namespace FlipFree

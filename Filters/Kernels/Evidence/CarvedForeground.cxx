#include "Evidence/CarvedForeground.h"

#include "Evidence/OrganCandidate.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/OrganConsensus.h"
#include "Evidence/VenaCavaCarving.h"
#include "Intensity/LeakControl.h"
#include "Mesh/SurfaceVoxelization.h"

namespace FlipFree
{

bool CarveForeground(const CarvedForegroundInputs& inputs, const ParallelFor& parallelFor,
  const Monitor& monitor, CarvedForeground& carved)
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
  enclosed.InsertRuns(inside);
  carved = {};
  carved.Candidate = enclosed;
  BitMask& mask = carved.Mask;
  CarvingReport& report = carved.Report;
  if (!AddForeground(smooth, inputs.EnsureSmoothed, seed, inputs.Noise, settings, {}, parallelFor,
        PartOf(monitor, 0.1, 0.2), carved.Candidate) ||
    !inputs.EnsureSmoothed(CarvingBox(carved.Candidate, seed)) ||
    !CarveOrgan(smooth, carved.Candidate, &enclosed, seed, inputs.Noise, settings.Modality,
      parallelFor, PartOf(monitor, 0.2, 0.4), mask, &report.Doubts))
  {
    return false;
  }
  FurtherOpinions opinions;
  const bool seeks = settings.Consensus && settings.ControlLeaks && IsDoubtful(enclosed, mask);
  if (seeks &&
    !(inputs.EnsureSmoothed(ConsensusBox(mask, seed)) &&
      SeekConsensus(smooth, seed, inputs.Noise, settings, parallelFor, PartOf(monitor, 0.4, 0.95),
        mask, opinions)))
  {
    return false;
  }
  BitMask removed = mask;
  if (!CarveVenaCava(smooth, inputs.EnsureSmoothed, seed, settings.Modality, parallelFor,
        PartOf(monitor, 0.95, 1), mask) ||
    !CutAtNoData(ReaderOf(smooth), seed, parallelFor, monitor, mask))
  {
    return false;
  }
  removed.Remove(mask);
  report.Unanimity = opinions.Unanimity;
  if (settings.Consensus && settings.ControlLeaks)
  {
    carved.Opinions = std::move(opinions.Carved);
    carved.Opinions.push_back(carved.Candidate);
    for (BitMask& opinion : carved.Opinions)
    {
      opinion.Remove(removed); // they did not know
    }
  }
  if (opinions.Considered.HasGrid())
  {
    carved.Candidate.Unite(opinions.Considered);
  }
  return true;
}

} // namespace FlipFree

#include "vtkGraphCutSegmentation.h"

#include "BaselineTask.h"
#include "FieldSurface.h"
#include "Intensity/LeakControl.h"
#include "IntensityOdds.h"
#include "MaskVoxels.h"
#include "SliceCut.h"
#include "VoxelCut.h"

#include "ExecutionAdapter.h"
#include "Image/BallMorphology.h"
#include "PropertyCheck.h"

#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkGraphCutSegmentation);

namespace
{

// Voxels of worse odds are background for certain.
constexpr float WorstLogOdds = -4;
// Candidates are connected across gaps thinner than that, in millimeters.
constexpr double Bridge = 1.5;
constexpr double SmoothnessOfSlices = 20;
constexpr double SmoothnessOfVolume = 10;
constexpr double CandidatesEnd = 0.1;
constexpr double CutEnds = 0.9;

// What may be organ: favorable voxels that are connected to the seed, and all around them whose
// odds are not hopeless. False if the monitor stopped it.
bool FindCandidates(const FlipFree::ImageView<float>& logOdds,
  const std::vector<std::size_t>& seedVoxels, const FlipFree::Monitor& monitor,
  FlipFree::BitMask& candidates)
{
  candidates = FlipFree::VoxelsWhere(
    logOdds, [](float odds) { return odds > WorstLogOdds; }, FlipFree::SMPFor);
  candidates.Unite(FlipFree::MaskOf(seedVoxels, logOdds.Geometry));
  return FlipFree::Dilate(candidates, Bridge, FlipFree::SMPFor,
           FlipFree::PartOf(monitor, 0, 0.8)) &&
    FlipFree::KeepConnected(candidates, seedVoxels, FlipFree::PartOf(monitor, 0.8, 1));
}

} // namespace

bool vtkGraphCutSegmentation::Segment(const FlipFree::BaselineTask& task,
  const std::function<bool(double)>& monitor, FlipFree::BaselineResult& result)
{
  const FlipFree::ImageGeometry& geometry = task.Region.Geometry;
  const FlipFree::BitMask seeds = FlipFree::MaskOf(task.SeedVoxels, geometry);
  const std::vector<float> logOdds =
    FlipFree::LogOddsOf(task, this->NoiseWidening, FlipFree::SMPFor);
  FlipFree::BitMask candidates;
  if (!FindCandidates({ logOdds.data(), geometry }, task.SeedVoxels,
        FlipFree::PartOf(monitor, 0, CandidatesEnd), candidates))
  {
    return false;
  }

  FlipFree::VoxelCutSettings settings;
  settings.Smoothness = this->Smoothness > 0
    ? this->Smoothness
    : (this->Mode == SLICES ? SmoothnessOfSlices : SmoothnessOfVolume);
  settings.EdgeContrast = std::max(this->EdgeContrast * task.Noise, 1e-6);
  const FlipFree::Monitor cutting = FlipFree::PartOf(monitor, CandidatesEnd, CutEnds);
  FlipFree::SliceCutResult cut;
  cut.Slices = 1;
  const bool done = this->Mode == VOLUME
    ? FlipFree::FindVoxelCut(task.Region.View(), logOdds, candidates, seeds, settings, cutting,
        cut.Organ)
    : FlipFree::CutSliceBySlice({ task, logOdds, candidates, seeds, settings, this->SliceMargin },
        FlipFree::SMPFor, cutting, cut);
  result.Iterations = cut.Slices;
  FlipFree::BitMask& organ = cut.Organ;
  const FlipFree::Monitor rest = FlipFree::PartOf(monitor, CutEnds, 1);
  const FlipFree::LeakControlRadii radii = FlipFree::RadiiOf(
    { this->ClosingRadius, this->OpeningScale }, task.Seeds.front().Radius, task.Region.Geometry);
  if (!done ||
    !FlipFree::ControlLeaks(organ, task.SeedVoxels, radii, FlipFree::SMPFor,
      FlipFree::PartOf(rest, 0, 0.8)) ||
    !FlipFree::Dilate(organ, this->RimWidth, FlipFree::SMPFor, FlipFree::PartOf(rest, 0.8, 1)))
  {
    return false;
  }
  result.Field = FlipFree::FieldOfMask(organ);
  return true;
}

void vtkGraphCutSegmentation::RequireProperties()
{
  this->Superclass::RequireProperties();
  FlipFree::RequireNumbers({ { "NoiseWidening", this->NoiseWidening },
    { "Smoothness", this->Smoothness }, { "EdgeContrast", this->EdgeContrast },
    { "SliceMargin", this->SliceMargin }, { "ClosingRadius", this->ClosingRadius },
    { "OpeningScale", this->OpeningScale }, { "RimWidth", this->RimWidth } });
}

#include "Deformation/DeformingOrgan.h"

#include "Evidence/ForegroundCorrection.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/OrganConsensus.h"
#include "Intensity/ModelFit.h"
#include "Stopwatch.h"

#include <utility>

namespace FlipFree
{
namespace
{

/// Adds to a sum how long a block takes, wherever the block is left.
class SecondsOfBlock
{
public:
  explicit SecondsOfBlock(double& sum)
    : Sum(sum)
  {
  }
  SecondsOfBlock(const SecondsOfBlock&) = delete;
  SecondsOfBlock& operator=(const SecondsOfBlock&) = delete;
  ~SecondsOfBlock() { this->Sum += this->Watch.Lap(); }

private:
  double& Sum;
  Stopwatch Watch;
};

} // namespace

DeformingOrgan::DeformingOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor)
  : DeformingSurface(settings.Schedule, settings.Step,
      { region.View().Geometry.Spacing.minCoeff(), region.View().Geometry.Spacing.maxCoeff() },
      parallelFor)
  , Noise(noise)
  , Seed(seed)
  , Settings(settings)
  , Foreground(region, this->Seed, this->Settings.Feature,
      2 * EdgeWindowOf(settings.Targets, region.View().Geometry), parallelFor)
  , NewTissue(region, noise, this->Settings.Feature, parallelFor)
  , OrganRadius(seed.Radius)
{
}

bool DeformingOrgan::FindForegroundOfSeed(const Monitor& monitor)
{
  const SecondsOfBlock timing(this->Surface.FeatureSeconds);
  this->Settled = false;
  if (!this->Foreground.SmoothAroundSeed(monitor))
  {
    return false;
  }
  this->Model = FitToSeed(this->Foreground.GetImage(), this->Seed, this->Noise,
    this->Settings.Feature.Intensity);
  this->OfSeed = this->Model;
  if (!this->Foreground.Update(this->Model, monitor))
  {
    return false;
  }
  RequireContrast(this->Foreground.GetMask());
  return true;
}

bool DeformingOrgan::Refit(const Monitor& monitor)
{
  return this->Settled || !this->Settings.Feature.ReestimateIntensities ||
    (this->FindForegroundOfSurface(monitor) && this->CorrectForeground(this->Constraints, monitor));
}

bool DeformingOrgan::FindForegroundOfSurface(const Monitor& monitor)
{
  const IntensitySettings& settings = this->Settings.Feature.Intensity;
  const SecondsOfBlock timing(this->Surface.FeatureSeconds);
  this->Foreground.Clear(); // what follows needs the memory
  if (!this->Foreground.SmoothAround(this->Surface.Points, settings.ShellEnd, monitor))
  {
    return false;
  }
  RefitToSurface(this->Foreground.GetImage(), this->Surface.Points, this->Surface.Mesh.Triangles,
    this->Noise, settings, this->Parallel, monitor, this->Model);
  return this->Foreground.Update(this->Model, monitor);
}

bool DeformingOrgan::CarveSurface(const Monitor& monitor)
{
  const SecondsOfBlock timing(this->Surface.FeatureSeconds);
  this->Foreground.Clear(); // smoothing needs the memory
  CarvedForegroundInputs inputs;
  inputs.Smooth = this->Foreground.GetImage();
  inputs.EnsureSmoothed = [&](const VoxelBox& box)
  { return this->Foreground.Smooth(box, monitor); };
  inputs.Points = &this->Surface.Points;
  inputs.Triangles = &this->Surface.Mesh.Triangles;
  inputs.Seed = this->Seed;
  inputs.Noise = this->Noise;
  inputs.Settings = this->Settings.Feature;
  inputs.Settings.Modality = this->Foreground.GetModality();
  CarvedForeground carved;
  if (!CarveForeground(inputs, this->Parallel, PartOf(monitor, 0, 0.8), carved) ||
    !this->FindOthers(inputs, carved, PartOf(monitor, 0.8, 0.95)))
  {
    return false;
  }
  this->Candidate = std::move(carved.Candidate);
  if (!DecideOtherParts(this->CorrectedImage(monitor), this->Seed, carved.Report.Doubts,
        this->Parallel, PartOf(monitor, 0.95, 1), this->Others, carved.Mask))
  {
    return false;
  }
  this->SettleForeground(std::move(carved.Mask));
  this->Surface.Carving = std::move(carved.Report);
  // Of doubts about the same part, the last one counts: so the surest come first, and the cut's
  // remain last.
  std::vector<DoubtfulPart>& doubts = this->Surface.Carving.Doubts;
  for (const OtherPart& other : this->Others)
  {
    doubts.insert(doubts.begin(), other.Doubt);
  }
  return true;
}

bool DeformingOrgan::FindOthers(const CarvedForegroundInputs& inputs,
  const CarvedForeground& carved, const Monitor& monitor)
{
  this->Others.clear();
  return carved.Opinions.empty() ||
    (inputs.EnsureSmoothed(ConsensusBox(carved.Mask, inputs.Seed)) &&
      FindOtherParts(inputs.Smooth, inputs.Seed, inputs.Noise, inputs.Settings, this->OfSeed,
        carved.Mask, carved.Opinions, this->Parallel, monitor, this->Others));
}

ForegroundImage DeformingOrgan::CorrectedImage(const Monitor& monitor)
{
  return { this->Foreground.GetImage(), this->Foreground.GetReader(),
    [this, &monitor](const VoxelBox& box) { return this->Foreground.Smooth(box, monitor); },
    this->Noise, this->Foreground.GetModality(), this->Candidate, this->Others, &this->NewTissue };
}

bool DeformingOrgan::CorrectForeground(const ConstraintList& constraints, const Monitor& monitor)
{
  const SecondsOfBlock timing(this->Surface.FeatureSeconds);
  if (constraints.empty())
  {
    return true;
  }
  BitMask mask = this->Foreground.TakeMask();
  const bool done = FlipFree::CorrectForeground(this->CorrectedImage(monitor), this->Seed,
    constraints, this->Parallel, monitor, mask);
  this->Foreground.SetMask(std::move(mask));
  return done;
}

void DeformingOrgan::SettleForeground(BitMask mask)
{
  this->Foreground.SetMask(std::move(mask));
  this->Settled = true;
}

void DeformingOrgan::BeginRun()
{
  if (this->Settled)
  {
    this->OrganRadius = RadiusOf(this->Foreground.GetMask(), this->Seed);
  }
}

CorrespondenceField DeformingOrgan::SearchTargets(TargetReport& report)
{
  TargetSettings targets = this->Settings.Targets;
  targets.Correspondence.Ramp = this->Model.Ramp;
  // To edges it snaps in the last level, and not to those of a carved foreground, which ends where
  // the edge is by its own rule.
  if (!this->IsInLastLevel() || this->Settled)
  {
    targets.Correspondence.EdgeWindow = 0;
  }
  return FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground.GetMask(),
    this->Foreground.GetNoData(), this->Foreground.GetImage(), this->OrganRadius, targets,
    this->Parallel, report);
}

} // namespace FlipFree

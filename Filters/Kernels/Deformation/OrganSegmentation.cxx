#include "Deformation/OrganSegmentation.h"

#include "Deformation/DeformationLoop.h"
#include "Deformation/DeformingOrgan.h"
#include "Deformation/LabelStart.h"
#include "Deformation/RunScheduler.h"
#include "Geometry/SelfIntersection.h"

#include <memory>
#include <utility>

namespace FlipFree
{

struct OrganSegmenter::State
{
  State(SmoothRegion& region, double noise, const SeedSphere& seed, const DeformableSurface& start,
    const OrganSegmentationSettings& settings, const ParallelFor& parallelFor)
    : Organ(region, noise, seed, settings, parallelFor)
    , Start(start)
    , Scheduler(this->Organ, parallelFor)
  {
  }

  DeformingOrgan Organ;
  const DeformableSurface Start;
  bool IsGiven = false; // the foreground; nothing is run then

  // The settled foreground before constraints correct it: carved after the first run, or given.
  // Kept between calls.
  bool HasUncorrected = false;
  BitMask Uncorrected;

  // Of the first run, if there is one; kept, too.
  std::vector<IterationRecord> FirstIterations;
  DeformableSurface FirstSurface;
  CarvingReport Carving;

  // The foreground of the last preview without the constraint that it asks about.
  ConstraintList PreviewedConstraints;
  std::optional<BitMask> Previewed;

  RunScheduler Scheduler; // keeps the surface without constraints
};

OrganSegmenter::OrganSegmenter(SmoothRegion& region, double noise, const SeedSphere& seed,
  const DeformableSurface& start, const OrganSegmentationSettings& settings,
  const ParallelFor& parallelFor)
  : Kept(std::make_unique<State>(region, noise, seed, start, settings, parallelFor))
  , Parallel(parallelFor)
{
}

OrganSegmenter::~OrganSegmenter() = default;

void OrganSegmenter::SetForeground(BitMask mask)
{
  this->Kept->Uncorrected = std::move(mask);
  this->Kept->HasUncorrected = true;
  this->Kept->IsGiven = true;
  this->Kept->Previewed.reset();
  this->Kept->Scheduler.Release();
}

DeformingOrgan& OrganSegmenter::GetOrgan()
{
  return this->Kept->Organ;
}

bool OrganSegmenter::RunsTwice() const
{
  return this->Kept->Organ.GetSettings().Feature.Carving;
}

bool OrganSegmenter::RunAndCarve(const Monitor& monitor, const IterationObserver& observer)
{
  State& kept = *this->Kept;
  const Monitor begin = [&](double) { return monitor(0); };
  const Monitor end = [&](double) { return monitor(1); };
  if (!kept.Organ.FindForegroundOfSeed(begin))
  {
    return false;
  }
  kept.Organ.BeginAt(kept.Start, 0, {}, OutsidePoints::FromTheStart, observer);
  if (!DeformationLoop({ &kept.Organ }, {}, this->Parallel).Run(monitor) ||
    !kept.Organ.CarveSurface(end))
  {
    return false;
  }
  const OrganSurface& surface = kept.Organ.GetSurface();
  kept.FirstSurface = { surface.Mesh, surface.Points };
  kept.FirstIterations = surface.Iterations;
  kept.Carving = surface.Carving;
  kept.Uncorrected = kept.Organ.GetForeground().GetMask();
  kept.HasUncorrected = true;
  kept.Previewed.reset();
  return true;
}

// The observer does not see this run, which is no part of the way to the result.
bool OrganSegmenter::RunWithoutConstraints(const Monitor& monitor)
{
  State& kept = *this->Kept;
  this->Begin({}, nullptr, OutsidePoints::InTheLastLevel, ObserveNothing);
  if (!DeformationLoop({ &kept.Organ }, {}, this->Parallel).Run(monitor))
  {
    return false;
  }
  this->KeepUnconstrained();
  const double seconds = kept.Organ.GetSurface().FeatureSeconds;
  kept.Organ.ReleaseSurface();
  kept.Organ.GetSurface().FeatureSeconds = seconds; // of the whole call
  return true;
}

void OrganSegmenter::KeepUnconstrained()
{
  const OrganSurface& surface = this->Kept->Organ.GetSurface();
  this->Kept->Scheduler.SetSurface({ surface.Mesh, surface.Points });
}

// With carving, all levels run twice: a surface that has leaked would have to draw back through
// the neck, so the second run starts anew.
bool OrganSegmenter::FindForeground(const ConstraintList& constraints, const Monitor& monitor,
  const IterationObserver& observer)
{
  State& kept = *this->Kept;
  kept.Organ.ReleaseSurface();
  if (!this->RunsTwice())
  {
    return kept.Organ.FindForegroundOfSeed(monitor) &&
      kept.Organ.CorrectForeground(constraints, monitor);
  }
  if (!kept.HasUncorrected && !this->RunAndCarve(monitor, observer))
  {
    return false;
  }
  kept.Organ.SettleForeground(kept.Uncorrected);
  if (!constraints.empty() && !kept.Scheduler.HasSurface() && !this->RunWithoutConstraints(monitor))
  {
    return false;
  }
  OrganSurface& surface = kept.Organ.GetSurface();
  surface.Iterations = kept.FirstIterations;
  surface.First = kept.FirstSurface;
  surface.Carving = kept.Carving;
  return kept.Organ.CorrectForeground(constraints, [&](double) { return monitor(1); });
}

bool OrganSegmenter::FillForeground(const ConstraintList& constraints, const Monitor& monitor,
  const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  organ.ReleaseSurface();
  organ.SettleForeground(this->Kept->Uncorrected);
  if (!organ.CorrectForeground(constraints, PartOf(monitor, 0, 0.4)))
  {
    return false;
  }
  const DeformableSurface start =
    SurfaceOfMask(organ.GetForeground().GetMask(), this->Parallel, PartOf(monitor, 0.4, 0.7));
  if (start.Points.rows() == 0)
  {
    return false;
  }
  organ.BeginAt(start, 0, constraints, OutsidePoints::AroundThem, observer);
  return DeformationLoop({ &organ }, {}, this->Parallel).Stay(PartOf(monitor, 0.7, 1));
}

std::optional<BitMask> OrganSegmenter::ForegroundBy(const ConstraintList& constraints,
  const Monitor& monitor)
{
  DeformingOrgan& organ = this->Kept->Organ;
  organ.SettleForeground(this->Kept->Uncorrected);
  if (!organ.CorrectForeground(constraints, monitor))
  {
    return std::nullopt;
  }
  return organ.GetForeground().GetMask();
}

std::optional<BitMask> OrganSegmenter::PreviewForeground(const ConstraintList& constraints,
  const PointConstraint& next, const Monitor& monitor)
{
  State& kept = *this->Kept;
  if (!kept.HasUncorrected)
  {
    return std::nullopt;
  }
  if (!kept.Previewed || kept.PreviewedConstraints != constraints)
  {
    kept.Previewed = this->ForegroundBy(constraints, monitor);
    kept.PreviewedConstraints = constraints;
  }
  ConstraintList all = constraints;
  all.push_back(next);
  const std::optional<BitMask> then = this->ForegroundBy(all, monitor);
  if (!then || !kept.Previewed)
  {
    return std::nullopt;
  }
  return DifferenceOf(*kept.Previewed, *then);
}

void OrganSegmenter::Begin(const ConstraintList& constraints, const DeformableSurface* start,
  OutsidePoints outside, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  const RunStart from = this->StartOf(start);
  organ.BeginAt(from.Surface, from.Level, constraints, outside, observer);
}

OrganSegmenter::RunStart OrganSegmenter::StartOf(const DeformableSurface* given) const
{
  const State& kept = *this->Kept;
  return { given ? *given : kept.Start,
    this->RunsTwice() ? kept.Organ.GetSettings().Schedule.NumberOfLevels() : 0 };
}

bool OrganSegmenter::RunFrom(const DeformableSurface* start, const ConstraintList& constraints,
  const Monitor& monitor, const IterationObserver& observer)
{
  const double half = this->RunsTwice() ? 0.5 : 0;
  const Monitor askFirst = PartOf(monitor, 0, half);
  if (!this->FindForeground(constraints, askFirst, observer))
  {
    return false;
  }
  const RunStart from = this->StartOf(start);
  return this->Kept->Scheduler.Run({ constraints, from.Surface, from.Level, this->Kept->Uncorrected,
    PartOf(monitor, half, 1), observer });
}

OrganSurface OrganSegmenter::FindSurface(const ConstraintList& constraints,
  const DeformableSurface* start, const Monitor& monitor, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  const RememberingMonitor remembering(monitor);
  const Monitor& ask = remembering.Get();
  const double smoothing = organ.GetForeground().GetSmoothingSeconds();
  const bool done = this->Kept->IsGiven ? this->FillForeground(constraints, ask, observer)
                                        : this->RunFrom(start, constraints, ask, observer);
  if (done && !remembering.HasStopped() && constraints.empty() && this->Kept->HasUncorrected &&
    !this->Kept->IsGiven && (!start || start->Points == this->Kept->Start.Points))
  {
    this->KeepUnconstrained();
  }
  OrganSurface surface = std::move(organ.GetSurface());
  surface.SmoothingSeconds = organ.GetForeground().GetSmoothingSeconds() - smoothing;
  surface.FeatureSeconds -= surface.SmoothingSeconds;
  if (!done || remembering.HasStopped())
  {
    surface.Reason = StopReason::Aborted;
    return surface;
  }
  surface.SelfIntersections =
    CountSelfIntersections(surface.Points, surface.Mesh.Faces, this->Parallel);
  return surface;
}

} // namespace FlipFree

#include "Deformation/OrganSegmentation.h"

#include "Deformation/DeformingOrgan.h"
#include "Deformation/JointDeformation.h"
#include "Error.h"
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
  {
  }

  DeformingOrgan Organ;
  const DeformableSurface Start;
  bool IsGiven = false; // the foreground; there is no first run then

  // Of the first run, kept between calls.
  bool IsCarved = false;
  std::vector<IterationRecord> FirstIterations;
  DeformableSurface FirstSurface;
  BitMask Carved;
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
  this->Kept->Carved = std::move(mask);
  this->Kept->IsCarved = true;
  this->Kept->IsGiven = true;
}

DeformingOrgan& OrganSegmenter::GetOrgan()
{
  return this->Kept->Organ;
}

bool OrganSegmenter::RunsTwice() const
{
  return this->Kept->Organ.GetSettings().Feature.Carving && !this->Kept->IsGiven;
}

// The monitor remembers a stop.
bool OrganSegmenter::RunFirst(const Monitor& monitor, const IterationObserver& observer)
{
  State& kept = *this->Kept;
  const Monitor begin = [&](double) { return monitor(0); };
  const Monitor end = [&](double) { return monitor(1); };
  if (!kept.Organ.FindForegroundOfSeed(begin))
  {
    return false;
  }
  kept.Organ.BeginAt(kept.Start, 0, {}, OutsidePoints::FromTheStart, observer);
  if (!JointDeformation({ &kept.Organ }, {}, this->Parallel).Run(monitor) ||
    !kept.Organ.CarveSurface(end))
  {
    return false;
  }
  const OrganSurface& surface = kept.Organ.GetSurface();
  kept.FirstSurface = { surface.Mesh, surface.Points };
  kept.FirstIterations = surface.Iterations;
  kept.Carved = kept.Organ.GetForeground().GetMask();
  kept.IsCarved = true;
  return true;
}

// With carving, all levels run twice: a surface that has leaked would have to draw back through
// the neck, so the second run starts anew.
bool OrganSegmenter::FindForeground(const ConstraintList& constraints, const Monitor& monitor,
  const IterationObserver& observer)
{
  State& kept = *this->Kept;
  kept.Organ.Reset();
  if (!this->RunsTwice() && !kept.IsGiven)
  {
    return kept.Organ.FindForegroundOfSeed(monitor) &&
      kept.Organ.CorrectForeground(constraints, monitor);
  }
  if (!kept.IsCarved && !this->RunFirst(monitor, observer))
  {
    return false;
  }
  OrganSurface& surface = kept.Organ.GetSurface();
  surface.Iterations = kept.FirstIterations;
  surface.First = kept.FirstSurface;
  surface.Unanimity = kept.Organ.GetForeground().GetUnanimity();
  kept.Organ.SettleForeground(kept.Carved);
  return kept.Organ.CorrectForeground(constraints, [&](double) { return monitor(1); });
}

void OrganSegmenter::Begin(const ConstraintList& constraints, const DeformableSurface* start,
  OutsidePoints outside, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  organ.BeginAt(start ? *start : this->Kept->Start,
    this->RunsTwice() ? organ.GetSettings().Schedule.NumberOfLevels() : 0, constraints, outside,
    observer);
}

// Where the surface cannot be pulled back from an outside point, it keeps off from the start.
bool OrganSegmenter::RunLast(const ConstraintList& constraints, const DeformableSurface* start,
  const Monitor& monitor, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  const std::vector<IterationRecord> before = organ.GetSurface().Iterations;
  try
  {
    this->Begin(constraints, start, OutsidePoints::InTheLastLevel, observer);
    return JointDeformation({ &organ }, {}, this->Parallel).Run(monitor);
  }
  catch (const Error& error)
  {
    if (error.GetCode() != ErrorCode::UnreachablePoint)
    {
      throw;
    }
  }
  organ.GetSurface().Iterations = before;
  this->Begin(constraints, start, OutsidePoints::FromTheStart, observer);
  return JointDeformation({ &organ }, {}, this->Parallel).Run(monitor);
}

OrganSurface OrganSegmenter::Segment(const ConstraintList& constraints,
  const DeformableSurface* start, const Monitor& monitor, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  bool stopped = false;
  const Monitor ask = [&](double fraction)
  {
    stopped = stopped || !monitor(fraction);
    return !stopped;
  };
  const double smoothing = organ.GetForeground().GetSmoothingSeconds();
  const double half = this->RunsTwice() ? 0.5 : 0;
  bool done = this->FindForeground(constraints, FlipFree::PartOf(ask, 0, half), observer);
  if (done)
  {
    done = this->RunLast(constraints, start, FlipFree::PartOf(ask, half, 1), observer);
  }
  OrganSurface surface = std::move(organ.GetSurface());
  surface.SmoothingSeconds = organ.GetForeground().GetSmoothingSeconds() - smoothing;
  surface.FeatureSeconds -= surface.SmoothingSeconds;
  if (!done || stopped)
  {
    surface.Reason = StopReason::Aborted;
    return surface;
  }
  surface.SelfIntersections =
    CountSelfIntersections(surface.Points, surface.Mesh.Faces, this->Parallel);
  return surface;
}

OrganSurface SegmentOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer)
{
  return OrganSegmenter(region, noise, seed, { startMesh, startPoints }, settings, parallelFor)
    .Segment({}, nullptr, monitor, observer);
}

} // namespace FlipFree

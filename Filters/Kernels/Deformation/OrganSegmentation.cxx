#include "Deformation/OrganSegmentation.h"

#include "Deformation/DeformingOrgan.h"
#include "Deformation/JointDeformation.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

// What changes farther away from what stays, in millimeters, changes in a run of all levels.
constexpr double DeepChange = 15;

bool IsNear(const PointConstraint& constraint, const BitMask& voxels)
{
  constexpr double near = 5; // millimeters
  const double reach = std::max(near, constraint.Radius);
  return voxels.Cropped(BoxAround(voxels.GetGeometry(), constraint.Point, reach)).Count() > 0;
}

// What the call returns, or nothing where a constraint cannot be obeyed.
template <typename Call>
std::optional<bool> UnlessUnreachable(const Call& call)
{
  try
  {
    return call();
  }
  catch (const Error& error)
  {
    if (error.GetCode() != ErrorCode::UnreachablePoint)
    {
      throw;
    }
    return std::nullopt;
  }
}

// Iterations count on.
void Append(const std::vector<IterationRecord>& records, std::vector<IterationRecord>& all)
{
  for (IterationRecord record : records)
  {
    record.Iteration = static_cast<int>(all.size()) + 1;
    all.push_back(record);
  }
}

} // namespace

// A part of the foreground that constraints change deeply, and those in it. What the surface
// becomes there depends on nothing else, so that no constraint elsewhere moves it.
struct OrganSegmenter::DeepPart
{
  BitMask Voxels;
  ConstraintList Constraints;
  PointList Start;           ///< of the runs
  DeformableSurface Surface; ///< with this part alone
  std::vector<IterationRecord> Iterations;

  bool IsSameAs(const DeepPart& other) const
  {
    return this->Constraints == other.Constraints && this->Start == other.Start &&
      this->Voxels == other.Voxels;
  }
};

OrganSegmenter::RunInputs OrganSegmenter::RunInputs::With(const ConstraintList& constraints) const
{
  return { constraints, this->Start, this->Proceed, this->Observer };
}

OrganSegmenter::RunInputs OrganSegmenter::RunInputs::Part(double first, double last) const
{
  return { this->Constraints, this->Start, PartOf(this->Proceed, first, last), this->Observer };
}

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

  // The settled foreground before constraints correct it: carved after the first run, or given.
  // Kept between calls.
  bool HasUncorrected = false;
  BitMask Uncorrected;

  // Of the first run, if there is one; kept, too.
  std::vector<IterationRecord> FirstIterations;
  DeformableSurface FirstSurface;

  // What RunToResult() gives without constraints; kept, too.
  DeformableSurface Unconstrained;
  std::vector<DeepPart> DeepParts; // of the last call
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
  this->Kept->Unconstrained = {};
  this->Kept->DeepParts.clear();
}

DeformingOrgan& OrganSegmenter::GetOrgan()
{
  return this->Kept->Organ;
}

bool OrganSegmenter::RunsTwice() const
{
  return this->Kept->Organ.GetSettings().Feature.Carving && !this->Kept->IsGiven;
}

bool OrganSegmenter::RunAndCarve(const RememberingMonitor& monitor,
  const IterationObserver& observer)
{
  State& kept = *this->Kept;
  const Monitor begin = [&](double) { return monitor.Get()(0); };
  const Monitor end = [&](double) { return monitor.Get()(1); };
  if (!kept.Organ.FindForegroundOfSeed(begin))
  {
    return false;
  }
  kept.Organ.BeginAt(kept.Start, 0, {}, OutsidePoints::FromTheStart, observer);
  if (!JointDeformation({ &kept.Organ }, {}, this->Parallel).Run(monitor.Get()) ||
    !kept.Organ.CarveSurface(end))
  {
    return false;
  }
  const OrganSurface& surface = kept.Organ.GetSurface();
  kept.FirstSurface = { surface.Mesh, surface.Points };
  kept.FirstIterations = surface.Iterations;
  kept.Uncorrected = kept.Organ.GetForeground().GetMask();
  kept.HasUncorrected = true;
  return true;
}

// The observer does not see this run, which is no part of the way to the result.
bool OrganSegmenter::RunWithoutConstraints(const Monitor& monitor)
{
  State& kept = *this->Kept;
  this->Begin({}, nullptr, OutsidePoints::InTheLastLevel,
    [](const auto&, const auto&, const auto&, const auto&) {});
  if (!JointDeformation({ &kept.Organ }, {}, this->Parallel).Run(monitor))
  {
    return false;
  }
  this->KeepUnconstrained();
  kept.Organ.Reset();
  return true;
}

void OrganSegmenter::KeepUnconstrained()
{
  const OrganSurface& surface = this->Kept->Organ.GetSurface();
  this->Kept->Unconstrained = { surface.Mesh, surface.Points };
}

// With carving, all levels run twice: a surface that has leaked would have to draw back through
// the neck, so the second run starts anew.
bool OrganSegmenter::FindForeground(const ConstraintList& constraints,
  const RememberingMonitor& monitor, const IterationObserver& observer)
{
  State& kept = *this->Kept;
  kept.Organ.Reset();
  if (!this->RunsTwice() && !kept.IsGiven)
  {
    return kept.Organ.FindForegroundOfSeed(monitor.Get()) &&
      kept.Organ.CorrectForeground(constraints, monitor.Get());
  }
  if (!kept.HasUncorrected && !this->RunAndCarve(monitor, observer))
  {
    return false;
  }
  kept.Organ.SettleForeground(kept.Uncorrected);
  if (!constraints.empty() && kept.Unconstrained.Points.rows() == 0 &&
    !this->RunWithoutConstraints(monitor.Get()))
  {
    return false;
  }
  OrganSurface& surface = kept.Organ.GetSurface();
  surface.Iterations = kept.FirstIterations;
  surface.First = kept.FirstSurface;
  surface.Unanimity = kept.Organ.GetForeground().GetUnanimity();
  return kept.Organ.CorrectForeground(constraints, [&](double) { return monitor.Get()(1); });
}

void OrganSegmenter::Begin(const ConstraintList& constraints, const DeformableSurface* start,
  OutsidePoints outside, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  organ.BeginAt(start ? *start : this->Kept->Start, this->FirstLevel(), constraints, outside,
    observer);
}

int OrganSegmenter::FirstLevel() const
{
  return this->RunsTwice() ? this->Kept->Organ.GetSettings().Schedule.NumberOfLevels() : 0;
}

// Where the surface cannot be pulled back from an outside point, it keeps off from the start.
bool OrganSegmenter::RunAllLevelsTo(const std::vector<EndSurface>& ends, const RunInputs& inputs)
{
  DeformingOrgan& organ = this->Kept->Organ;
  const std::vector<IterationRecord> before = organ.GetSurface().Iterations;
  const auto run = [&](OutsidePoints outside)
  {
    organ.GetSurface().Iterations = before;
    this->Begin(inputs.Constraints, inputs.Start, outside, inputs.Observer);
    organ.EndOn(ends);
    return JointDeformation({ &organ }, {}, this->Parallel).Run(inputs.Proceed);
  };
  const std::optional<bool> done =
    UnlessUnreachable([&] { return run(OutsidePoints::InTheLastLevel); });
  return done ? *done : run(OutsidePoints::FromTheStart);
}

EndSurface OrganSegmenter::UnconstrainedWhereUnchanged(const ConstraintList& constraints) const
{
  const auto places = std::make_shared<const UnchangedPlaces>(
    DifferenceOf(this->Kept->Uncorrected, this->Kept->Organ.GetForeground().GetMask()),
    constraints);
  return { &this->Kept->Unconstrained,
    [places, this](const PointList& points) { return places->WeightsOf(points, this->Parallel); } };
}

bool OrganSegmenter::RunAllLevels(const RunInputs& inputs)
{
  std::vector<EndSurface> ends;
  if (this->Kept->Unconstrained.Points.rows() > 0 &&
    (!inputs.Constraints.empty() ||
      this->Kept->Uncorrected != this->Kept->Organ.GetForeground().GetMask()))
  {
    ends.push_back(this->UnconstrainedWhereUnchanged(inputs.Constraints));
  }
  return this->RunAllLevelsTo(ends, inputs);
}

bool OrganSegmenter::RunLastLevelFrom(const DeformableSurface& from,
  const UnchangedPlaces& unchanged, const RunInputs& inputs)
{
  DeformingOrgan& organ = this->Kept->Organ;
  organ.BeginAt(from, this->FirstLevel(), inputs.Constraints, OutsidePoints::AroundThem,
    inputs.Observer);
  organ.StayIn(unchanged);
  return JointDeformation({ &organ }, {}, this->Parallel).RunLastLevel(inputs.Proceed);
}

// The surface would have to draw back from a leak through the neck, and to bulge far into a lobe,
// so such parts change in runs of all levels: each by itself.
bool OrganSegmenter::FindDeepSurfaces(const RunInputs& inputs)
{
  State& kept = *this->Kept;
  DeformingOrgan& organ = kept.Organ;
  std::vector<BitMask> deep;
  if (!FindDeepParts(kept.Uncorrected, organ.GetForeground().GetMask(), DeepChange, this->Parallel,
        PartOf(inputs.Proceed, 0, 0), deep))
  {
    return false;
  }
  std::vector<DeepPart> parts;
  for (std::size_t number = 0; number < deep.size(); ++number)
  {
    DeepPart part;
    part.Voxels = std::move(deep[number]);
    std::copy_if(inputs.Constraints.begin(), inputs.Constraints.end(),
      std::back_inserter(part.Constraints),
      [&](const PointConstraint& constraint) { return IsNear(constraint, part.Voxels); });
    part.Constraints = SortedConstraints(part.Constraints);
    part.Start = inputs.Start ? inputs.Start->Points : kept.Start.Points;
    const auto same = std::find_if(kept.DeepParts.begin(), kept.DeepParts.end(),
      [&](const DeepPart& other) { return part.IsSameAs(other); });
    if (same != kept.DeepParts.end())
    {
      parts.push_back(*same);
      continue;
    }
    const double first = static_cast<double>(number) / static_cast<double>(deep.size());
    const double last = static_cast<double>(number + 1) / static_cast<double>(deep.size());
    if (!this->RunDeepPart(inputs.Part(first, last), part))
    {
      return false;
    }
    parts.push_back(std::move(part));
  }
  kept.DeepParts = std::move(parts);
  return true;
}

bool OrganSegmenter::RunDeepPart(const RunInputs& inputs, DeepPart& part)
{
  const RunInputs ofPart = inputs.With(part.Constraints);
  DeformingOrgan& organ = this->Kept->Organ;
  OrganSurface& surface = organ.GetSurface();
  organ.SettleForeground(DifferenceOf(this->Kept->Uncorrected, part.Voxels));
  surface.Iterations.clear();
  if (!this->RunAllLevels(ofPart.Part(0, 0.8)) ||
    !this->RunLastLevelFrom({ surface.Mesh, surface.Points }, { part.Voxels, part.Constraints },
      ofPart.Part(0.8, 1)))
  {
    return false;
  }
  part.Surface = { surface.Mesh, surface.Points };
  part.Iterations = surface.Iterations;
  return true;
}

// Of several deep parts: near each, the surface with that one alone.
bool OrganSegmenter::JoinDeepSurfaces(const RunInputs& inputs)
{
  State& kept = *this->Kept;
  BitMask all(kept.Uncorrected.GetGeometry());
  ConstraintList constraints;
  std::vector<EndSurface> ends(1);
  for (const DeepPart& part : kept.DeepParts)
  {
    all.Unite(part.Voxels);
    constraints.insert(constraints.end(), part.Constraints.begin(), part.Constraints.end());
    const auto places = std::make_shared<const UnchangedPlaces>(part.Voxels, part.Constraints);
    ends.push_back({ &part.Surface, [places, this](const PointList& points) -> Eigen::VectorXd {
                      return (places->WeightsOf(points, this->Parallel).array() < 1).cast<double>();
                    } });
  }
  kept.Organ.SettleForeground(DifferenceOf(kept.Uncorrected, all));
  ends.front() = this->UnconstrainedWhereUnchanged(constraints);
  return this->RunAllLevelsTo(ends, inputs.With(SortedConstraints(constraints)));
}

// Moves the surface without constraints only where these have changed the foreground.
// `corrected` is the foreground by all constraints.
bool OrganSegmenter::CorrectUnconstrained(const BitMask& corrected, const RunInputs& inputs)
{
  State& kept = *this->Kept;
  DeformingOrgan& organ = kept.Organ;
  std::vector<IterationRecord> iterations = organ.GetSurface().Iterations;
  // Refuses outside points in the start.
  this->Begin(inputs.Constraints, inputs.Start, OutsidePoints::InTheLastLevel, inputs.Observer);
  if (!this->FindDeepSurfaces(inputs.Part(0, 0.5)))
  {
    return false;
  }
  const std::vector<DeepPart>& parts = kept.DeepParts;
  BitMask changed = DifferenceOf(kept.Uncorrected, corrected);
  for (const DeepPart& part : parts)
  {
    changed.Remove(part.Voxels);
    Append(part.Iterations, iterations);
  }
  organ.GetSurface().Iterations = std::move(iterations);
  DeformableSurface base = parts.empty() ? kept.Unconstrained : parts.front().Surface;
  if (parts.size() > 1)
  {
    if (!this->JoinDeepSurfaces(inputs.Part(0.5, 0.8)))
    {
      return false;
    }
    base = { organ.GetSurface().Mesh, organ.GetSurface().Points };
  }
  organ.SettleForeground(corrected);
  ConstraintList shallow;
  std::copy_if(inputs.Constraints.begin(), inputs.Constraints.end(), std::back_inserter(shallow),
    [&](const PointConstraint& constraint)
    {
      return std::none_of(parts.begin(), parts.end(),
        [&](const DeepPart& part) { return IsNear(constraint, part.Voxels); });
    });
  return this->RunLastLevelFrom(base, { std::move(changed), shallow }, inputs.Part(0.8, 1));
}

bool OrganSegmenter::RunToResult(const RunInputs& inputs)
{
  State& kept = *this->Kept;
  if (inputs.Constraints.empty() || kept.Unconstrained.Points.rows() == 0)
  {
    return this->RunAllLevels(inputs);
  }
  BitMask corrected = kept.Organ.GetForeground().GetMask();
  const std::vector<IterationRecord> before = kept.Organ.GetSurface().Iterations;
  if (const std::optional<bool> done =
        UnlessUnreachable([&] { return this->CorrectUnconstrained(corrected, inputs); }))
  {
    return *done;
  }
  kept.Organ.SettleForeground(std::move(corrected));
  kept.Organ.GetSurface().Iterations = before;
  return this->RunAllLevels(inputs);
}

OrganSurface OrganSegmenter::FindSurface(const ConstraintList& constraints,
  const DeformableSurface* start, const Monitor& monitor, const IterationObserver& observer)
{
  DeformingOrgan& organ = this->Kept->Organ;
  const RememberingMonitor remembering(monitor);
  const Monitor& ask = remembering.Get();
  const double smoothing = organ.GetForeground().GetSmoothingSeconds();
  const double half = this->RunsTwice() ? 0.5 : 0;
  const Monitor askFirst = PartOf(ask, 0, half);
  bool done = this->FindForeground(constraints, RememberingMonitor(askFirst), observer);
  if (done)
  {
    done = this->RunToResult({ constraints, start, PartOf(ask, half, 1), observer });
  }
  if (done && !remembering.HasStopped() && constraints.empty() && this->Kept->HasUncorrected &&
    (!start || start->Points == this->Kept->Start.Points))
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

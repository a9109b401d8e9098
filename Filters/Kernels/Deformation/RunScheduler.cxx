#include "Deformation/RunScheduler.h"

#include "Deformation/DeformationLoop.h"
#include "Error.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

// What changes farther away from what stays, in millimeters, changes in a run of all levels.
constexpr double DeepDistance = 15;

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

} // namespace

// The surface would have to draw back from a leak through the neck, and to bulge far into a lobe,
// so such parts change in a run of all levels. Kept while further constraints leave them as they
// are.
struct RunScheduler::DeepChange
{
  BitMask Voxels;
  ConstraintList Constraints; ///< in the voxels
  PointList Start;            ///< of the run
  DeformableSurface Surface;  ///< with these changes alone
  std::vector<IterationRecord> Iterations;

  bool IsSameAs(const DeepChange& other) const
  {
    return this->Constraints == other.Constraints && this->Start == other.Start &&
      this->Voxels == other.Voxels;
  }
};

RunInputs RunInputs::With(const ConstraintList& constraints) const
{
  return { constraints, this->Start, this->FirstLevel, this->Uncorrected, this->Proceed,
    this->Observer };
}

RunInputs RunInputs::Part(double first, double last) const
{
  return { this->Constraints, this->Start, this->FirstLevel, this->Uncorrected,
    PartOf(this->Proceed, first, last), this->Observer };
}

RunScheduler::RunScheduler(DeformingOrgan& organ, const ParallelFor& parallelFor)
  : Organ(organ)
  , Parallel(parallelFor)
{
}

RunScheduler::~RunScheduler() = default;

void RunScheduler::Release()
{
  this->Surface = {};
  this->Deep.reset();
}

void RunScheduler::Begin(OutsidePoints outside, const RunInputs& inputs)
{
  this->Organ.BeginAt(inputs.Start, inputs.FirstLevel, inputs.Constraints, outside,
    inputs.Observer);
}

bool RunScheduler::RunAllLevels(const RunInputs& inputs)
{
  const BitMask& foreground = this->Organ.GetForeground().GetMask();
  std::optional<UnchangedPlaces> places;
  if (this->HasSurface() && (!inputs.Constraints.empty() || inputs.Uncorrected != foreground))
  {
    places.emplace(DifferenceOf(inputs.Uncorrected, foreground), inputs.Constraints);
  }
  const std::vector<IterationRecord> before = this->Organ.GetSurface().Iterations;
  const auto run = [&](OutsidePoints outside)
  {
    this->Organ.GetSurface().Iterations = before;
    this->Begin(outside, inputs);
    if (places)
    {
      this->Organ.EndOn(this->Surface, *places);
    }
    return DeformationLoop({ &this->Organ }, {}, this->Parallel).Run(inputs.Proceed);
  };
  const std::optional<bool> done =
    UnlessUnreachable([&] { return run(OutsidePoints::InTheLastLevel); });
  return done ? *done : run(OutsidePoints::FromTheStart);
}

bool RunScheduler::RunLastLevelFrom(const DeformableSurface& from, const UnchangedPlaces& unchanged,
  const RunInputs& inputs)
{
  this->Organ.BeginAt(from, inputs.FirstLevel, inputs.Constraints, OutsidePoints::AroundThem,
    inputs.Observer);
  this->Organ.StayIn(unchanged);
  return DeformationLoop({ &this->Organ }, {}, this->Parallel).RunLastLevel(inputs.Proceed);
}

bool RunScheduler::RunDeepChange(const RunInputs& inputs, DeepChange& change)
{
  const RunInputs ofChange = inputs.With(change.Constraints);
  OrganSurface& surface = this->Organ.GetSurface();
  this->Organ.SettleForeground(DifferenceOf(inputs.Uncorrected, change.Voxels));
  if (!this->RunAllLevels(ofChange.Part(0, 0.8)) ||
    !this->RunLastLevelFrom({ surface.Mesh, surface.Points }, { change.Voxels, change.Constraints },
      ofChange.Part(0.8, 1)))
  {
    return false;
  }
  change.Surface = { surface.Mesh, surface.Points };
  change.Iterations = surface.Iterations;
  return true;
}

bool RunScheduler::Correct(const BitMask& corrected, const RunInputs& inputs)
{
  // Refuses outside points in the start.
  this->Begin(OutsidePoints::InTheLastLevel, inputs);
  auto deep = std::make_unique<DeepChange>();
  if (!FindDeepChange(inputs.Uncorrected, corrected, DeepDistance, this->Parallel,
        PartOf(inputs.Proceed, 0, 0), deep->Voxels))
  {
    return false;
  }
  BitMask changed = DifferenceOf(inputs.Uncorrected, corrected);
  if (deep->Voxels.Count() == 0)
  {
    this->Deep.reset();
    return this->RunLastLevelFrom(this->Surface, { std::move(changed), inputs.Constraints },
      inputs);
  }
  changed.Remove(deep->Voxels);
  ConstraintList shallow;
  for (const PointConstraint& constraint : SortedConstraints(inputs.Constraints))
  {
    (IsNear(constraint, deep->Voxels) ? deep->Constraints : shallow).push_back(constraint);
  }
  deep->Start = inputs.Start.Points;
  if (!this->Deep || !this->Deep->IsSameAs(*deep))
  {
    if (!this->RunDeepChange(inputs.Part(0, 0.8), *deep))
    {
      return false;
    }
    this->Deep = std::move(deep);
  }
  this->Organ.GetSurface().Iterations = this->Deep->Iterations;
  this->Organ.SettleForeground(corrected);
  return this->RunLastLevelFrom(this->Deep->Surface, { std::move(changed), shallow },
    inputs.Part(0.8, 1));
}

bool RunScheduler::Run(const RunInputs& inputs)
{
  if (inputs.Constraints.empty() || !this->HasSurface())
  {
    return this->RunAllLevels(inputs);
  }
  BitMask corrected = this->Organ.GetForeground().GetMask();
  const std::vector<IterationRecord> before = this->Organ.GetSurface().Iterations;
  if (const std::optional<bool> done =
        UnlessUnreachable([&] { return this->Correct(corrected, inputs); }))
  {
    return *done;
  }
  this->Organ.SettleForeground(std::move(corrected));
  this->Organ.GetSurface().Iterations = before;
  return this->RunAllLevels(inputs);
}

} // namespace FlipFree

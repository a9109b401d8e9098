#include "Deformation/UnconstrainedCorrection.h"

#include "Deformation/JointDeformation.h"
#include "Error.h"

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
struct UnconstrainedCorrection::DeepPart
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

UnconstrainedCorrection::UnconstrainedCorrection(DeformingOrgan& organ,
  const ParallelFor& parallelFor)
  : Organ(organ)
  , Parallel(parallelFor)
{
}

UnconstrainedCorrection::~UnconstrainedCorrection() = default;

void UnconstrainedCorrection::Forget()
{
  this->Surface = {};
  this->DeepParts.clear();
}

void UnconstrainedCorrection::Begin(OutsidePoints outside, const RunInputs& inputs)
{
  this->Organ.BeginAt(inputs.Start, inputs.FirstLevel, inputs.Constraints, outside,
    inputs.Observer);
}

// Where the surface cannot be pulled back from an outside point, it keeps off from the start.
bool UnconstrainedCorrection::RunAllLevelsTo(const std::vector<EndSurface>& ends,
  const RunInputs& inputs)
{
  const std::vector<IterationRecord> before = this->Organ.GetSurface().Iterations;
  const auto run = [&](OutsidePoints outside)
  {
    this->Organ.GetSurface().Iterations = before;
    this->Begin(outside, inputs);
    this->Organ.EndOn(ends);
    return JointDeformation({ &this->Organ }, {}, this->Parallel).Run(inputs.Proceed);
  };
  const std::optional<bool> done =
    UnlessUnreachable([&] { return run(OutsidePoints::InTheLastLevel); });
  return done ? *done : run(OutsidePoints::FromTheStart);
}

EndSurface UnconstrainedCorrection::SurfaceWhereUnchanged(const ConstraintList& constraints,
  const BitMask& uncorrected) const
{
  const auto places = std::make_shared<const UnchangedPlaces>(
    DifferenceOf(uncorrected, this->Organ.GetForeground().GetMask()), constraints);
  return { &this->Surface, [places, &parallel = this->Parallel](const PointList& points) {
            return places->WeightsOf(points, parallel);
          } };
}

bool UnconstrainedCorrection::RunAllLevels(const RunInputs& inputs)
{
  std::vector<EndSurface> ends;
  if (this->Surface.Points.rows() > 0 &&
    (!inputs.Constraints.empty() || inputs.Uncorrected != this->Organ.GetForeground().GetMask()))
  {
    ends.push_back(this->SurfaceWhereUnchanged(inputs.Constraints, inputs.Uncorrected));
  }
  return this->RunAllLevelsTo(ends, inputs);
}

bool UnconstrainedCorrection::RunLastLevelFrom(const DeformableSurface& from,
  const UnchangedPlaces& unchanged, const RunInputs& inputs)
{
  this->Organ.BeginAt(from, inputs.FirstLevel, inputs.Constraints, OutsidePoints::AroundThem,
    inputs.Observer);
  this->Organ.StayIn(unchanged);
  return JointDeformation({ &this->Organ }, {}, this->Parallel).RunLastLevel(inputs.Proceed);
}

// The surface would have to draw back from a leak through the neck, and to bulge far into a lobe,
// so such parts change in runs of all levels: each by itself.
bool UnconstrainedCorrection::FindDeepSurfaces(const RunInputs& inputs)
{
  std::vector<BitMask> deep;
  if (!FindDeepParts(inputs.Uncorrected, this->Organ.GetForeground().GetMask(), DeepChange,
        this->Parallel, PartOf(inputs.Proceed, 0, 0), deep))
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
    part.Start = inputs.Start.Points;
    const auto same = std::find_if(this->DeepParts.begin(), this->DeepParts.end(),
      [&](const DeepPart& other) { return part.IsSameAs(other); });
    if (same != this->DeepParts.end())
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
  this->DeepParts = std::move(parts);
  return true;
}

bool UnconstrainedCorrection::RunDeepPart(const RunInputs& inputs, DeepPart& part)
{
  const RunInputs ofPart = inputs.With(part.Constraints);
  OrganSurface& surface = this->Organ.GetSurface();
  this->Organ.SettleForeground(DifferenceOf(inputs.Uncorrected, part.Voxels));
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
bool UnconstrainedCorrection::JoinDeepSurfaces(const RunInputs& inputs)
{
  BitMask all(inputs.Uncorrected.GetGeometry());
  ConstraintList constraints;
  std::vector<EndSurface> ends(1);
  for (const DeepPart& part : this->DeepParts)
  {
    all.Unite(part.Voxels);
    constraints.insert(constraints.end(), part.Constraints.begin(), part.Constraints.end());
    const auto places = std::make_shared<const UnchangedPlaces>(part.Voxels, part.Constraints);
    ends.push_back({ &part.Surface,
      [places, &parallel = this->Parallel](const PointList& points) -> Eigen::VectorXd
      { return (places->WeightsOf(points, parallel).array() < 1).cast<double>(); } });
  }
  this->Organ.SettleForeground(DifferenceOf(inputs.Uncorrected, all));
  ends.front() = this->SurfaceWhereUnchanged(constraints, inputs.Uncorrected);
  return this->RunAllLevelsTo(ends, inputs.With(SortedConstraints(constraints)));
}

// Moves the surface without constraints only where these have changed the foreground.
// `corrected` is the foreground by all constraints.
bool UnconstrainedCorrection::Correct(const BitMask& corrected, const RunInputs& inputs)
{
  std::vector<IterationRecord> iterations = this->Organ.GetSurface().Iterations;
  // Refuses outside points in the start.
  this->Begin(OutsidePoints::InTheLastLevel, inputs);
  if (!this->FindDeepSurfaces(inputs.Part(0, 0.5)))
  {
    return false;
  }
  const std::vector<DeepPart>& parts = this->DeepParts;
  BitMask changed = DifferenceOf(inputs.Uncorrected, corrected);
  for (const DeepPart& part : parts)
  {
    changed.Remove(part.Voxels);
    Append(part.Iterations, iterations);
  }
  this->Organ.GetSurface().Iterations = std::move(iterations);
  DeformableSurface base = parts.empty() ? this->Surface : parts.front().Surface;
  if (parts.size() > 1)
  {
    if (!this->JoinDeepSurfaces(inputs.Part(0.5, 0.8)))
    {
      return false;
    }
    base = { this->Organ.GetSurface().Mesh, this->Organ.GetSurface().Points };
  }
  this->Organ.SettleForeground(corrected);
  ConstraintList shallow;
  std::copy_if(inputs.Constraints.begin(), inputs.Constraints.end(), std::back_inserter(shallow),
    [&](const PointConstraint& constraint)
    {
      return std::none_of(parts.begin(), parts.end(),
        [&](const DeepPart& part) { return IsNear(constraint, part.Voxels); });
    });
  return this->RunLastLevelFrom(base, { std::move(changed), shallow }, inputs.Part(0.8, 1));
}

bool UnconstrainedCorrection::Run(const RunInputs& inputs)
{
  if (inputs.Constraints.empty() || this->Surface.Points.rows() == 0)
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

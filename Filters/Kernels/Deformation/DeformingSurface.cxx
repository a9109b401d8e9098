#include "Deformation/DeformingSurface.h"

#include "Stopwatch.h"

#include <utility>

namespace FlipFree
{
namespace
{

// A surface that still finds new parts of the boundary has not converged, even where its mean
// distance to the targets grows: new, over ChangeSpan iterations, by this fraction of its vertices.
constexpr double Growth = 0.01;

} // namespace

DeformingSurface::DeformingSurface(const ScheduleSettings& schedule,
  const DeformationStepSettings& step, const VoxelSpacing& spacing, const ParallelFor& parallelFor)
  : Parallel(parallelFor)
  , Schedule(schedule)
  , Step(step)
  , Spacing(spacing)
{
}

void DeformingSurface::ReleaseSurface()
{
  this->Surface = {};
}

void DeformingSurface::BeginAt(const DeformableSurface& start, int firstLevel,
  const ConstraintList& constraints, OutsidePoints outside, const IterationObserver& observer)
{
  this->Surface.Mesh = start.Mesh;
  this->Surface.Points = start.Points;
  this->Surface.Reason = StopReason::NotRun;
  this->FirstLevel = firstLevel;
  this->Observe = observer;
  this->Constraints = constraints;
  this->BeginRun();
  this->End = nullptr;
  this->Mobility.resize(0);
  this->Enforcer.reset();
  if (!constraints.empty())
  {
    this->Enforcer.emplace(constraints, this->Spacing.Finest, outside);
    this->Enforcer->Begin(start.Mesh, FaceHulls(start.Points, start.Mesh.Faces), start.Points);
  }
}

void DeformingSurface::StayIn(const UnchangedPlaces& places)
{
  this->Mobility = 1 - places.WeightsOf(this->Surface.Points, this->Parallel).array();
}

void DeformingSurface::BeginLevel(int level)
{
  this->Level = level;
  this->Surface.Reason = StopReason::NotRun;
  this->Distances.clear();
  this->Matched.clear();
  this->Hulls.reset();
  if (this->Enforcer)
  {
    this->Hulls.emplace(this->Surface.Points, this->Surface.Mesh.Faces);
  }
  this->Solver = std::make_unique<DeformationSolver>(this->Surface.Mesh);
}

void DeformingSurface::BeginIteration()
{
  this->Record = {};
  this->Record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
  this->Record.Level = this->FirstLevel + this->Level;
  this->Record.Vertices = this->Surface.Mesh.NumberOfPoints();
  Stopwatch watch;
  this->Surface.Field = this->SearchTargets(this->Record.Targets);
  this->Record.SearchSeconds = watch.Lap();
}

void DeformingSurface::Stay()
{
  this->BeginIteration();
  this->Surface.Iterations.push_back(this->Record);
  this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, this->Record);
  this->Surface.Reason = StopReason::DistanceBelowTolerance;
}

PointList DeformingSurface::FindMotion()
{
  if (this->HasLevelEnded())
  {
    return PointList::Zero(this->Surface.Points.rows(), 3);
  }
  this->BeginIteration();
  PointList motion = this->Naming(
    [&]
    {
      return FlipFree::FindMotion(*this->Solver, this->Step, this->Surface.Points,
        this->Surface.Field, this->Record.Step);
    });
  if (this->Mobility.size() > 0)
  {
    this->Record.Targets.MeanDistance = this->MeanDistanceOfMobile();
    motion = this->Mobility.asDiagonal() * motion;
  }
  return motion;
}

// Vertices that stay would hide that others have not converged.
double DeformingSurface::MeanDistanceOfMobile() const
{
  double sum = 0;
  double count = 0;
  for (Eigen::Index vertex = 0; vertex < this->Mobility.size(); ++vertex)
  {
    if (this->Surface.Field.States[vertex] != VertexState::Solitary)
    {
      sum += this->Mobility[vertex] * this->Surface.Field.Displacements.row(vertex).norm();
      count += this->Mobility[vertex];
    }
  }
  return count > 0 ? sum / count : 0;
}

void DeformingSurface::Move(PointList points, int guarded, double guardSeconds)
{
  this->Surface.Points = std::move(points);
  this->Record.Step.Guarded = guarded;
  this->Record.Step.GuardSeconds = guardSeconds;
  this->Surface.Iterations.push_back(this->Record);
  this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, this->Record);
  this->Distances.push_back(this->Record.Targets.MeanDistance);
  this->Matched.push_back(this->Record.Targets.Matched);
  this->Surface.Reason = this->ReasonToEndLevel();
}

// Asked once there are more than ChangeSpan iterations.
bool DeformingSurface::IsGrowing() const
{
  const int before = this->Matched[this->Matched.size() - 1 - ScheduleSettings::ChangeSpan];
  return this->Matched.back() - before > Growth * this->Surface.Mesh.NumberOfPoints();
}

// NotRun: the level goes on.
StopReason DeformingSurface::ReasonToEndLevel() const
{
  if (this->Matched.back() == 0)
  {
    return StopReason::NoBoundaryFound;
  }
  const StopReason reason = this->Schedule.ReasonToStop(this->Distances, this->Spacing.Coarsest);
  return reason == StopReason::Converged && this->IsGrowing() ? StopReason::NotRun : reason;
}

void DeformingSurface::Replace(ContourMesh mesh, PointList points)
{
  this->Solver.reset();
  this->Surface.Mesh = std::move(mesh);
  this->Surface.Points = std::move(points);
}

PointList DeformingSurface::GetObstacles() const
{
  return this->Enforcer ? this->Enforcer->GetObstacles() : PointList(0, 3);
}

void DeformingSurface::UpdateObstacles()
{
  if (this->Enforcer)
  {
    this->Enforcer->Update(this->Surface.Mesh, *this->Hulls, this->Surface.Points);
  }
}

bool DeformingSurface::FinishConstraints(bool isLast, const GuardedStep& step,
  const Monitor& monitor)
{
  OrganSurface& surface = this->Surface;
  if (isLast && this->End &&
    !Attract(*this->End, this->EndPlaces->WeightsOf(surface.Points, this->Parallel),
      this->GetObstacles(), step, this->Parallel, monitor, surface.Points))
  {
    return false;
  }
  if (!this->Enforcer)
  {
    return true;
  }
  const FaceHulls hulls(surface.Points, surface.Mesh.Faces);
  const PointList before = surface.Points;
  const bool done = this->Naming(
    [&]
    {
      return isLast ? this->Enforcer->Finish(surface.Mesh, hulls, step, monitor, surface.Points)
                    : this->Enforcer->PullBack(surface.Mesh, hulls, step, monitor, surface.Points);
    });
  this->FreePulled(before);
  return done;
}

// Vertices that were pulled from one place to another must find the boundary again: they move
// freely if it was by a quarter of a voxel or more, and more freely than before if by less.
void DeformingSurface::FreePulled(const PointList& from)
{
  if (this->Mobility.size() > 0)
  {
    const Eigen::VectorXd pulled =
      (this->Surface.Points - from).rowwise().norm() / this->Spacing.Coarsest;
    this->Mobility = this->Mobility.cwiseMax((4 * pulled).cwiseMin(1));
  }
}

} // namespace FlipFree

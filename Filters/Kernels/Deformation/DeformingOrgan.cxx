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

// A surface that still finds new parts of the boundary has not converged, even where its mean
// distance to the targets grows: new, over ChangeSpan iterations, by this fraction of its vertices.
constexpr double Growth = 0.01;

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
  : Noise(noise)
  , Seed(seed)
  , Settings(settings)
  , Parallel(parallelFor)
  , Voxel(region.View().Geometry.Spacing.maxCoeff())
  , Foreground(region, this->Seed, this->Settings.Feature,
      2 * EdgeWindowOf(settings.Targets, region.View().Geometry), parallelFor)
  , NewTissue(region, noise, this->Settings.Feature, parallelFor)
  , OrganRadius(seed.Radius)
{
}

void DeformingOrgan::ReleaseSurface(double seconds)
{
  this->Surface = {};
  this->Surface.FeatureSeconds = seconds;
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

bool DeformingOrgan::RefitForeground(const Monitor& monitor)
{
  return this->FindForegroundOfSurface(monitor) &&
    this->CorrectForeground(this->Constraints, monitor);
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

void DeformingOrgan::BeginAt(const DeformableSurface& start, int firstLevel,
  const ConstraintList& constraints, OutsidePoints outside, const IterationObserver& observer)
{
  this->Surface.Mesh = start.Mesh;
  this->Surface.Points = start.Points;
  this->Surface.Reason = StopReason::NotRun;
  this->FirstLevel = firstLevel;
  this->Observe = observer;
  this->Constraints = constraints;
  if (this->Settled)
  {
    this->OrganRadius = RadiusOf(this->Foreground.GetMask(), this->Seed);
  }
  this->End = nullptr;
  this->Mobility.resize(0);
  this->Enforcer.reset();
  if (!constraints.empty())
  {
    this->Enforcer.emplace(constraints, this->Foreground.GetMask().GetGeometry().Spacing.minCoeff(),
      outside);
    this->Enforcer->Begin(start.Mesh, FaceHulls(start.Points, start.Mesh.Faces), start.Points);
  }
}

void DeformingOrgan::StayIn(const UnchangedPlaces& places)
{
  this->Mobility = 1 - places.WeightsOf(this->Surface.Points, this->Parallel).array();
}

void DeformingOrgan::BeginLevel(int level)
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

// In the last level, and not to a carved foreground: it ends where the edge is, by its own rule.
bool DeformingOrgan::SnapsToEdges() const
{
  return this->Level + 1 >= this->Settings.Schedule.NumberOfLevels() && !this->Settled;
}

void DeformingOrgan::FindTargets()
{
  this->Record = {};
  this->Record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
  this->Record.Level = this->FirstLevel + this->Level;
  this->Record.Vertices = this->Surface.Mesh.NumberOfPoints();

  TargetSettings targets = this->Settings.Targets;
  targets.Correspondence.Ramp = this->Model.Ramp;
  if (!this->SnapsToEdges())
  {
    targets.Correspondence.EdgeWindow = 0;
  }
  Stopwatch watch;
  this->Surface.Field = FlipFree::FindTargets(this->Surface.Mesh, this->Surface.Points,
    this->Foreground.GetMask(), this->Foreground.GetNoData(), this->Foreground.GetImage(),
    this->OrganRadius, targets, this->Parallel, this->Record.Targets);
  this->Record.SearchSeconds = watch.Lap();
}

void DeformingOrgan::Stay()
{
  this->FindTargets();
  this->Surface.Iterations.push_back(this->Record);
  this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, this->Record);
  this->Surface.Reason = StopReason::DistanceBelowTolerance;
}

PointList DeformingOrgan::FindMotion()
{
  if (this->HasLevelEnded())
  {
    return PointList::Zero(this->Surface.Points.rows(), 3);
  }
  this->FindTargets();
  PointList motion = this->Naming(
    [&]
    {
      return FlipFree::FindMotion(*this->Solver, this->Settings.Step, this->Surface.Points,
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
double DeformingOrgan::MeanDistanceOfMobile() const
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

void DeformingOrgan::Move(PointList points, int guarded, double guardSeconds)
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
bool DeformingOrgan::IsGrowing() const
{
  const int before = this->Matched[this->Matched.size() - 1 - ScheduleSettings::ChangeSpan];
  return this->Matched.back() - before > Growth * this->Surface.Mesh.NumberOfPoints();
}

// NotRun: the level goes on.
StopReason DeformingOrgan::ReasonToEndLevel() const
{
  if (this->Matched.back() == 0)
  {
    return StopReason::NoBoundaryFound;
  }
  const StopReason reason = this->Settings.Schedule.ReasonToStop(this->Distances, this->Voxel);
  return reason == StopReason::Converged && this->IsGrowing() ? StopReason::NotRun : reason;
}

void DeformingOrgan::Replace(ContourMesh mesh, PointList points)
{
  this->Solver.reset();
  this->Surface.Mesh = std::move(mesh);
  this->Surface.Points = std::move(points);
}

PointList DeformingOrgan::GetObstacles() const
{
  return this->Enforcer ? this->Enforcer->GetObstacles() : PointList(0, 3);
}

void DeformingOrgan::UpdateObstacles()
{
  if (this->Enforcer)
  {
    this->Enforcer->Update(this->Surface.Mesh, *this->Hulls, this->Surface.Points);
  }
}

bool DeformingOrgan::FinishConstraints(bool isLast, const GuardedStep& step, const Monitor& monitor)
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
void DeformingOrgan::FreePulled(const PointList& from)
{
  if (this->Mobility.size() > 0)
  {
    const Eigen::VectorXd pulled = (this->Surface.Points - from).rowwise().norm() / this->Voxel;
    this->Mobility = this->Mobility.cwiseMax((4 * pulled).cwiseMin(1));
  }
}

} // namespace FlipFree

#include "Deformation/OrganSegmentation.h"

#include "Deformation/ConstraintEnforcer.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/SurfaceRefinement.h"
#include "Intensity/GrowingForeground.h"
#include "Intensity/ModelFit.h"
#include "Intensity/OrganCarving.h"
#include "Stopwatch.h"

#include <memory>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

// The iterations over which the mean distance must fall.
constexpr std::size_t ChangeSpan = 5;
// A surface that still finds new parts of the boundary is not at rest, even where its mean distance
// to the targets grows: new by this fraction of its vertices.
constexpr double Growth = 0.01;

} // namespace

// Runs the levels one after the other, each from the surface of the one before.
class OrganSegmenter::CoarseToFine
{
public:
  CoarseToFine(SmoothRegion& region, double noise, const SeedSphere& seed,
    const DeformableSurface& start, const OrganSegmentationSettings& settings,
    const ParallelFor& parallelFor)
    : Noise(noise)
    , Seed(seed)
    , Start(start)
    , Settings(settings)
    , Parallel(parallelFor)
    , OrganRadius(seed.Radius)
    , Levels(settings.Schedule.NumberOfLevels())
    , Voxel(region.View().Geometry.Spacing.maxCoeff())
    , Foreground(region, this->Seed, this->Settings.Feature,
        2 * EdgeWindowOf(settings.Targets, region.View().Geometry), parallelFor)
  {
  }

  void SetForeground(BitMask mask)
  {
    this->Carved = std::move(mask);
    this->IsCarved = true;
    this->IsGiven = true;
  }

  OrganSurface Execute(const ConstraintList& constraints, const DeformableSurface* start,
    const Monitor& monitor, const IterationObserver& observer)
  {
    this->Constraints = SortedConstraints(constraints);
    this->Ask = monitor;
    this->Observe = observer;
    this->Stopped = false;
    this->Enforcer.reset();
    this->Surface = {};
    const double smoothing = this->Foreground.GetSmoothingSeconds();
    this->Surface.Reason = this->Run(start ? *start : this->Start);
    this->Surface.SmoothingSeconds = this->Foreground.GetSmoothingSeconds() - smoothing;
    this->Surface.FeatureSeconds -= this->Surface.SmoothingSeconds;
    return std::move(this->Surface);
  }

private:
  bool RunsTwice() const { return this->Settings.Feature.Carving && !this->IsGiven; }
  int LevelsBefore() const { return this->RunsTwice() && this->IsCarved ? this->Levels : 0; }

  // Remembers a stop, and does not ask again.
  bool Proceed(int level, double partOfLevel)
  {
    const int runs = this->RunsTwice() ? 2 : 1;
    this->Stopped = this->Stopped ||
      !this->Ask((this->LevelsBefore() + level + partOfLevel) / (runs * this->Levels));
    return !this->Stopped;
  }

  // With carving, all levels run twice: a surface that has leaked would have to draw back through
  // the neck, so the second run starts anew.
  StopReason Run(const DeformableSurface& start)
  {
    if (this->Settings.Feature.Carving || this->IsGiven)
    {
      if (!this->IsCarved && !this->RunFirst())
      {
        return StopReason::Aborted;
      }
      this->Surface.Iterations = this->FirstIterations;
      this->Surface.First = this->FirstSurface;
      this->Surface.Unanimity = this->Foreground.GetUnanimity();
      Stopwatch watch;
      this->Foreground.SetMask(this->Carved);
      if (!this->CorrectForeground([this](double) { return this->Proceed(0, 0); }))
      {
        return StopReason::Aborted;
      }
      this->OrganRadius = RadiusOf(this->Foreground.GetMask(), this->Seed);
      this->Surface.FeatureSeconds += watch.Lap();
    }
    else if (!this->FindForegroundOfSeed())
    {
      return StopReason::Aborted;
    }
    this->BeginAt(start);
    if (!this->Constraints.empty())
    {
      this->Enforcer.emplace(this->Constraints,
        this->Foreground.GetMask().GetGeometry().Spacing.minCoeff());
      this->Enforcer->Begin(start.Mesh, FaceHulls(start.Points, start.Mesh.Faces), start.Points);
    }
    const StopReason reason = this->IterateLevels();
    return reason != StopReason::Aborted && this->FinishConstraints() ? reason
                                                                      : StopReason::Aborted;
  }

  bool FinishConstraints()
  {
    if (!this->Enforcer)
    {
      return true;
    }
    EmbeddingGuard guard(this->Surface.Mesh);
    const Monitor proceed = [this](double) { return this->Proceed(this->Levels - 1, 1); };
    return this->Enforcer->Finish(this->Surface.Mesh, guard, this->Parallel, proceed,
      this->Surface.Points);
  }

  // What is kept between calls.
  bool RunFirst()
  {
    const ConstraintList constraints = std::move(this->Constraints);
    this->Constraints.clear();
    if (!this->FindForegroundOfSeed())
    {
      return false;
    }
    this->BeginAt(this->Start);
    if (this->IterateLevels() == StopReason::Aborted || !this->CarveSurface())
    {
      return false;
    }
    this->FirstSurface = { this->Surface.Mesh, this->Surface.Points };
    this->FirstIterations = this->Surface.Iterations;
    this->Carved = this->Foreground.GetMask();
    this->Constraints = constraints;
    return true;
  }

  void BeginAt(const DeformableSurface& start)
  {
    this->Surface.Mesh = start.Mesh;
    this->Surface.Points = start.Points;
  }

  bool CorrectForeground(const Monitor& proceed)
  {
    return this->Constraints.empty() ||
      this->Foreground.Correct(this->Constraints, this->Noise, proceed);
  }

  StopReason IterateLevels()
  {
    StopReason reason = StopReason::NotRun;
    for (this->Level = 0; this->Level < this->Levels && !this->Stopped; ++this->Level)
    {
      if (this->Level > 0)
      {
        const Monitor proceed = [this](double) { return this->Proceed(this->Level - 1, 1); };
        if (!this->Refine(proceed))
        {
          return this->Stopped ? StopReason::Aborted : StopReason::NotRefined;
        }
        if (this->Settings.Feature.ReestimateIntensities && !this->IsCarved &&
          !this->FindForegroundOfSurface(proceed))
        {
          return StopReason::Aborted;
        }
      }
      reason = this->IterateLevel();
    }
    return this->Stopped ? StopReason::Aborted : reason;
  }

  bool CarveSurface()
  {
    const Monitor proceed = [this](double) { return this->Proceed(this->Levels, 0); };
    Stopwatch watch;
    this->IsCarved = this->Foreground.Carve(this->Surface.Points, this->Surface.Mesh.Triangles,
      this->Noise, proceed);
    this->Surface.FeatureSeconds += watch.Lap();
    return this->IsCarved;
  }

  bool FindForegroundOfSeed()
  {
    const Monitor proceed = [this](double) { return this->Proceed(0, 0); };
    Stopwatch watch;
    if (!this->Foreground.SmoothAroundSeed(proceed))
    {
      return false;
    }
    this->Model = FitToSeed(this->Foreground.GetImage(), this->Seed, this->Noise,
      this->Settings.Feature.Intensity);
    if (!this->Foreground.Update(this->Model, proceed))
    {
      return false;
    }
    RequireContrast(this->Foreground.GetMask());
    if (!this->CorrectForeground(proceed))
    {
      return false;
    }
    this->Surface.FeatureSeconds += watch.Lap();
    return true;
  }

  bool FindForegroundOfSurface(const Monitor& proceed)
  {
    const IntensitySettings& settings = this->Settings.Feature.Intensity;
    Stopwatch watch;
    this->Foreground.Clear(); // what follows needs the memory
    if (!this->Foreground.SmoothAround(this->Surface.Points, settings.ShellEnd, proceed))
    {
      return false;
    }
    RefitToSurface(this->Foreground.GetImage(), this->Surface.Points, this->Surface.Mesh.Triangles,
      this->Noise, settings, this->Parallel, proceed, this->Model);
    const bool done =
      this->Foreground.Update(this->Model, proceed) && this->CorrectForeground(proceed);
    this->Surface.FeatureSeconds += watch.Lap();
    return done;
  }

  bool Refine(const Monitor& proceed)
  {
    RefinedSurface refined = RefineSurface(this->Surface.Mesh, this->Surface.Points,
      this->Enforcer ? this->Enforcer->GetObstacles() : PointList(0, 3), this->Settings.Step.Guard,
      this->Parallel, proceed);
    if (!refined.Embedded)
    {
      return false;
    }
    this->Surface.Mesh = std::move(refined.Mesh);
    this->Surface.Points = std::move(refined.Points);
    return true;
  }

  StopReason IterateLevel()
  {
    std::unique_ptr<EmbeddingGuard> guard;
    if (this->Settings.Step.Guard)
    {
      guard = std::make_unique<EmbeddingGuard>(this->Surface.Mesh);
    }
    DeformationSolver solver(this->Surface.Mesh);
    std::vector<TargetReport> reports;
    for (int iteration = 0; iteration < this->Settings.Schedule.MaximumIterations; ++iteration)
    {
      const double part =
        static_cast<double>(iteration) / this->Settings.Schedule.MaximumIterations;
      if (!this->Proceed(this->Level, part))
      {
        return StopReason::Aborted;
      }
      if (this->Enforcer)
      {
        this->Enforcer->Update(this->Surface.Mesh, guard->Hulls(), this->Surface.Points);
        guard->SetObstacles(this->Enforcer->GetObstacles());
      }
      reports.push_back(this->IterateOnce(solver, guard.get(), part));
      const StopReason reason = this->ReasonToStop(reports);
      if (reason != StopReason::NotRun)
      {
        return reason;
      }
    }
    return StopReason::IterationLimit;
  }

  // NotRun: the level goes on.
  StopReason ReasonToStop(const std::vector<TargetReport>& reports) const
  {
    const ScheduleSettings& schedule = this->Settings.Schedule;
    const TargetReport& now = reports.back();
    if (now.Matched == 0)
    {
      return StopReason::NoBoundaryFound;
    }
    if (now.MeanDistance < this->Voxel * schedule.DistanceTolerance)
    {
      return StopReason::DistanceBelowTolerance;
    }
    if (schedule.ChangeTolerance < 0 || reports.size() <= ChangeSpan)
    {
      return StopReason::NotRun;
    }
    const TargetReport& before = reports[reports.size() - 1 - ChangeSpan];
    const bool grows = now.Matched - before.Matched > Growth * this->Surface.Mesh.NumberOfPoints();
    const bool rests =
      before.MeanDistance - now.MeanDistance < this->Voxel * schedule.ChangeTolerance;
    return rests && !grows ? StopReason::AtRest : StopReason::NotRun;
  }

  TargetReport IterateOnce(DeformationSolver& solver, const EmbeddingGuard* guard, double part)
  {
    IterationRecord record;
    record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
    record.Level = this->Level + this->LevelsBefore();
    record.Vertices = this->Surface.Mesh.NumberOfPoints();

    TargetSettings targets = this->Settings.Targets;
    targets.Correspondence.Ramp = this->Model.Ramp;
    // The carved foreground ends where the edge is, by its own rule.
    if (this->Level + 1 < this->Levels || this->IsCarved)
    {
      targets.Correspondence.EdgeWindow = 0;
    }
    Stopwatch watch;
    this->Surface.Field =
      FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground.GetMask(),
        this->Foreground.GetImage(), this->OrganRadius, targets, this->Parallel, record.Targets);
    record.SearchSeconds = watch.Lap();

    const Monitor proceed = [this, part](double) { return this->Proceed(this->Level, part); };
    record.Step = DeformOnce(solver, guard, this->Settings.Step, this->Parallel, proceed,
      this->Surface.Field, this->Surface.Points);
    this->Surface.Iterations.push_back(record);
    this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, record);
    return record.Targets;
  }

  const double Noise;
  const SeedSphere Seed;
  const DeformableSurface Start;
  const OrganSegmentationSettings Settings;
  const ParallelFor& Parallel;

  // Of the present call.
  ConstraintList Constraints;
  std::optional<ConstraintEnforcer> Enforcer;
  Monitor Ask;
  IterationObserver Observe;
  OrganSurface Surface;

  double OrganRadius; // the seed's, until more is known
  const int Levels;
  const double Voxel; // the greatest spacing
  GrowingForeground Foreground;
  IntensityModel Model;
  int Level = 0;
  bool Stopped = false;
  bool IsCarved = false;
  bool IsGiven = false; // the foreground; there is no first run then

  // Of the first run.
  std::vector<IterationRecord> FirstIterations;
  DeformableSurface FirstSurface;
  BitMask Carved;
};

OrganSegmenter::OrganSegmenter(SmoothRegion& region, double noise, const SeedSphere& seed,
  const DeformableSurface& start, const OrganSegmentationSettings& settings,
  const ParallelFor& parallelFor)
  : Levels(std::make_unique<CoarseToFine>(region, noise, seed, start, settings, parallelFor))
  , Parallel(parallelFor)
{
}

OrganSegmenter::~OrganSegmenter() = default;

void OrganSegmenter::SetForeground(BitMask mask)
{
  this->Levels->SetForeground(std::move(mask));
}

OrganSurface OrganSegmenter::Segment(const ConstraintList& constraints,
  const DeformableSurface* start, const Monitor& monitor, const IterationObserver& observer)
{
  OrganSurface surface = this->Levels->Execute(constraints, start, monitor, observer);
  if (surface.Reason != StopReason::Aborted)
  {
    surface.SelfIntersections =
      CountSelfIntersections(surface.Points, surface.Mesh.Faces, this->Parallel);
  }
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

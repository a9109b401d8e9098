#include "OrganSegmentation.h"

#include "SelfIntersection.h"
#include "Stopwatch.h"
#include "SurfaceRefinement.h"

#include <memory>

namespace FlipFree
{
namespace
{

constexpr std::size_t ChangeSpan = 5;
// A surface that still finds new parts of the boundary is not at rest, though its mean distance to
// what it has found may grow: by this part of its vertices.
constexpr double Growth = 0.01;

class Run
{
public:
  Run(const ImageView<float>& smooth, double noise, const SeedSphere& seed,
    const OrganSegmentationSettings& settings, const ParallelFor& parallelFor,
    const Monitor& monitor, const IterationObserver& observer, OrganSurface& surface)
    : Smooth(smooth)
    , Noise(noise)
    , Seed(seed)
    , Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Observe(observer)
    , Surface(surface)
  {
  }

  void Execute()
  {
    Stopwatch watch;
    this->Model =
      FitToSeed(this->Smooth, this->Seed, this->Noise, this->Settings.Feature.Intensity);
    this->UpdateForeground([this](double) { return this->Proceed(0, 0); });
    if (!this->Stopped)
    {
      RequireContrast(this->Foreground);
    }
    this->Surface.FeatureSeconds += watch.Lap();
    for (int level = 0; level < this->Settings.Levels; ++level)
    {
      if (level > 0 && !this->NextLevel())
      {
        return;
      }
      this->IterateLevel(level);
      if (this->Stopped)
      {
        this->Surface.StopReason = "aborted";
        return;
      }
    }
  }

private:
  bool Proceed(int level, double partOfLevel)
  {
    this->Stopped = this->Stopped || !this->Ask((level + partOfLevel) / this->Settings.Levels);
    return !this->Stopped;
  }

  // The search asks of the feature only where it is above its threshold.
  void UpdateForeground(const Monitor& proceed)
  {
    FindForeground(this->Smooth, this->Model, this->Seed, this->Settings.Feature, this->Parallel,
      proceed, this->Foreground);
  }

  bool NextLevel()
  {
    const Monitor proceed = [this](double) { return this->Proceed(this->Level, 1); };
    RefinedSurface refined = RefineSurface(this->Surface.Mesh, this->Surface.Points,
      this->Settings.Guard, this->Parallel, proceed);
    if (!refined.Embedded)
    {
      this->Surface.StopReason =
        this->Stopped ? "aborted" : "the coarse surface could not be refined";
      return false;
    }
    this->Surface.Mesh = std::move(refined.Mesh);
    this->Surface.Points = std::move(refined.Points);
    if (this->Settings.Reestimate)
    {
      Stopwatch watch;
      this->Foreground = BitMask(); // what follows has need of the memory
      RefitToSurface(this->Smooth, this->Surface.Points, this->Surface.Mesh.Triangles, this->Noise,
        this->Settings.Feature.Intensity, this->Parallel, proceed, this->Model);
      this->UpdateForeground(proceed);
      this->Surface.FeatureSeconds += watch.Lap();
    }
    return true;
  }

  void IterateLevel(int level)
  {
    this->Level = level;
    std::unique_ptr<EmbeddingGuard> guard;
    if (this->Settings.Guard)
    {
      guard = std::make_unique<EmbeddingGuard>(this->Surface.Mesh);
    }
    DeformationSolver solver(this->Surface.Mesh);
    const bool finest = level + 1 == this->Settings.Levels;
    std::vector<TargetReport> reports;
    this->Surface.StopReason = "iteration limit";
    for (int iteration = 0; iteration < this->Settings.MaximumIterations; ++iteration)
    {
      const double part = static_cast<double>(iteration) / this->Settings.MaximumIterations;
      if (!this->Proceed(level, part))
      {
        return;
      }
      reports.push_back(this->IterateOnce(solver, guard.get(), finest, part));
      if (this->IsLevelDone(reports))
      {
        return;
      }
    }
  }

  bool IsLevelDone(const std::vector<TargetReport>& reports)
  {
    const TargetReport& now = reports.back();
    if (now.Matched == 0)
    {
      this->Surface.StopReason = "no boundary found";
      return true;
    }
    if (now.MeanDistance < this->Settings.DistanceTolerance)
    {
      this->Surface.StopReason = "distance below tolerance";
      return true;
    }
    if (this->Settings.ChangeTolerance < 0 || reports.size() <= ChangeSpan)
    {
      return false;
    }
    const TargetReport& before = reports[reports.size() - 1 - ChangeSpan];
    const bool grows = now.Matched - before.Matched > Growth * this->Surface.Mesh.NumberOfPoints();
    if (!grows && before.MeanDistance - now.MeanDistance < this->Settings.ChangeTolerance)
    {
      this->Surface.StopReason = "at rest";
      return true;
    }
    return false;
  }

  TargetReport IterateOnce(DeformationSolver& solver, const EmbeddingGuard* guard, bool finest,
    double part)
  {
    IterationRecord record;
    record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
    record.Level = this->Level;
    record.Vertices = this->Surface.Mesh.NumberOfPoints();

    TargetSettings targets = this->Settings.Targets;
    targets.Correspondence.Ramp = this->Model.Ramp;
    if (!finest)
    {
      targets.Correspondence.EdgeWindow = 0;
    }
    Stopwatch watch;
    this->Surface.Field = FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground,
      this->Smooth, targets, this->Parallel, record.Targets);
    record.SearchSeconds = watch.Lap();

    const Monitor proceed = [this, part](double) { return this->Proceed(this->Level, part); };
    record.Step = DeformOnce(solver, guard, this->Settings.Step, this->Parallel, proceed,
      this->Surface.Field, this->Surface.Points);
    this->Surface.Iterations.push_back(record);
    this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, record);
    return record.Targets;
  }

  const ImageView<float>& Smooth;
  double Noise;
  const SeedSphere& Seed;
  const OrganSegmentationSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const IterationObserver& Observe;
  OrganSurface& Surface;

  IntensityModel Model;
  BitMask Foreground;
  int Level = 0;
  bool Stopped = false;
};

} // namespace

OrganSurface SegmentOrgan(const ImageView<float>& smooth, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer)
{
  OrganSurface surface;
  surface.Mesh = startMesh;
  surface.Points = startPoints;
  Run(smooth, noise, seed, settings, parallelFor, monitor, observer, surface).Execute();
  if (surface.StopReason != "aborted")
  {
    surface.SelfIntersections = CountSelfIntersections(surface.Points, surface.Mesh.Triangles);
  }
  return surface;
}

} // namespace FlipFree

#include "Vessel/OutlineFit.h"

#include "Deformation/ConstraintEnforcer.h"
#include "Guard/SurfaceRefinement.h"
#include "Stopwatch.h"
#include "Vessel/TreeDepth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace FlipFree
{
namespace
{

constexpr double RoundedEdge = 0.7; // mm: the outline's edge in the image of depths, for snapping

class OutlineFit
{
public:
  OutlineFit(const VesselTree& tree, const ConstraintList& constraints, double spacing,
    const VesselSegmentationSettings& settings, const ParallelFor& parallelFor,
    const Monitor& monitor, OrganSurface& surface)
    : Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Surface(surface)
    , Radius(SmallestRadius(tree))
    , Edges(DepthOnGrid(tree, std::max(0.5, std::min(1.2, Radius / 5)), 4, parallelFor))
  {
    this->Foreground = VoxelsWhere(
      this->Edges.View(), [](float value) { return value > 0; }, parallelFor);
    std::transform(this->Edges.Voxels.begin(), this->Edges.Voxels.end(), this->Edges.Voxels.begin(),
      [](float value) { return std::tanh(value / RoundedEdge); });
    if (!constraints.empty())
    {
      this->Enforcer.emplace(constraints, spacing);
    }
  }

  StopReason Run()
  {
    if (this->Enforcer)
    {
      this->Enforcer->Begin(this->Surface.Mesh,
        FaceHulls(this->Surface.Points, this->Surface.Mesh.Faces), this->Surface.Points);
    }
    const StopReason reason = this->IterateLevels();
    return reason != StopReason::Aborted && this->FinishConstraints() ? reason
                                                                      : StopReason::Aborted;
  }

private:
  bool Proceed() const { return this->Ask(this->Done); }

  bool FinishConstraints()
  {
    if (!this->Enforcer)
    {
      return true;
    }
    return this->Enforcer->Finish(
      this->Surface.Mesh, *this->Guard, this->Parallel, [this](double) { return this->Proceed(); },
      this->Surface.Points);
  }

  StopReason IterateLevels()
  {
    StopReason reason = StopReason::NotRun;
    for (this->Level = 0; this->Level < this->Settings.Levels; ++this->Level)
    {
      if (this->Level > 0)
      {
        RefinementSurroundings surroundings;
        if (this->Enforcer)
        {
          surroundings.Obstacles = this->Enforcer->GetObstacles();
        }
        RefinedSurface refined =
          RefineSurface(this->Surface.Mesh, this->Surface.Points, surroundings,
            this->Settings.Step.Guard, this->Parallel, [this](double) { return this->Proceed(); });
        if (!refined.Embedded)
        {
          return this->Proceed() ? ReasonOfUnrefined(reason) : StopReason::Aborted;
        }
        this->Surface.Mesh = std::move(refined.Mesh);
        this->Surface.Points = std::move(refined.Points);
        this->Guard = std::move(refined.Guard);
      }
      reason = this->IterateLevel();
      if (reason == StopReason::Aborted)
      {
        break;
      }
    }
    return reason;
  }

  StopReason IterateLevel()
  {
    if (this->Settings.Step.Guard && !this->Guard)
    {
      this->Guard = std::make_unique<EmbeddingGuard>(this->Surface.Mesh, this->Parallel);
    }
    DeformationSolver solver(this->Surface.Mesh);
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < this->Settings.MaximumIterations; ++iteration)
    {
      const double part = static_cast<double>(iteration) / this->Settings.MaximumIterations;
      this->Done = (this->Level + part) / this->Settings.Levels;
      if (!this->Proceed())
      {
        return StopReason::Aborted;
      }
      if (this->Enforcer)
      {
        this->Enforcer->Update(this->Surface.Mesh, this->Guard->Hulls(), this->Surface.Points);
        this->Guard->SetObstacles(this->Enforcer->GetObstacles());
      }
      const TargetReport report = this->IterateOnce(solver);
      const double voxel = this->Edges.Geometry.Spacing[0];
      if (report.Matched == 0)
      {
        return StopReason::NoBoundaryFound;
      }
      if (report.MeanDistance < 0.1 * voxel)
      {
        return StopReason::DistanceBelowTolerance;
      }
      if (iteration % 3 == 2)
      {
        if (before - report.MeanDistance < 0.05 * voxel)
        {
          return StopReason::Converged;
        }
        before = report.MeanDistance;
      }
    }
    return StopReason::IterationLimit;
  }

  TargetReport IterateOnce(DeformationSolver& solver)
  {
    IterationRecord record;
    record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
    record.Level = this->Level;
    record.Vertices = this->Surface.Mesh.NumberOfPoints();
    TargetSettings targets = this->Settings.Targets;
    targets.Correspondence.SearchDistance = std::max(5.0, 2.5 * this->Radius);
    targets.Correspondence.RunLength = this->Edges.Geometry.Spacing[0];
    targets.Correspondence.EdgeWindow = this->Edges.Geometry.Spacing[0];
    targets.Correspondence.ImageBoundaryDistance = 0;
    Stopwatch watch;
    this->Surface.Field = FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground,
      {}, this->Edges.View(), this->Radius, targets, this->Parallel, record.Targets);
    record.SearchSeconds = watch.Lap();
    const Monitor proceed = [this](double) { return this->Proceed(); };
    record.Step = DeformOnce(solver, this->Guard.get(), this->Settings.Step, this->Parallel,
      proceed, this->Surface.Field, this->Surface.Points);
    this->Surface.Iterations.push_back(record);
    return record.Targets;
  }

  const VesselSegmentationSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  OrganSurface& Surface;
  double Radius;
  FloatImage Edges;
  BitMask Foreground;
  std::optional<ConstraintEnforcer> Enforcer;
  std::unique_ptr<EmbeddingGuard> Guard; // of the level's surface
  int Level = 0;
  double Done = 0; ///< progress
};

} // namespace

StopReason FitToOutline(const VesselTree& tree, const ConstraintList& constraints, double spacing,
  const VesselSegmentationSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor, OrganSurface& surface)
{
  return OutlineFit(tree, constraints, spacing, settings, parallelFor, monitor, surface).Run();
}

} // namespace FlipFree

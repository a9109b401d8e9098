// The stages of one iteration, and the whole of it.
#include "ExampleRun.h"

#include "Deformation/FlipAvoidance.h"
#include "Mesh/SurfaceNormals.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

const SurfaceOnItsWay& SurfaceOf(benchmark::State& state)
{
  return TheExampleRun().Surfaces.at(static_cast<int>(state.range(0)));
}

void ReportTimePerVertex(const SurfaceOnItsWay& surface, benchmark::State& state)
{
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

void Normals(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(VertexNormals(surface.Mesh, surface.Points,
      TheExampleRun().Search.NormalSmoothingIterations));
  }
  ReportTimePerVertex(surface, state);
}

void Search(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  for (auto _ : state)
  {
    TargetReport report;
    benchmark::DoNotOptimize(FindTargets(surface.Mesh, surface.Points, run.Foreground,
      run.Smooth.View(), run.Search, parallelFor, report));
  }
  ReportTimePerVertex(surface, state);
}

void Outliers(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  const PointList normals =
    VertexNormals(surface.Mesh, surface.Points, run.Search.NormalSmoothingIterations);
  const CorrespondenceField found = FindCorrespondences(surface.Points, normals, run.Foreground,
    run.Smooth.View(), run.Search.Correspondence, parallelFor);
  for (auto _ : state)
  {
    CorrespondenceField field = found;
    RejectOutliers(surface.Mesh, normals, run.Search.OutlierStandardDeviations, 3, parallelFor,
      field);
    benchmark::ClobberMemory();
  }
  ReportTimePerVertex(surface, state);
}

void Flips(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const double r = TheExampleRun().Step.FlipThreshold;
  for (auto _ : state)
  {
    CorrespondenceField field = surface.Targets;
    benchmark::DoNotOptimize(DetectFlips(surface.Mesh, surface.Points, r, field));
    benchmark::DoNotOptimize(AvoidFlips(surface.Mesh, surface.Points, r, field));
  }
  ReportTimePerVertex(surface, state);
}

void Propagation(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  CorrespondenceField start = surface.Targets;
  AvoidFlips(surface.Mesh, surface.Points, TheExampleRun().Step.FlipThreshold, start);
  for (auto _ : state)
  {
    CorrespondenceField field = start;
    DiffuseDisplacements(surface.Mesh, TheExampleRun().Step.Propagation, field);
    benchmark::ClobberMemory();
  }
  ReportTimePerVertex(surface, state);
  state.counters["solitary"] = static_cast<double>(
    std::count(start.States.begin(), start.States.end(), VertexState::Solitary));
}

void Solve(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  DeformationSolver solver(surface.Mesh);
  int iterations = 0;
  for (auto _ : state)
  {
    PointList motion = surface.Wanted.Displacements;
    iterations =
      solver
        .Solve(surface.Points, surface.Wanted.Displacements, TheExampleRun().Step.Energy, motion)
        .Iterations;
    benchmark::ClobberMemory();
  }
  ReportTimePerVertex(surface, state);
  state.counters["iterations"] = iterations;
}

void Guard(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  const EmbeddingGuard guard(surface.Mesh);
  GuardReport report;
  for (auto _ : state)
  {
    PointList motion = surface.Motion;
    report = guard.Limit(surface.Points, motion, parallelFor, NeverStop);
  }
  ReportTimePerVertex(surface, state);
  state.counters["passes"] = report.Passes;
  state.counters["held"] = report.HeldBack;
}

void WholeIteration(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  const EmbeddingGuard guard(surface.Mesh);
  DeformationSolver solver(surface.Mesh);
  for (auto _ : state)
  {
    PointList points = surface.Points;
    TargetReport report;
    CorrespondenceField field = FindTargets(surface.Mesh, points, run.Foreground, run.Smooth.View(),
      run.Search, parallelFor, report);
    DeformOnce(solver, &guard, run.Step, parallelFor, NeverStop, field, points);
    benchmark::ClobberMemory();
  }
  ReportTimePerVertex(surface, state);
}

BENCHMARK(Normals)->Apply(Resolutions);
BENCHMARK(Search)->Apply(ResolutionsAndThreads);
BENCHMARK(Outliers)->Apply(ResolutionsAndThreads);
BENCHMARK(Flips)->Apply(Resolutions);
BENCHMARK(Propagation)->Apply(Resolutions);
BENCHMARK(Solve)->Apply(Resolutions);
BENCHMARK(Guard)->Apply(ResolutionsAndThreads);
BENCHMARK(WholeIteration)->Apply(ResolutionsAndThreads);

} // namespace
} // namespace FlipFree

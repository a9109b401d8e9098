// What is made of a surface at the end, or at the next level: its check, its voxels, its
// refinement, its measures.
#include "ExampleRun.h"

#include "Geometry/SelfIntersection.h"
#include "Geometry/SurfaceGap.h"
#include "Guard/SurfaceRefinement.h"
#include "Measures/SurfaceDistance.h"
#include "Measures/SurfaceQuality.h"
#include "Mesh/SurfaceVoxelization.h"

namespace FlipFree
{
namespace
{

const SurfaceOnItsWay& SurfaceOf(benchmark::State& state)
{
  return TheExampleRun().Surfaces.at(static_cast<int>(state.range(0)));
}

void SelfIntersections(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(CountSelfIntersections(surface.Points, surface.Mesh.Triangles));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

void Voxelization(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ImageGeometry& geometry = TheExampleRun().Smooth.Geometry;
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  std::vector<VoxelRun> runs;
  for (auto _ : state)
  {
    runs = VoxelizeSurface(surface.Points, surface.Mesh.Triangles, geometry, parallelFor);
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel", static_cast<double>(CountVoxels(runs)), state);
}

void Refinement(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      RefineSurface(surface.Mesh, surface.Points, true, parallelFor, NeverStop));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

// The surface against itself as it will be after the next step.
void Distances(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const PointList moved = surface.Points + surface.Motion;
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(MeasureSurfaceDistance(surface.Points, surface.Mesh.Triangles, moved,
      surface.Mesh.Triangles, 1, parallelFor));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

void Quality(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(MeasureQuality(surface.Points, surface.Mesh.Faces));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

void MinimumGap(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      MeasureMinimumGap(surface.Points, surface.Mesh.Triangles, parallelFor));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

void Connectivity(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(BuildContourMesh(surface.Mesh.NumberOfPoints(), surface.Mesh.Faces));
  }
  ReportTimePer("vertex", surface.Mesh.NumberOfPoints(), state);
}

BENCHMARK(Connectivity)->Apply(Resolutions);
BENCHMARK(SelfIntersections)->Apply(Resolutions);
BENCHMARK(Voxelization)->Apply(ResolutionsAndThreads);
BENCHMARK(Refinement)->Apply(ResolutionsAndThreads);
BENCHMARK(Distances)->Name("SurfaceDistances")->Apply(ResolutionsAndThreads);
BENCHMARK(Quality)->Name("SurfaceQuality")->Apply(Resolutions);
BENCHMARK(MinimumGap)->Apply(ResolutionsAndThreads);

} // namespace
} // namespace FlipFree

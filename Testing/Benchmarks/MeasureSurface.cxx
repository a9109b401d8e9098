// What is made of a surface at the end, or at the next level: its check, its voxels, its
// refinement.
#include "ExampleRun.h"

#include "SelfIntersection.h"
#include "SurfaceRefinement.h"
#include "SurfaceVoxelisation.h"

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

void Voxelisation(benchmark::State& state)
{
  const SurfaceOnItsWay& surface = SurfaceOf(state);
  const ImageGeometry& geometry = TheExampleRun().Smooth.Geometry;
  const ParallelFor parallelFor = ThreadedFor(state.range(1));
  std::vector<VoxelRun> runs;
  for (auto _ : state)
  {
    runs = VoxeliseSurface(surface.Points, surface.Mesh.Triangles, geometry, parallelFor);
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

BENCHMARK(SelfIntersections)->Apply(Resolutions);
BENCHMARK(Voxelisation)->Apply(ResolutionsAndThreads);
BENCHMARK(Refinement)->Apply(ResolutionsAndThreads);

} // namespace
} // namespace FlipFree

/**
 * One segmentation of the abdomen phantom's liver, from which the benchmarks of kernels take their
 * input: the smoothed image, the model, and the surface on its way at every resolution.
 */
#ifndef ExampleRun_h
#define ExampleRun_h

#include "Deformation/DeformationStep.h"
#include "Deformation/TargetSearch.h"
#include "ExecutionAdapter.h"
#include "Intensity/OrganFeature.h"

#include <benchmark/benchmark.h>

#include <map>
#include <vector>

namespace FlipFree
{

/// The surface after a few iterations at its resolution, when it has neither just been refined nor
/// come to rest, and what the next iteration makes of it.
struct SurfaceOnItsWay
{
  ContourMesh Mesh;
  PointList Points;
  CorrespondenceField Targets; ///< as they are found
  CorrespondenceField Wanted;  ///< without flips, propagated
  PointList Motion;            ///< as it is solved, before the guard
};

struct ExampleRun
{
  FloatImage Gray;   ///< the reachable region, as it is scanned
  FloatImage Smooth; ///< and smoothed
  double Noise = 0;
  SeedSphere Seed;
  std::vector<float> SeedValues;
  IntensityModel Model;
  OrganFeatureSettings FeatureSettings;
  BitMask Foreground; ///< where the feature is above its threshold
  TargetSettings Search;
  DeformationStepSettings Step;
  std::map<int, SurfaceOnItsWay> Surfaces; ///< by vertices along a side: 8 to 128
};

/// Made when it is first asked for, with the settings that vtkFlipFreeSegmentation has by default.
const ExampleRun& TheExampleRun();

/// Serial for one thread, VTK's threads for more. `threads` is a benchmark's argument.
ParallelFor ThreadedFor(std::int64_t threads);

/// Adds the time that one of `items` vertices, voxels or values takes; seconds, printed with
/// prefix.
void ReportTimePer(const char* item, double items, benchmark::State& state);

/// All resolutions, one thread.
inline void Resolutions(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("n")->RangeMultiplier(2)->Range(8, 128)->Unit(benchmark::kMillisecond);
}

/// All resolutions, with one and with two threads, timed by the clock on the wall.
inline void ResolutionsAndThreads(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "n", "threads" })
    ->ArgsProduct({ { 8, 16, 32, 64, 128 }, { 1, 2 } })
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}

/// One and two threads, timed by the clock on the wall.
inline void Threads(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

} // namespace FlipFree

#endif

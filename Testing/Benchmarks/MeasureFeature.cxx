// What is done on voxels: smoothing, the intensity model, leak control.
#include "ExampleRun.h"

#include "Image/AnisotropicDiffusion.h"
#include "Image/BallMorphology.h"
#include "Image/DistanceTransform.h"
#include "Measures/VoxelOverlap.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

void Diffusion(benchmark::State& state, DiffusionEquation equation)
{
  const ExampleRun& run = TheExampleRun();
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  AnisotropicDiffusionSettings settings;
  settings.Equation = equation;
  settings.Contrast = ContrastOfNoise(run.Noise, run.Gray.Geometry, equation);
  std::vector<float> smooth(run.Gray.Voxels.size());
  for (auto _ : state)
  {
    DiffuseAnisotropically(ReaderOf(run.Gray.View()), run.Gray.Geometry, settings, parallelFor,
      NeverStop, smooth.data());
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel and step", static_cast<double>(run.Gray.Voxels.size()) * settings.Iterations,
    state);
}

void MixtureFit(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      FitGaussianMixture(run.SeedValues, run.FeatureSettings.Intensity.Mixture));
  }
  ReportTimePer("voxel", static_cast<double>(run.SeedValues.size()), state);
  state.counters["voxels"] = static_cast<double>(run.SeedValues.size());
}

void ModelFit(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      FitToSeed(run.Smooth.View(), run.Seed, run.Noise, run.FeatureSettings.Intensity));
  }
}

void LookUp(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  std::vector<float> feature(run.Smooth.Voxels.size());
  for (auto _ : state)
  {
    std::transform(run.Smooth.Voxels.begin(), run.Smooth.Voxels.end(), feature.begin(),
      [&run](float gray) { return run.Model(gray); });
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel", static_cast<double>(feature.size()), state);
}

void Distances(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  std::vector<unsigned char> mask(run.Smooth.Voxels.size(), 0);
  run.Foreground.ForEach([&mask](std::size_t voxel) { mask[voxel] = 1; });
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(SquaredDistance(mask, run.Smooth.Geometry, 0, parallelFor, NeverStop));
  }
  ReportTimePer("voxel", static_cast<double>(run.Smooth.Voxels.size()), state);
}

void Opening(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const double radius = run.FeatureSettings.Leaks.OpeningRadius;
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  for (auto _ : state)
  {
    BitMask mask = run.Foreground;
    Erode(mask, radius, parallelFor, NeverStop);
    Dilate(mask, radius, parallelFor, NeverStop);
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel", static_cast<double>(run.Smooth.Voxels.size()), state);
}

void Foreground(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  for (auto _ : state)
  {
    BitMask foreground;
    FindForeground(run.Smooth.View(), run.Model, run.Seed, run.FeatureSettings, parallelFor,
      NeverStop, foreground);
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel", static_cast<double>(run.Smooth.Voxels.size()), state);
}

void Connection(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const std::vector<std::size_t> sources = VoxelsInSphere(run.Smooth.Geometry, run.Seed);
  for (auto _ : state)
  {
    BitMask mask = run.Foreground;
    KeepConnected(mask, sources, NeverStop);
    benchmark::ClobberMemory();
  }
  ReportTimePer("voxel", static_cast<double>(run.Smooth.Voxels.size()), state);
}

void ModelRefit(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const SurfaceOnItsWay& surface = run.Surfaces.at(32);
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  for (auto _ : state)
  {
    IntensityModel model = run.Model;
    RefitToSurface(run.Smooth.View(), surface.Points, surface.Mesh.Triangles, run.Noise,
      run.FeatureSettings.Intensity, parallelFor, NeverStop, model);
    benchmark::ClobberMemory();
  }
}

void Overlap(benchmark::State& state)
{
  const ExampleRun& run = TheExampleRun();
  const ParallelFor parallelFor = ThreadedFor(state.range(0));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(MeasureOverlap(run.Foreground, run.Foreground, parallelFor));
  }
  ReportTimePer("voxel", static_cast<double>(run.Smooth.Voxels.size()), state);
}

BENCHMARK_CAPTURE(Diffusion, Faces, DiffusionEquation::Faces)->Apply(Threads);
BENCHMARK_CAPTURE(Diffusion, Gradient, DiffusionEquation::Gradient)->Apply(Threads);
BENCHMARK_CAPTURE(Diffusion, Curvature, DiffusionEquation::Curvature)->Apply(Threads);
BENCHMARK(MixtureFit)->Unit(benchmark::kMillisecond);
BENCHMARK(ModelFit)->Unit(benchmark::kMillisecond);
BENCHMARK(LookUp)->Unit(benchmark::kMillisecond);
BENCHMARK(Distances)->Apply(Threads);
BENCHMARK(Opening)->Apply(Threads);
BENCHMARK(Foreground)->Apply(Threads);
BENCHMARK(ModelRefit)->Apply(Threads);
BENCHMARK(Overlap)->Apply(Threads);
BENCHMARK(Connection)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace FlipFree

#include "ExampleRun.h"

#include "Deformation/FlipAvoidance.h"
#include "Deformation/OrganSegmentation.h"
#include "Image/AnisotropicDiffusion.h"
#include "Mesh/QuadSphere.h"
#include "PhantomScan.h"

#include <algorithm>
#include <string>

namespace FlipFree
{
namespace
{

constexpr int FirstResolution = 8;
constexpr int Levels = 5;
constexpr int IterationsBefore = 3;

void MakeImages(const PhantomScan& scan, ExampleRun& run)
{
  run.Seed = scan.Seed;
  CropToFloat(ImageView<std::int16_t>{ scan.Voxels.data(), scan.Geometry },
    ReachableExtent(scan.Geometry, run.Seed.Center, OrganReach), SMPFor, run.Gray);
  run.Noise = NoiseStandardDeviation(run.Gray.View(), run.Seed);
  run.Smooth = run.Gray;
  AnisotropicDiffusionSettings diffusion;
  diffusion.Contrast = ContrastOfNoise(run.Noise, run.Gray.Geometry, diffusion.Equation);
  DiffuseAnisotropically(ReaderOf(run.Gray.View()), run.Gray.Geometry, diffusion, SMPFor, NeverStop,
    run.Smooth.Voxels.data());
}

void MakeFeatures(ExampleRun& run)
{
  for (std::size_t voxel : VoxelsInSphere(run.Smooth.Geometry, run.Seed))
  {
    run.SeedValues.push_back(run.Smooth.Voxels[voxel]);
  }
  run.Model = FitToSeed(run.Smooth.View(), run.Seed, run.Noise, run.FeatureSettings.Intensity);
  FindForeground(run.Smooth.View(), run.Model, run.Seed, run.FeatureSettings, SMPFor, NeverStop,
    run.Foreground);
}

void MakeSurfaces(OrganSegmentationSettings settings, ExampleRun& run)
{
  settings.Levels = Levels;
  settings.ReestimateIntensities = false; // the benchmarks have the seed's model
  const QuadSphere sphere = MakeQuadSphere(FirstResolution, run.Seed.Center, run.Seed.Radius,
    QuadSphereSpacing::Equiangular);
  std::map<int, int> iterations;
  SegmentOrgan(
    run.Smooth.View(), run.Noise, run.Seed,
    BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces), sphere.Points, settings,
    SMPFor, [&iterations](double) { return iterations[Levels - 1] < IterationsBefore; },
    [&](const ContourMesh& mesh, const PointList& points, const CorrespondenceField&,
      const IterationRecord& record)
    {
      if (iterations[record.Level]++ < IterationsBefore)
      {
        run.Surfaces[FirstResolution << record.Level] = { mesh, points, {}, {}, {} };
      }
    });
}

// What each stage of the next iteration gets from the one before.
void Prepare(const ExampleRun& run, SurfaceOnItsWay& surface)
{
  TargetReport report;
  surface.Targets = FindTargets(surface.Mesh, surface.Points, run.Foreground, run.Smooth.View(),
    run.Search, SMPFor, report);
  surface.Wanted = surface.Targets;
  AvoidFlips(surface.Mesh, surface.Points, run.Step.FlipThreshold, surface.Wanted);
  DiffuseDisplacements(surface.Mesh, run.Step.Propagation, surface.Wanted);
  surface.Motion = surface.Wanted.Displacements;
  DeformationSolver(surface.Mesh)
    .Solve(surface.Points, surface.Wanted.Displacements, run.Step.Energy, surface.Motion);
}

} // namespace

const ExampleRun& TheExampleRun()
{
  static const ExampleRun made = []
  {
    ExampleRun run;
    const PhantomScan scan = ScanAbdomen({ { 220, 170, 90 } }, { 1.5, 1.5, 3 }, 1, SMPFor);
    const OrganSegmentationSettings settings = OrganSettings(scan);
    run.FeatureSettings = settings.Feature;
    run.Search = settings.Targets;
    run.Step = settings.Step;
    MakeImages(scan, run);
    MakeFeatures(run);
    run.Search.Correspondence.Ramp = run.Model.Ramp;
    MakeSurfaces(settings, run);
    for (auto& [n, surface] : run.Surfaces)
    {
      Prepare(run, surface);
    }
    return run;
  }();
  return made;
}

ParallelFor ThreadedFor(std::int64_t threads)
{
  if (threads == 1)
  {
    return SerialFor;
  }
  vtkSMPTools::Initialize(static_cast<int>(threads));
  return SMPFor;
}

void ReportTimePer(const char* item, double items, benchmark::State& state)
{
  state.counters[std::string("per ") + item] = benchmark::Counter(items,
    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

} // namespace FlipFree

#include "ExampleRun.h"

#include "AbdomenPhantom.h"
#include "AnisotropicDiffusion.h"
#include "FlipAvoidance.h"
#include "OrganSegmentation.h"
#include "QuadSphere.h"

#include <algorithm>
#include <string>

namespace FlipFree
{
namespace
{

constexpr int FirstResolution = 8;
constexpr int Levels = 4;
constexpr int IterationsBefore = 3;
constexpr double Reach = 250;

ImageView<std::int16_t> ScanPhantom(const Phantom& phantom, std::vector<std::int16_t>& voxels)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 220, 170, 90 } };
  geometry.Spacing = { 1.5, 1.5, 3 };
  voxels.resize(geometry.NumberOfVoxels());
  std::vector<std::uint8_t> labels(voxels.size());
  SamplingOptions options;
  options.NoiseDeviation = 12;
  options.NoiseCorrelation = 0.3;
  options.Seed = 1;
  SampleTissues(phantom.Tissues, geometry, options, voxels.data(), labels.data(), SMPFor);
  return { voxels.data(), geometry };
}

void MakeImages(ExampleRun& run)
{
  const Phantom phantom = MakeAbdomenPhantom({ 330, 255, 270 });
  std::vector<std::int16_t> voxels;
  const ImageView<std::int16_t> scan = ScanPhantom(phantom, voxels);
  const auto liver = std::find_if(phantom.Seeds.begin(), phantom.Seeds.end(),
    [](const PhantomSeed& seed)
    { return seed.Label == static_cast<std::uint8_t>(AbdomenLabel::Liver); });
  run.Seed = { GridToPhysical(scan.Geometry, liver->Start.Center), liver->Start.Radius };
  run.Grey = CropToFloat(scan, ReachableExtent(scan.Geometry, run.Seed.Center, Reach), SMPFor);
  run.Noise = NoiseDeviation(run.Grey.View(), run.Seed);
  run.Smooth = run.Grey;
  AnisotropicDiffusionSettings diffusion;
  diffusion.Contrast = ContrastOfNoise(run.Noise, run.Grey.Geometry, diffusion.Equation);
  DiffuseAnisotropically(ReaderOf(run.Grey.View()), run.Grey.Geometry, diffusion, SMPFor, NeverStop,
    run.Smooth.Voxels.data());
}

void MakeFeatures(ExampleRun& run)
{
  run.FeatureSettings.Leaks.OpeningRadius = 6;
  for (std::size_t voxel : VoxelsInSphere(run.Smooth.Geometry, run.Seed))
  {
    run.SeedValues.push_back(run.Smooth.Voxels[voxel]);
  }
  run.Model = FitToSeed(run.Smooth.View(), run.Seed, run.Noise, run.FeatureSettings.Intensity);
  FindForeground(run.Smooth.View(), run.Model, run.Seed, run.FeatureSettings, SMPFor, NeverStop,
    run.Foreground);
}

void MakeSurfaces(ExampleRun& run)
{
  const double voxel = run.Smooth.Geometry.Spacing.maxCoeff();
  CorrespondenceSettings& correspondence = run.Search.Correspondence;
  correspondence.SearchDistance = std::clamp(1.6 * run.Seed.Radius, 15.0, 60.0);
  correspondence.RunLength = 2;
  correspondence.ImageEndDistance = 12;
  correspondence.EdgeWindow = 3;
  correspondence.Ramp = run.Model.Ramp;
  run.Search.MaximumDisplacement = 8 * voxel;

  OrganSegmentationSettings settings;
  settings.Levels = Levels;
  settings.DistanceTolerance = 0.1 * voxel;
  settings.ChangeTolerance = 0.02 * voxel;
  settings.Reestimate = false; // the benchmarks have the seed's model
  settings.Feature = run.FeatureSettings;
  settings.Targets = run.Search;
  settings.Step = run.Step;
  const QuadSphere sphere = MakeQuadSphere(FirstResolution, run.Seed.Center, run.Seed.Radius,
    QuadSphereSpacing::Equiangular);
  std::map<int, int> iterations;
  SegmentOrgan(run.Smooth.View(), run.Noise, run.Seed,
    BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces), sphere.Points, settings,
    SMPFor, NeverStop,
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
  SolveDeformation(surface.Mesh, surface.Points, surface.Wanted.Displacements, run.Step.Energy,
    surface.Motion);
}

} // namespace

const ExampleRun& TheExampleRun()
{
  static const ExampleRun made = []
  {
    ExampleRun run;
    MakeImages(run);
    MakeFeatures(run);
    MakeSurfaces(run);
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

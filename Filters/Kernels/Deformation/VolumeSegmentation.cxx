#include "Deformation/VolumeSegmentation.h"

#include "Deformation/SegmentationWarnings.h"
#include "Stopwatch.h"

#include <memory>
#include <stdexcept>

namespace FlipFree
{
namespace
{

double NoiseOf(const GrayVolume& volume, const SeedSphere& seed)
{
  const VoxelBox box = BoxAround(volume.Geometry, seed.Center, seed.Radius);
  FloatImage region;
  region.Geometry = CropGeometry(volume.Geometry, box);
  region.Voxels.resize(region.Geometry.NumberOfVoxels());
  for (int k = 0; k < box.Size(2); ++k)
  {
    for (int j = 0; j < box.Size(1); ++j)
    {
      volume.Read(box.Begin[0], box.End[0], box.Begin[1] + j, box.Begin[2] + k,
        region.Voxels.data() + region.Geometry.Offset(0, j, k));
    }
  }
  return NoiseStandardDeviation(region.View(), seed);
}

VoxelReader PartOf(const VoxelReader& read, const VoxelBox& box)
{
  return [read, first = box.Begin](int begin, int end, int j, int k, float* to)
  { read(first[0] + begin, first[0] + end, first[1] + j, first[2] + k, to); };
}

void RequireCertified(const OrganSurface& organ)
{
  if (organ.SelfIntersections > 0)
  {
    throw std::logic_error("the surface intersects itself in " +
      std::to_string(organ.SelfIntersections) +
      " pairs of faces although every step was certified, which should be impossible; please "
      "report it with the image and the parameters");
  }
}

} // namespace

VolumeSegmentation SegmentVolume(const GrayVolume& volume, const std::string& name,
  const SeedSphere& seed, const DeformableSurface* start,
  const VolumeSegmentationSettings& settings, const Threading& threading, const Monitor& monitor,
  const IterationObserver& observer)
{
  const OrganSegmentationSettings& method = settings.Method;
  const ImageGeometry& geometry = volume.Geometry;
  RequireSeed(geometry, seed, name);
  const Eigen::Vector3d startCenter = seed.Center + settings.StartCenterOffset;
  const DeformableSurface first = start ? *start
                                        : MakeStartSphere(method.Schedule.FirstResolution(),
                                            startCenter, settings.StartScale * seed.Radius);

  Stopwatch watch;
  const VoxelBox box = BoxAround(geometry, seed.Center, ReachOf(method.Smoothing, seed.Radius));
  volume.RequireFinite(box);
  const double noise = NoiseOf(volume, seed);
  const ImageGeometry region = CropGeometry(geometry, box);
  AnisotropicDiffusionSettings diffusion = DiffusionOf(method.Smoothing, noise);
  diffusion.Threads = threading.Number;
  auto smooth =
    std::make_unique<SmoothRegion>(PartOf(volume.Read, box), region, diffusion, threading.For);
  const double before = watch.Lap();

  VolumeSegmentation result;
  result.Organ = SegmentOrgan(*smooth, noise, seed, first.Mesh, first.Points, method, threading.For,
    monitor, observer);
  smooth.reset(); // the label map takes its place
  const OrganSurface& organ = result.Organ;
  result.StageSeconds[0] = before + organ.SmoothingSeconds;
  result.StageSeconds[1] = organ.FeatureSeconds;
  result.StageSeconds[2] = watch.Lap() - organ.SmoothingSeconds - organ.FeatureSeconds;
  if (organ.Reason == StopReason::Aborted)
  {
    return result;
  }
  if (method.Step.Guard)
  {
    RequireCertified(organ);
  }
  const bool startsAtSeed = !start && settings.StartScale == 1 && startCenter == seed.Center;
  result.Warnings = WarningsOf(organ, region, geometry, seed, method, startsAtSeed);
  result.Voxels = VoxelizeSurface(organ.Points, organ.Mesh.Triangles, geometry, threading.For);
  result.StageSeconds[3] = watch.Lap();
  return result;
}

} // namespace FlipFree

#include "Deformation/VolumeSegmentation.h"

#include "Deformation/SegmentationWarnings.h"
#include "Stopwatch.h"

#include <memory>
#include <utility>
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

VolumeSegmenter::VolumeSegmenter(GrayVolume volume, std::string name, const SeedSphere& seed,
  const DeformableSurface* start, const VolumeSegmentationSettings& settings, Threading threading)
  : Volume(std::move(volume))
  , Name(std::move(name))
  , Seed(seed)
  , Settings(settings)
  , Threads(std::move(threading))
{
  RequireSeed(this->Volume.Geometry, seed, this->Name);
  const Eigen::Vector3d center = seed.Center + settings.StartCenterOffset;
  this->StartsAtSeed = !start && settings.StartScale == 1 && center == seed.Center;
  this->Start = start ? *start
                      : MakeStartSphere(settings.Method.Schedule.FirstResolution(), center,
                          settings.StartScale * seed.Radius);
}

void VolumeSegmenter::Prepare()
{
  const SmoothingSettings& smoothing = this->Settings.Method.Smoothing;
  const VoxelBox box = BoxAround(
    this->Volume.Geometry, this->Seed.Center, ReachOf(smoothing, this->Seed.Radius));
  this->Volume.RequireFinite(box);
  this->Noise = NoiseOf(this->Volume, this->Seed);
  this->Region = CropGeometry(this->Volume.Geometry, box);
  AnisotropicDiffusionSettings diffusion = DiffusionOf(smoothing, this->Noise);
  diffusion.Threads = this->Threads.Number;
  this->Smooth = std::make_unique<SmoothRegion>(PartOf(this->Volume.Read, box), this->Region,
    diffusion, this->Threads.For);
  this->Organ = std::make_unique<OrganSegmenter>(*this->Smooth, this->Noise, this->Seed,
    this->Start, this->Settings.Method, this->Threads.For);
}

void VolumeSegmenter::Release()
{
  this->Organ.reset();
  this->Smooth.reset();
}

VolumeSegmentation VolumeSegmenter::Segment(const ConstraintList& constraints,
  const Monitor& monitor, const IterationObserver& observer)
{
  const OrganSegmentationSettings& method = this->Settings.Method;
  const ImageGeometry& geometry = this->Volume.Geometry;
  RequireConstraints(geometry, this->Seed, constraints, this->Name);
  Stopwatch watch;
  if (!this->Organ)
  {
    this->Prepare();
  }
  const double before = watch.Lap();
  VolumeSegmentation result;
  result.Organ = this->Organ->Segment(constraints, monitor, observer);
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
  result.Warnings =
    WarningsOf(organ, this->Region, geometry, this->Seed, method, this->StartsAtSeed);
  result.Voxels =
    VoxelizeSurface(organ.Points, organ.Mesh.Triangles, geometry, this->Threads.For);
  result.StageSeconds[3] = watch.Lap();
  return result;
}

VolumeSegmentation SegmentVolume(const GrayVolume& volume, const std::string& name,
  const SeedSphere& seed, const DeformableSurface* start,
  const VolumeSegmentationSettings& settings, const Threading& threading, const Monitor& monitor,
  const IterationObserver& observer)
{
  return VolumeSegmenter(volume, name, seed, start, settings, threading)
    .Segment({}, monitor, observer);
}

} // namespace FlipFree

#include "Deformation/VolumeSegmentation.h"

#include "Deformation/SegmentationWarnings.h"
#include "Error.h"
#include "Geometry/DistanceQuery.h"
#include "Image/BoxReading.h"
#include "Image/NoData.h"
#include "Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace FlipFree
{
namespace
{

// An outside point nearer to the center of the start sphere than this many radii shrinks it to this
// part of the point's distance.
constexpr double NearStart = 1.05;
constexpr double ShrinkTo = 0.9;

// In millimeters; the surface may bulge that far around a constraint.
constexpr double MarginOfPoint = 30;

VoxelReader PartOf(const VoxelReader& read, const VoxelBox& box)
{
  return [read, first = box.Begin](int begin, int end, int j, int k, float* to)
  { read(first[0] + begin, first[0] + end, first[1] + j, first[2] + k, to); };
}

DeformableSurface SphereWithin(const DeformableSurface& sphere, const SeedSphere& ball,
  const ConstraintList& constraints)
{
  double scale = 1;
  for (const PointConstraint& constraint : constraints)
  {
    const double away = (constraint.Point - ball.Center).norm();
    if (constraint.Kind == ConstraintKind::Outside && away < NearStart * ball.Radius)
    {
      scale = std::min(scale, ShrinkTo * away / ball.Radius);
    }
  }
  DeformableSurface start = sphere;
  if (scale < 1)
  {
    const Eigen::RowVector3d center = ball.Center.transpose();
    start.Points = (scale * (sphere.Points.rowwise() - center)).rowwise() + center;
  }
  return start;
}

VolumeSegmentationSettings SettingsFrom(const DeformableSurface* start,
  VolumeSegmentationSettings settings)
{
  if (start)
  {
    settings.Method.Schedule = settings.Method.Schedule.From(start->Mesh.NumberOfPoints());
  }
  return settings;
}

void RequireGuard(const ConstraintList& constraints, bool guard)
{
  if (!constraints.empty() && !guard)
  {
    throw Error(ErrorCode::OutOfRange,
      NameOf(constraints.front()) +
        " can only be obeyed under the guard; switch {Guard} on, or remove the corrections");
  }
}

// The distances of the vertices from the surface of the first run; empty without one.
Eigen::VectorXd ShiftsOf(const OrganSurface& organ)
{
  const DeformableSurface& first = organ.First;
  return first.Points.rows() == 0
    ? Eigen::VectorXd()
    : DistanceQuery(first.Points, first.Mesh.Triangles).DistancesOf(organ.Points);
}

// Whether a warning says that the seed is not within the organ, as the parts that are asked about
// presuppose.
bool IsSeedDoubtful(const OrganSurface& organ, const Implausibility& finding)
{
  return organ.Reason == StopReason::NoBoundaryFound ||
    finding.Reason == ImplausibilityReason::NoBoundary ||
    finding.Reason == ImplausibilityReason::ImageBoundary;
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
  , Settings(SettingsFrom(start, settings))
  , Threads(std::move(threading))
  , Core(seed)
{
  RequireSeed(this->Volume.Geometry, seed, this->Name);
  this->IsSphere = start == nullptr;
  this->StartsAtSeed = this->IsSphere && settings.StartScale == 1 &&
    settings.StartCenterOffset == Eigen::Vector3d::Zero();
  if (start)
  {
    this->Start = *start;
  }
  else
  {
    this->StartAtCore();
  }
}

void VolumeSegmenter::StartAtCore()
{
  this->StartBall = { this->Core.Center + this->Settings.StartCenterOffset,
    this->Settings.StartScale * this->Core.Radius };
  this->Start = MakeStartSphere(this->Settings.Method.Schedule.FirstResolution(),
    this->StartBall.Center, this->StartBall.Radius);
}

void VolumeSegmenter::SetForeground(std::shared_ptr<const BitMask> mask, std::string name)
{
  if (mask && mask->GetGeometry().Dimensions != this->Volume.Geometry.Dimensions)
  {
    throw std::logic_error("a foreground on another grid than the volume's");
  }
  this->Release();
  this->Given = std::move(mask);
  this->GivenName = std::move(name);
}

// What is smoothed, in which the surface stays: as far as the reach, and around the constraints and
// the mask.
VoxelBox VolumeSegmenter::RegionOf(const ConstraintList& constraints) const
{
  const ImageGeometry& geometry = this->Volume.Geometry;
  const double reach = ReachOf(this->Settings.Method.Smoothing, this->Seed.Radius);
  VoxelBox box = BoxAround(geometry, this->Seed.Center, reach);
  for (const PointConstraint& constraint : constraints)
  {
    box = box.Joined(
      BoxAround(geometry, constraint.Point, std::max(MarginOfPoint, 2 * constraint.Radius)));
  }
  if (!this->Given)
  {
    return box;
  }
  const VoxelBox mask = this->Given->Bounds();
  return mask.IsEmpty() ? box : box.Joined(mask.Widened({ { 2, 2, 2 } }, WholeBox(geometry)));
}

void VolumeSegmenter::PrepareBox(const VoxelBox& box)
{
  const SmoothingSettings& smoothing = this->Settings.Method.Smoothing;
  this->Release();
  this->Box = box;
  this->LookAtSeed();
  this->Region = CropGeometry(this->Volume.Geometry, box);
  AnisotropicDiffusionSettings diffusion = DiffusionOf(smoothing, this->Noise);
  diffusion.Threads = this->Threads.Number;
  this->Smooth = std::make_unique<SmoothRegion>(PartOf(this->Volume.Read, box), this->Region,
    diffusion, this->Threads.For, this->Volume.IsComplete);
  this->Organ = std::make_unique<OrganSegmenter>(*this->Smooth, this->Noise, this->Core,
    this->Start, this->Settings.Method, this->Threads.For);
  if (this->Given)
  {
    BitMask mask = this->Given->Cropped(box);
    if (this->Smooth->GetNoData().HasGrid())
    {
      mask.Remove(this->Smooth->GetNoData());
    }
    this->Organ->SetForeground(std::move(mask));
  }
}

void VolumeSegmenter::LookAtSeed()
{
  const ImageGeometry& geometry = this->Volume.Geometry;
  const FloatImage around = ReadBox(this->Volume.Read, geometry,
    BoxAround(geometry, this->Seed.Center, this->Seed.Radius), SerialFor);
  this->Noise = NoiseStandardDeviation(around.View(), this->Seed);
  this->Core = this->Settings.Method.Feature.Carving && !this->Given
    ? UniformSphere(around.View(), this->Seed)
    : this->Seed;
  this->MixedSeed = this->Given
    ? std::string()
    : WarningOfMixedSeed(ScatterOverInnerHalf(around.View(), this->Seed), this->Seed, this->Core);
  if (this->IsSphere)
  {
    this->StartAtCore();
  }
}

void VolumeSegmenter::RequireDataAtSeeds(const ConstraintList& constraints) const
{
  if (this->Given)
  {
    RequireData(this->Volume.Read, this->Volume.Geometry, this->Seed,
      "the largest sphere in " + this->GivenName, "remove such voxels from them");
  }
  else
  {
    RequireData(this->Volume.Read, this->Volume.Geometry, this->Seed);
  }
  RequireData(this->Volume.Read, this->Volume.Geometry, constraints);
}

void VolumeSegmenter::Release()
{
  this->Organ.reset();
  this->Smooth.reset();
}

void VolumeSegmenter::RequireProper(const ConstraintList& constraints) const
{
  RequireConstraints(this->Volume.Geometry, this->Seed, constraints, this->Name, this->GivenName);
  if (!this->Given)
  {
    RequireReach(this->Settings.Method.Smoothing, this->Seed.Radius);
  }
  RequireGuard(constraints, this->Settings.Method.Step.Guard);
  this->RequireDataAtSeeds(constraints);
}

OrganSegmenter& VolumeSegmenter::Prepare(const ConstraintList& constraints)
{
  this->RequireProper(constraints);
  const VoxelBox box = this->RegionOf(constraints);
  if (!this->Organ || !(box == this->Box))
  {
    this->PrepareBox(box);
  }
  return *this->Organ;
}

DeformableSurface VolumeSegmenter::StartWithin(const ConstraintList& constraints) const
{
  return this->IsSphere ? SphereWithin(this->Start, this->StartBall, constraints) : this->Start;
}

VolumeSegmentation VolumeSegmenter::Segment(const ConstraintList& constraints,
  const Monitor& monitor, const IterationObserver& observer)
{
  Stopwatch watch;
  OrganSegmenter& segmenter = this->Prepare(constraints);
  const double before = watch.Lap();
  VolumeSegmentation result;
  const DeformableSurface start = this->StartWithin(constraints);
  result.Organ = segmenter.FindSurface(constraints, &start, monitor, observer);
  const OrganSurface& organ = result.Organ;
  result.StageSeconds[0] = before + organ.SmoothingSeconds;
  result.StageSeconds[1] = organ.FeatureSeconds;
  result.StageSeconds[2] = watch.Lap() - organ.SmoothingSeconds - organ.FeatureSeconds;
  if (organ.Reason == StopReason::Aborted)
  {
    this->Release(); // it may be half smoothed
    return result;
  }
  this->Complete(constraints, result);
  result.StageSeconds[3] = watch.Lap();
  return result;
}

std::optional<std::vector<VoxelRun>> VolumeSegmenter::Preview(const ConstraintList& constraints,
  const PointConstraint& next, const Monitor& monitor)
{
  ConstraintList all = constraints;
  all.push_back(next);
  this->RequireProper(all);
  if (!this->Organ || !(this->RegionOf(all) == this->Box))
  {
    return std::nullopt;
  }
  const std::optional<BitMask> changed = this->Organ->PreviewForeground(constraints, next, monitor);
  if (!changed)
  {
    return std::nullopt;
  }
  std::vector<VoxelRun> runs;
  const std::array<int, 3>& first = this->Box.Begin;
  changed->ForEachRun(0, this->Region.Dimensions[2],
    [&](int begin, int end, int j, int k) {
      runs.push_back({ first[1] + j, first[2] + k, first[0] + begin, first[0] + end });
    });
  return runs;
}

void VolumeSegmenter::Complete(const ConstraintList& constraints, VolumeSegmentation& result) const
{
  const OrganSegmentationSettings& method = this->Settings.Method;
  const ImageGeometry& geometry = this->Volume.Geometry;
  const OrganSurface& organ = result.Organ;
  if (method.Step.Guard)
  {
    RequireCertified(organ);
  }
  // The first run and the consensus know of no constraints, so of what these moved they say
  // nothing. The sphere counts as it is given, which ranks results from too large ones better, too.
  const bool isFree = constraints.empty();
  result.Confidence = JudgeSurface(this->Volume.Read, geometry, organ.Mesh, organ.Points,
    this->Seed, isFree ? ShiftsOf(organ) : Eigen::VectorXd(), isFree ? organ.Carving.Unanimity : 1,
    this->Threads.For);
  const Implausibility finding = CheckPlausibility(organ, this->Region, geometry, this->Core.Radius,
    method, this->StartsAtSeed && !this->Given && organ.Reason != StopReason::NoBoundaryFound);
  // Where its core was used, the result is as sure as any.
  const bool isCoreUsed = this->Core.Radius < this->Seed.Radius;
  const bool isMixed = !this->MixedSeed.empty() && !isCoreUsed;
  if (isMixed)
  {
    result.Confidence.OfSurface *= ConfidenceLeftByMixedSeed;
  }
  result.Warnings = WarningsOf(organ, finding, geometry, this->Seed, method);
  for (const std::string& warning :
    { this->MixedSeed, WarningOfNoData(organ.Points, this->Smooth->GetNoData()) })
  {
    if (!warning.empty())
    {
      result.Warnings.push_back(warning);
    }
  }
  result.Voxels = VoxelizeSurface(organ.Points, organ.Mesh.Triangles, geometry, this->Threads.For);
  if (!isMixed && !IsSeedDoubtful(organ, finding))
  {
    result.Questions = QuestionsOf(organ.Carving.Doubts, constraints, result.Voxels, geometry);
  }
  const std::size_t harmless = isCoreUsed && !this->MixedSeed.empty() ? 1 : 0;
  if (result.Warnings.size() > harmless || !isFree)
  {
    return; // more is wrong than a part
  }
  const double volume = static_cast<double>(CountVoxels(result.Voxels)) * geometry.VoxelVolume();
  const std::string doubt =
    WarningOfDoubt(result.Confidence.OfSurface, result.Questions, volume, method);
  if (!doubt.empty())
  {
    result.Warnings.push_back(doubt);
  }
}

} // namespace FlipFree

#include "Deformation/OrganSegmentation.h"

#include "Geometry/SelfIntersection.h"
#include "Guard/SurfaceRefinement.h"
#include "Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace FlipFree
{
namespace
{

constexpr std::size_t ChangeSpan = 5;
// A surface that still finds new parts of the boundary is not at rest, though its mean distance to
// what it has found may grow: by this part of its vertices.
constexpr double Growth = 0.01;
// What is smoothed before anything is known of the organ, in seed radii around the seed's center,
// and by how much of its size it grows where the organ goes on.
constexpr double FirstReach = 3;
constexpr double GrowthOfBox = 0.25;

// Widens a box until its rows begin with a whole word of a mask.
void BeginWithWord(VoxelBox& box)
{
  box.Begin[0] -= box.Begin[0] % BitMask::BitsOfWord;
}

class Run
{
public:
  Run(const ImageView<float>& smooth, SmoothRegion* region, double noise, const SeedSphere& seed,
    const OrganSegmentationSettings& settings, const ParallelFor& parallelFor,
    const Monitor& monitor, const IterationObserver& observer, OrganSurface& surface)
    : Smooth(smooth)
    , Region(region)
    , Noise(noise)
    , Seed(seed)
    , Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Observe(observer)
    , Surface(surface)
  {
  }

  void Execute()
  {
    if (!this->MakeAroundSeed())
    {
      this->Surface.Reason = StopReason::Aborted;
      return;
    }
    Stopwatch watch;
    const double smoothing = this->Surface.SmoothingSeconds;
    this->Model =
      FitToSeed(this->Smooth, this->Seed, this->Noise, this->Settings.Feature.Intensity);
    this->UpdateForeground([this](double) { return this->Proceed(0, 0); });
    if (!this->Stopped)
    {
      RequireContrast(this->Foreground);
    }
    this->Surface.FeatureSeconds += watch.Lap() - (this->Surface.SmoothingSeconds - smoothing);
    for (int level = 0; level < this->Settings.Levels; ++level)
    {
      if (level > 0 && !this->NextLevel())
      {
        return;
      }
      this->IterateLevel(level);
      if (this->Stopped)
      {
        this->Surface.Reason = StopReason::Aborted;
        return;
      }
    }
  }

private:
  bool Proceed(int level, double partOfLevel)
  {
    this->Stopped = this->Stopped || !this->Ask((level + partOfLevel) / this->Settings.Levels);
    return !this->Stopped;
  }

  // Makes the smoothed image in a box, cut off where the image ends, and lets it begin with a whole
  // word of a mask.
  bool Make(VoxelBox box, const Monitor& proceed)
  {
    Stopwatch watch;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.Begin[axis] = std::max(0, box.Begin[axis]);
      box.End[axis] = std::min(this->Smooth.Geometry.Dimensions[axis], box.End[axis]);
    }
    BeginWithWord(box);
    const bool made = this->Region->Make(box, proceed);
    this->Surface.SmoothingSeconds += watch.Lap();
    return made;
  }

  bool MakeAroundSeed()
  {
    if (!this->Region)
    {
      return true;
    }
    const Monitor proceed = [this](double) { return this->Proceed(0, 0); };
    if (!this->Settings.Feature.ControlLeaks)
    {
      return this->Make({ { { 0, 0, 0 } }, this->Smooth.Geometry.Dimensions }, proceed);
    }
    return this->Make(this->BoxAround(this->Seed.Center.transpose(), FirstReach * this->Seed.Radius,
                        ForegroundMargin(this->Smooth.Geometry, this->Settings.Feature.Leaks)),
      proceed);
  }

  // All within millimeters of the points, and some voxels more.
  VoxelBox BoxAround(const PointList& points, double reach, const std::array<int, 3>& margin) const
  {
    const ImageGeometry& geometry = this->Smooth.Geometry;
    const Eigen::Vector3d voxels = geometry.IndexReach(reach);
    VoxelBox box{ geometry.Dimensions, { { 0, 0, 0 } } };
    for (Eigen::Index point = 0; point < points.rows(); ++point)
    {
      const Eigen::Vector3d index = geometry.ToIndex(points.row(point).transpose());
      for (int axis = 0; axis < 3; ++axis)
      {
        const double last = geometry.Dimensions[axis];
        const double begin = std::floor(index[axis] - voxels[axis]) - margin[axis];
        const double end = std::ceil(index[axis] + voxels[axis]) + margin[axis] + 1;
        box.Begin[axis] = std::min(box.Begin[axis], static_cast<int>(std::clamp(begin, 0.0, last)));
        box.End[axis] = std::max(box.End[axis], static_cast<int>(std::clamp(end, 0.0, last)));
      }
    }
    return box;
  }

  // How far from the sides of what has been made the foreground must stay, in voxels: for its own
  // sake, and for the gray values that the search reads around its rim.
  std::array<int, 3> Margin() const
  {
    const ImageGeometry& geometry = this->Smooth.Geometry;
    std::array<int, 3> margin = ForegroundMargin(geometry, this->Settings.Feature.Leaks);
    const Eigen::Vector3d edges = geometry.IndexReach(
      2 * this->Settings.Targets.Correspondence.EdgeWindow + geometry.Spacing.minCoeff());
    for (int axis = 0; axis < 3; ++axis)
    {
      margin[axis] = std::max(margin[axis], static_cast<int>(std::ceil(edges[axis])) + 2);
    }
    return margin;
  }

  // The box that was searched, and more of it on the sides that the foreground has come near.
  VoxelBox Grown(const VoxelBox& searched, const VoxelBox& bounds) const
  {
    const std::array<int, 3> margin = this->Margin();
    VoxelBox box = searched;
    for (int axis = 0; axis < 3 && !bounds.IsEmpty(); ++axis)
    {
      const int size = this->Smooth.Geometry.Dimensions[axis];
      const int step = std::max(margin[axis], static_cast<int>(GrowthOfBox * searched.Size(axis)));
      if (searched.Begin[axis] > 0 && bounds.Begin[axis] - margin[axis] < searched.Begin[axis])
      {
        box.Begin[axis] = std::max(0, searched.Begin[axis] - step);
      }
      if (searched.End[axis] < size && bounds.End[axis] + margin[axis] > searched.End[axis])
      {
        box.End[axis] = std::min(size, searched.End[axis] + step);
      }
    }
    BeginWithWord(box);
    return box;
  }

  // Where the foreground is looked for first: of what has been made, where it was before, and the
  // seed, with a little more than the margin that it must keep.
  VoxelBox FirstSearched() const
  {
    const VoxelBox made = this->Region->GetMade();
    if (this->Bounds.IsEmpty())
    {
      return made;
    }
    std::array<int, 3> margin = this->Margin();
    const Extent seed =
      ReachableExtent(this->Smooth.Geometry, this->Seed.Center, this->Seed.Radius);
    VoxelBox box = this->Bounds;
    for (int axis = 0; axis < 3; ++axis)
    {
      margin[axis] += margin[axis] / 2;
      box.Begin[axis] = std::min(seed[2 * axis], box.Begin[axis]);
      box.End[axis] = std::max(seed[2 * axis + 1] + 1, box.End[axis]);
    }
    box = box.Widened(margin, made);
    BeginWithWord(box);
    return box;
  }

  // The search asks of the feature only where it is above its threshold.
  void UpdateForeground(const Monitor& proceed)
  {
    if (!this->Region || !this->Settings.Feature.ControlLeaks)
    {
      FindForeground(this->Smooth, this->Model, this->Seed, this->Settings.Feature, this->Parallel,
        proceed, this->Foreground);
      return;
    }
    VoxelBox searched = this->FirstSearched();
    do
    {
      if (!FindForegroundInBox(this->Smooth, searched, this->Model, this->Seed,
            this->Settings.Feature.Leaks, this->Parallel, proceed, this->Foreground))
      {
        return;
      }
      this->Bounds = this->Foreground.Bounds();
      const VoxelBox grown = this->Grown(searched, this->Bounds);
      if (searched.Holds(grown))
      {
        return;
      }
      searched = grown;
      this->Foreground = BitMask(); // what follows has need of the memory
      if (!this->Make(grown, proceed))
      {
        return;
      }
    } while (true);
  }

  bool NextLevel()
  {
    const Monitor proceed = [this](double) { return this->Proceed(this->Level, 1); };
    RefinedSurface refined = RefineSurface(this->Surface.Mesh, this->Surface.Points,
      this->Settings.Guard, this->Parallel, proceed);
    if (!refined.Embedded)
    {
      this->Surface.Reason = this->Stopped ? StopReason::Aborted : StopReason::NotRefined;
      return false;
    }
    this->Surface.Mesh = std::move(refined.Mesh);
    this->Surface.Points = std::move(refined.Points);
    if (this->Settings.ReestimateIntensities)
    {
      Stopwatch watch;
      const double smoothing = this->Surface.SmoothingSeconds;
      this->Foreground = BitMask(); // what follows has need of the memory
      if (this->Region &&
        !this->Make(this->BoxAround(this->Surface.Points, this->Settings.Feature.Intensity.ShellEnd,
                      { { 2, 2, 2 } }),
          proceed))
      {
        this->Surface.Reason = StopReason::Aborted;
        return false;
      }
      RefitToSurface(this->Smooth, this->Surface.Points, this->Surface.Mesh.Triangles, this->Noise,
        this->Settings.Feature.Intensity, this->Parallel, proceed, this->Model);
      this->UpdateForeground(proceed);
      this->Surface.FeatureSeconds += watch.Lap() - (this->Surface.SmoothingSeconds - smoothing);
    }
    return true;
  }

  void IterateLevel(int level)
  {
    this->Level = level;
    std::unique_ptr<EmbeddingGuard> guard;
    if (this->Settings.Guard)
    {
      guard = std::make_unique<EmbeddingGuard>(this->Surface.Mesh);
    }
    DeformationSolver solver(this->Surface.Mesh);
    const bool finest = level + 1 == this->Settings.Levels;
    std::vector<TargetReport> reports;
    this->Surface.Reason = StopReason::IterationLimit;
    for (int iteration = 0; iteration < this->Settings.MaximumIterations; ++iteration)
    {
      const double part = static_cast<double>(iteration) / this->Settings.MaximumIterations;
      if (!this->Proceed(level, part))
      {
        return;
      }
      reports.push_back(this->IterateOnce(solver, guard.get(), finest, part));
      if (this->IsLevelDone(reports))
      {
        return;
      }
    }
  }

  bool IsLevelDone(const std::vector<TargetReport>& reports)
  {
    const TargetReport& now = reports.back();
    if (now.Matched == 0)
    {
      this->Surface.Reason = StopReason::NoBoundaryFound;
      return true;
    }
    if (now.MeanDistance < this->Settings.DistanceTolerance)
    {
      this->Surface.Reason = StopReason::DistanceBelowTolerance;
      return true;
    }
    if (this->Settings.ChangeTolerance < 0 || reports.size() <= ChangeSpan)
    {
      return false;
    }
    const TargetReport& before = reports[reports.size() - 1 - ChangeSpan];
    const bool grows = now.Matched - before.Matched > Growth * this->Surface.Mesh.NumberOfPoints();
    if (!grows && before.MeanDistance - now.MeanDistance < this->Settings.ChangeTolerance)
    {
      this->Surface.Reason = StopReason::AtRest;
      return true;
    }
    return false;
  }

  TargetReport IterateOnce(DeformationSolver& solver, const EmbeddingGuard* guard, bool finest,
    double part)
  {
    IterationRecord record;
    record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
    record.Level = this->Level;
    record.Vertices = this->Surface.Mesh.NumberOfPoints();

    TargetSettings targets = this->Settings.Targets;
    targets.Correspondence.Ramp = this->Model.Ramp;
    if (!finest)
    {
      targets.Correspondence.EdgeWindow = 0;
    }
    Stopwatch watch;
    this->Surface.Field = FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground,
      this->Smooth, targets, this->Parallel, record.Targets);
    record.SearchSeconds = watch.Lap();

    const Monitor proceed = [this, part](double) { return this->Proceed(this->Level, part); };
    record.Step = DeformOnce(solver, guard, this->Settings.Step, this->Parallel, proceed,
      this->Surface.Field, this->Surface.Points);
    this->Surface.Iterations.push_back(record);
    this->Observe(this->Surface.Mesh, this->Surface.Points, this->Surface.Field, record);
    return record.Targets;
  }

  const ImageView<float> Smooth;
  SmoothRegion* Region; // null where all of the image has been smoothed before
  double Noise;
  const SeedSphere& Seed;
  const OrganSegmentationSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  const IterationObserver& Observe;
  OrganSurface& Surface;

  IntensityModel Model;
  BitMask Foreground;
  VoxelBox Bounds; // of the foreground; empty where it is not known
  int Level = 0;
  bool Stopped = false;
};

OrganSurface SegmentIn(const ImageView<float>& smooth, SmoothRegion* region, double noise,
  const SeedSphere& seed, const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer)
{
  OrganSurface surface;
  surface.Mesh = startMesh;
  surface.Points = startPoints;
  Run(smooth, region, noise, seed, settings, parallelFor, monitor, observer, surface).Execute();
  if (surface.Reason != StopReason::Aborted)
  {
    surface.SelfIntersections = CountSelfIntersections(surface.Points, surface.Mesh.Triangles);
  }
  return surface;
}

} // namespace

OrganSurface SegmentOrgan(SmoothRegion& region, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer)
{
  return SegmentIn(region.View(), &region, noise, seed, startMesh, startPoints, settings,
    parallelFor, monitor, observer);
}

OrganSurface SegmentOrgan(const ImageView<float>& smooth, double noise, const SeedSphere& seed,
  const ContourMesh& startMesh, const PointList& startPoints,
  const OrganSegmentationSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor,
  const IterationObserver& observer)
{
  return SegmentIn(smooth, nullptr, noise, seed, startMesh, startPoints, settings, parallelFor,
    monitor, observer);
}

} // namespace FlipFree

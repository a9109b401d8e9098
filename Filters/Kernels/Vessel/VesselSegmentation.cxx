#include "Vessel/VesselSegmentation.h"

#include "Deformation/ConstraintEnforcer.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Guard/SurfaceRefinement.h"
#include "Image/VoxelTraversal.h"
#include "Mesh/CellSurface.h"
#include "MessageText.h"
#include "Stopwatch.h"
#include "Vessel/OutlineCorrection.h"
#include "Vessel/TubeOccupancy.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

namespace FlipFree
{
namespace
{

constexpr double RoundedEdge = 0.7; // mm: the outline's edge in the image of depths, for snapping

// The voxels of a cubic grid around all sections.
ImageGeometry GridAround(const VesselTree& tree, double edge)
{
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const VesselBranch& branch : tree.Branches)
  {
    for (std::size_t section = 0; section < branch.Sections.Frames.size(); ++section)
    {
      const double radius =
        branch.Sections.Radii.row(static_cast<Eigen::Index>(section)).maxCoeff() + 2 * edge + 2;
      const Eigen::Array3d center = branch.Sections.Frames[section].Origin.array();
      low = low.min(center - radius);
      high = high.max(center + radius);
    }
  }
  ImageGeometry grid;
  grid.Spacing.setConstant(edge);
  grid.Origin = low.matrix();
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Dimensions[axis] = static_cast<int>(std::ceil((high[axis] - low[axis]) / edge)) + 1;
  }
  return grid;
}

FloatImage DepthOnGrid(const VesselTree& tree, double edge, double margin)
{
  FloatImage depth;
  depth.Geometry = GridAround(tree, edge);
  depth.Voxels.assign(depth.Geometry.NumberOfVoxels(), static_cast<float>(-margin));
  for (const VesselBranch& branch : tree.Branches)
  {
    MergeTubeDepth(branch.Sections, margin, branch.Parent >= 0, false, depth);
  }
  return depth;
}

double SmallestRadius(const VesselTree& tree)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const VesselBranch& branch : tree.Branches)
  {
    Eigen::VectorXd mean = branch.Sections.MeanRadii();
    std::nth_element(mean.data(), mean.data() + mean.size() / 4, mean.data() + mean.size());
    smallest = std::min(smallest, mean[mean.size() / 4]);
  }
  return smallest;
}

// The cells that a line passes, each sharing a side with the next.
void InsertLine(const PointList& line, BitMask& cells)
{
  const VoxelGrid grid(cells.GetGeometry());
  for (Eigen::Index point = 0; point + 1 < line.rows(); ++point)
  {
    const Eigen::Vector3d step = (line.row(point + 1) - line.row(point)).transpose();
    VoxelTraversal walk(grid, line.row(point).transpose(), step.normalized());
    for (; walk.GetEntry() <= step.norm(); walk.Advance())
    {
      if (walk.IsInside())
      {
        const auto& voxel = walk.GetVoxel();
        cells.Insert(voxel[0], voxel[1], voxel[2]);
      }
    }
  }
}

// Calls `body` with the indices of the cells that hold a point or touch it.
template <typename Body>
void ForEachCellAt(const ImageGeometry& grid, const Eigen::Vector3d& point, const Body& body)
{
  const VoxelBox box = BoxAround(grid, point, 0.51 * grid.Spacing[0]);
  for (int k = box.Begin[2]; k < box.End[2]; ++k)
  {
    for (int j = box.Begin[1]; j < box.End[1]; ++j)
    {
      for (int i = box.Begin[0]; i < box.End[0]; ++i)
      {
        body(i, j, k);
      }
    }
  }
}

// The cells of a start surface: a ball within the outline and along the path. They hold a point of
// `outside` only where the path is.
BitMask StartCells(const VesselTree& tree, const PointList& outside, double edge)
{
  FloatImage depth = DepthOnGrid(tree, edge, 30);
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    ForEachCellAt(depth.Geometry, outside.row(point).transpose(),
      [&](int i, int j, int k) { depth.Voxels[depth.Geometry.Offset(i, j, k)] = -1; });
  }
  BitMask cells = VoxelsWhere(
    depth.View(), [&](float value) { return value > 0.25 * edge; }, SerialFor);
  for (const VesselBranch& branch : tree.Branches)
  {
    PointList line(static_cast<Eigen::Index>(branch.Sections.Frames.size()), 3);
    for (Eigen::Index section = 0; section < line.rows(); ++section)
    {
      line.row(section) = branch.Sections.Frames[section].Origin;
    }
    InsertLine(line, cells);
  }
  // The deepest cell, of equals the first.
  const auto deepest = static_cast<std::size_t>(
    std::max_element(depth.Voxels.begin(), depth.Voxels.end()) - depth.Voxels.begin());
  return GrowBall(cells, depth.Voxels, deepest);
}

bool HoldsOne(const BitMask& cells, const PointList& outside)
{
  bool isHeld = false;
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    ForEachCellAt(cells.GetGeometry(), outside.row(point).transpose(),
      [&](int i, int j, int k) { isHeld = isHeld || cells(i, j, k); });
  }
  return isHeld;
}

void RequireOutside(const DeformableSurface& surface, const PointList& outside)
{
  for (Eigen::Index point = 0; point < outside.rows(); ++point)
  {
    if (WindingNumber(surface.Points, surface.Mesh.Triangles, outside.row(point).transpose()) != 0)
    {
      throw Error(ErrorCode::UnreachablePoint,
        NameOf({ ConstraintKind::Outside, outside.row(point).transpose(), 0 }) +
          " lies on the vessel's path or beside it; move it away from the path, or give more "
          "points on the vessel's way");
    }
  }
}

// A coarse surface within the outline, of one piece and without handles. Its cells are finer where
// otherwise one of them would hold both the path and a point outside.
DeformableSurface MakeStart(const VesselTree& tree, const PointList& outside)
{
  constexpr double leastEdge = 0.8; // mm
  constexpr double finer = 0.7;
  double edge = std::max(leastEdge, SmallestRadius(tree) / 2);
  const BitMask coarse = StartCells(tree, outside, edge);
  BitMask cells = coarse;
  while (edge > leastEdge && HoldsOne(cells, outside))
  {
    edge = std::max(leastEdge, finer * edge);
    cells = StartCells(tree, outside, edge);
  }
  // Cells that a point touches are not always cells around it: then the coarse ones will do.
  const CellSurface surface = MakeCellSurface(HoldsOne(cells, outside) ? coarse : cells);
  DeformableSurface start{ BuildContourMesh(static_cast<int>(surface.Points.rows()), surface.Faces),
    surface.Points };
  RequireOutside(start, outside);
  return start;
}

// Deforms the start onto the outline.
class OutlineFit
{
public:
  OutlineFit(const VesselTree& tree, const ConstraintList& constraints, double spacing,
    const VesselSegmentationSettings& settings, const ParallelFor& parallelFor,
    const Monitor& monitor, OrganSurface& surface)
    : Settings(settings)
    , Parallel(parallelFor)
    , Ask(monitor)
    , Surface(surface)
    , Radius(SmallestRadius(tree))
    , Edges(DepthOnGrid(tree, std::max(0.5, std::min(1.2, Radius / 5)), 4))
  {
    this->Foreground = VoxelsWhere(
      this->Edges.View(), [](float value) { return value > 0; }, parallelFor);
    std::transform(this->Edges.Voxels.begin(), this->Edges.Voxels.end(), this->Edges.Voxels.begin(),
      [](float value) { return std::tanh(value / RoundedEdge); });
    if (!constraints.empty())
    {
      this->Enforcer.emplace(constraints, spacing);
    }
  }

  StopReason Run()
  {
    if (this->Enforcer)
    {
      this->Enforcer->Begin(this->Surface.Mesh,
        FaceHulls(this->Surface.Points, this->Surface.Mesh.Faces), this->Surface.Points);
    }
    const StopReason reason = this->IterateLevels();
    return reason != StopReason::Aborted && this->FinishConstraints() ? reason
                                                                      : StopReason::Aborted;
  }

private:
  bool Proceed() const { return this->Ask(this->Done); }

  bool FinishConstraints()
  {
    if (!this->Enforcer)
    {
      return true;
    }
    return this->Enforcer->Finish(
      this->Surface.Mesh, *this->Guard, this->Parallel, [this](double) { return this->Proceed(); },
      this->Surface.Points);
  }

  StopReason IterateLevels()
  {
    StopReason reason = StopReason::NotRun;
    for (this->Level = 0; this->Level < this->Settings.Levels; ++this->Level)
    {
      if (this->Level > 0)
      {
        RefinedSurface refined = RefineSurface(this->Surface.Mesh, this->Surface.Points,
          this->Enforcer ? this->Enforcer->GetObstacles() : PointList(0, 3),
          this->Settings.Step.Guard, this->Parallel, [this](double) { return this->Proceed(); });
        if (!refined.Embedded)
        {
          return this->Proceed() ? StopReason::NotRefined : StopReason::Aborted;
        }
        this->Surface.Mesh = std::move(refined.Mesh);
        this->Surface.Points = std::move(refined.Points);
        this->Guard = std::move(refined.Guard);
      }
      reason = this->IterateLevel();
      if (reason == StopReason::Aborted)
      {
        break;
      }
    }
    return reason;
  }

  StopReason IterateLevel()
  {
    if (this->Settings.Step.Guard && !this->Guard)
    {
      this->Guard = std::make_unique<EmbeddingGuard>(this->Surface.Mesh, this->Parallel);
    }
    DeformationSolver solver(this->Surface.Mesh);
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < this->Settings.MaximumIterations; ++iteration)
    {
      const double part = static_cast<double>(iteration) / this->Settings.MaximumIterations;
      this->Done = (this->Level + part) / this->Settings.Levels;
      if (!this->Proceed())
      {
        return StopReason::Aborted;
      }
      if (this->Enforcer)
      {
        this->Enforcer->Update(this->Surface.Mesh, this->Guard->Hulls(), this->Surface.Points);
        this->Guard->SetObstacles(this->Enforcer->GetObstacles());
      }
      const TargetReport report = this->IterateOnce(solver);
      const double voxel = this->Edges.Geometry.Spacing[0];
      if (report.Matched == 0)
      {
        return StopReason::NoBoundaryFound;
      }
      if (report.MeanDistance < 0.1 * voxel)
      {
        return StopReason::DistanceBelowTolerance;
      }
      if (iteration % 3 == 2)
      {
        if (before - report.MeanDistance < 0.05 * voxel)
        {
          return StopReason::AtRest;
        }
        before = report.MeanDistance;
      }
    }
    return StopReason::IterationLimit;
  }

  TargetReport IterateOnce(DeformationSolver& solver)
  {
    IterationRecord record;
    record.Iteration = static_cast<int>(this->Surface.Iterations.size()) + 1;
    record.Level = this->Level;
    record.Vertices = this->Surface.Mesh.NumberOfPoints();
    TargetSettings targets = this->Settings.Targets;
    targets.Correspondence.SearchDistance = std::max(5.0, 2.5 * this->Radius);
    targets.Correspondence.RunLength = this->Edges.Geometry.Spacing[0];
    targets.Correspondence.EdgeWindow = this->Edges.Geometry.Spacing[0];
    targets.Correspondence.ImageBoundaryDistance = 0;
    Stopwatch watch;
    this->Surface.Field = FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground,
      this->Edges.View(), this->Radius, targets, this->Parallel, record.Targets);
    record.SearchSeconds = watch.Lap();
    const Monitor proceed = [this](double) { return this->Proceed(); };
    record.Step = DeformOnce(solver, this->Guard.get(), this->Settings.Step, this->Parallel,
      proceed, this->Surface.Field, this->Surface.Points);
    this->Surface.Iterations.push_back(record);
    return record.Targets;
  }

  const VesselSegmentationSettings& Settings;
  const ParallelFor& Parallel;
  const Monitor& Ask;
  OrganSurface& Surface;
  double Radius;
  FloatImage Edges;
  BitMask Foreground;
  std::optional<ConstraintEnforcer> Enforcer;
  std::unique_ptr<EmbeddingGuard> Guard; // of the level's surface
  int Level = 0;
  double Done = 0; ///< progress
};

// How far the surface goes beyond the disks at the ends, in mm.
double BeyondEnds(const VesselTree& tree, const PointList& points)
{
  double farthest = 0;
  for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
  {
    const Eigen::Vector3d point = points.row(vertex);
    double nearest = std::numeric_limits<double>::infinity();
    double beyond = 0;
    for (const VesselBranch& branch : tree.Branches)
    {
      const auto& frames = branch.Sections.Frames;
      for (std::size_t section = 0; section < frames.size(); ++section)
      {
        const Eigen::Vector3d offset = point - frames[section].Origin;
        if (offset.squaredNorm() < nearest)
        {
          nearest = offset.squaredNorm();
          const double along = offset.dot(frames[section].Tangent);
          const bool isStart = section == 0 && branch.Parent < 0;
          beyond = isStart ? -along : (section + 1 == frames.size() ? along : 0);
        }
      }
    }
    farthest = std::max(farthest, beyond);
  }
  return farthest;
}

// The middle of the sections, over a length that strikes the eye, with the least support.
Eigen::Vector3d FaintestPlace(const VesselTree& tree)
{
  constexpr Eigen::Index reach = 7; // sections to either side: about 20 mm in all
  Eigen::Vector3d faintest = tree.Branches.front().Sections.Frames.front().Origin;
  double least = std::numeric_limits<double>::infinity();
  for (const VesselBranch& branch : tree.Branches)
  {
    const Eigen::Index sections = branch.Support.size();
    for (Eigen::Index section = 0; section < sections; ++section)
    {
      const Eigen::Index first = std::max<Eigen::Index>(0, section - reach);
      const Eigen::Index last = std::min(sections - 1, section + reach);
      const double mean = branch.Support.segment(first, last - first + 1).mean();
      if (mean < least)
      {
        least = mean;
        faintest = branch.Sections.Frames[section].Origin;
      }
    }
  }
  return faintest;
}

void AddWarnings(const ImageGeometry& geometry, VesselSegmentation& result)
{
  constexpr double tolerance = 3; // mm
  if (result.Surface.Reason == StopReason::NotRefined)
  {
    result.Warnings.emplace_back(
      "the surface could not be refined without intersecting itself, and is coarse; set Levels to "
      "1, or move the points apart");
  }
  if (result.Tree.Support < DoubtfulSupport)
  {
    result.Warnings.push_back(
      "the result is doubtful: much of the vessel's boundary is hardly visible in the image, least "
      "of all near " +
      TextOf(FaintestPlace(result.Tree).array().round().matrix().transpose()) +
      " mm; look there first: where the surface is not in the vessel, add a point of the vessel");
  }
  const double beyond = BeyondEnds(result.Tree, result.Surface.Points);
  if (beyond > tolerance)
  {
    result.Warnings.push_back("the surface goes " + TextOf(Eigen::VectorXd::Constant(1, beyond)) +
      " mm beyond an end of the path; look at the ends, and move their points");
  }
  for (const VesselBranch& branch : result.Tree.Branches)
  {
    for (std::size_t section = 1; section + 1 < branch.Sections.Frames.size(); ++section)
    {
      const Eigen::Vector3d index = geometry.ToIndex(branch.Sections.Frames[section].Origin);
      for (int axis = 0; axis < 3; ++axis)
      {
        if (index[axis] < -0.5 || index[axis] > geometry.Dimensions[axis] - 0.5)
        {
          result.Warnings.push_back("the path leaves the image near " +
            TextOf(branch.Sections.Frames[section].Origin) +
            " mm; add a point on the vessel's way");
          return;
        }
      }
    }
  }
}

PointList PlacesOutside(const ConstraintList& constraints)
{
  PointList places(0, 3);
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Outside)
    {
      places.conservativeResize(places.rows() + 1, 3);
      places.bottomRows(1) = constraint.Point.transpose();
    }
  }
  return places;
}

void RequireCorrections(const ImageGeometry& geometry, const PointList& points,
  const ConstraintList& constraints, bool guard, const std::string& name)
{
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Seed)
    {
      throw Error(ErrorCode::OutOfRange,
        NameOf(constraint) + " is of no use to a vessel; give a further point on its way");
    }
    if (!guard)
    {
      throw std::invalid_argument(NameOf(constraint) +
        " can only be obeyed under the guard; switch Guard on, or remove the constraints");
    }
  }
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    constexpr double apart = 0.5; // mm; the path begins there
    RequireConstraints(geometry, { points.row(point).transpose(), 2 * apart }, constraints, name);
  }
}

} // namespace

VesselSegmentation SegmentVessel(const GrayVolume& volume, const std::string& name,
  const PointList& points, const ConstraintList& constraints,
  const VesselSegmentationSettings& settings, const Threading& threading, const Monitor& monitor)
{
  VesselSegmentation result;
  RequireCorrections(volume.Geometry, points, constraints, settings.Step.Guard, name);
  Stopwatch watch;
  const Monitor tracing = PartOf(monitor, 0, 0.5);
  const Monitor fitting = PartOf(monitor, 0.5, 1);
  result.Tree = TraceVessel(volume, name, points, PlacesOutside(constraints), settings.Path,
    threading, tracing);
  result.StageSeconds[0] = watch.Lap();
  if (result.Tree.Branches.empty())
  {
    result.Surface.Reason = StopReason::Aborted;
    return result;
  }
  CorrectOutline(constraints, result.Tree);
  DeformableSurface start = MakeStart(result.Tree, PlacesOutside(constraints));
  result.Surface.Mesh = std::move(start.Mesh);
  result.Surface.Points = std::move(start.Points);
  result.StageSeconds[1] = watch.Lap();
  result.Surface.Reason = OutlineFit(result.Tree, constraints, volume.Geometry.Spacing.minCoeff(),
    settings, threading.For, fitting, result.Surface)
                            .Run();
  result.StageSeconds[2] = watch.Lap();
  if (result.Surface.Reason == StopReason::Aborted)
  {
    return result;
  }
  result.Surface.SelfIntersections =
    CountSelfIntersections(result.Surface.Points, result.Surface.Mesh.Faces, threading.For);
  if (settings.Step.Guard && result.Surface.SelfIntersections > 0)
  {
    throw std::logic_error("the surface intersects itself in " +
      std::to_string(result.Surface.SelfIntersections) +
      " pairs of faces although every step was certified, which should be impossible; please "
      "report it with the image and the points");
  }
  AddWarnings(volume.Geometry, result);
  result.Voxels = VoxelizeSurface(result.Surface.Points, result.Surface.Mesh.Triangles,
    volume.Geometry, threading.For);
  result.StageSeconds[3] = watch.Lap();
  return result;
}

} // namespace FlipFree

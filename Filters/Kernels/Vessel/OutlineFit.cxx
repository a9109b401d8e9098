#include "Vessel/OutlineFit.h"

#include "Deformation/DeformationLoop.h"
#include "Vessel/TreeDepth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace FlipFree
{
namespace
{

constexpr double RoundedEdge = 0.7; // mm: the outline's edge in the image of depths, for snapping

ScheduleSettings ScheduleOf(const VesselSegmentationSettings& settings)
{
  ScheduleSettings schedule;
  schedule.Levels = settings.Levels;
  schedule.Resolution = 2 << (settings.Levels - 1); // the start is fine enough for all of them
  schedule.MaximumIterations = settings.MaximumIterations;
  return schedule;
}

/// Drawn to the outline by an image of how deep within it a place is.
class DeformingVessel : public DeformingSurface
{
public:
  DeformingVessel(double radius, FloatImage depth, double spacing,
    const VesselSegmentationSettings& settings, const ParallelFor& parallelFor)
    : DeformingSurface(ScheduleOf(settings), settings.Step,
        { spacing, depth.Geometry.Spacing.maxCoeff() }, parallelFor)
    , Radius(radius)
    , Edges(std::move(depth))
    , Foreground(VoxelsWhere(
        this->Edges.View(), [](float value) { return value > 0; }, parallelFor))
    , Targets(settings.Targets)
  {
    std::transform(this->Edges.Voxels.begin(), this->Edges.Voxels.end(), this->Edges.Voxels.begin(),
      [](float value) { return std::tanh(value / RoundedEdge); });
    this->Targets.Correspondence.SearchDistance = std::max(5.0, 2.5 * this->Radius);
    this->Targets.Correspondence.RunLength = this->Edges.Geometry.Spacing[0];
    this->Targets.Correspondence.EdgeWindow = this->Edges.Geometry.Spacing[0];
    this->Targets.Correspondence.ImageBoundaryDistance = 0;
  }

private:
  CorrespondenceField SearchTargets(TargetReport& report) override
  {
    return FindTargets(this->Surface.Mesh, this->Surface.Points, this->Foreground, {},
      this->Edges.View(), this->Radius, this->Targets, this->Parallel, report);
  }

  const double Radius;
  FloatImage Edges;
  const BitMask Foreground;
  TargetSettings Targets;
};

} // namespace

OrganSurface FitToOutline(const VesselTree& tree, const DeformableSurface& start,
  const ConstraintList& constraints, double spacing, const VesselSegmentationSettings& settings,
  const ParallelFor& parallelFor, const Monitor& monitor)
{
  const double radius = SmallestRadius(tree);
  const double edge = std::max(0.5, std::min(1.2, radius / 5));
  DeformingVessel vessel(radius, DepthOnGrid(tree, edge, 4, parallelFor), spacing, settings,
    parallelFor);
  vessel.BeginAt(start, 0, constraints, OutsidePoints::FromTheStart, ObserveNothing);
  const RememberingMonitor remembering(monitor);
  if (!DeformationLoop({ &vessel }, {}, parallelFor).Run(remembering.Get()) ||
    remembering.HasStopped())
  {
    vessel.SetReason(StopReason::Aborted);
  }
  return std::move(vessel.GetSurface());
}

} // namespace FlipFree

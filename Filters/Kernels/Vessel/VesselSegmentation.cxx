#include "Vessel/VesselSegmentation.h"

#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Image/GridCheck.h"
#include "MessageText.h"
#include "Stopwatch.h"
#include "Vessel/OutlineCorrection.h"
#include "Vessel/OutlineFit.h"
#include "Vessel/VesselParameters.h"
#include "Vessel/VesselStart.h"
#include "Vessel/VesselWarnings.h"

#include <stdexcept>

namespace FlipFree
{
namespace
{

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
        NameOf(constraint) + " is of no use to a vessel; give a further point along it");
    }
    if (!guard)
    {
      throw Error(ErrorCode::OutOfRange,
        NameOf(constraint) +
          " can only be obeyed under the guard; switch {Guard} on, or remove the corrections");
    }
  }
  RequireConstraints(geometry, constraints, name);
  for (const PointConstraint& constraint : constraints)
  {
    for (Eigen::Index point = 0; point < points.rows(); ++point)
    {
      constexpr double apart = 0.5; // mm; the path begins there
      if (constraint.Kind == ConstraintKind::Outside &&
        (constraint.Point - points.row(point).transpose()).norm() < apart)
      {
        throw Error(ErrorCode::OutOfRange,
          NameOf(constraint) + " lies at the vessel's point " + TextOf(points.row(point)) +
            " mm; move one of them");
      }
    }
  }
}

} // namespace

VesselSegmentation SegmentVessel(const GrayVolume& volume, const std::string& name,
  const PointList& points, const ConstraintList& constraints,
  const VesselSegmentationSettings& settings, const Threading& threading, const Monitor& monitor)
{
  RequireNumbers(settings);
  RequireVoxels(volume.Geometry, name);
  RequireCorrections(volume.Geometry, points, constraints, settings.Step.Guard, name);
  VesselSegmentation result;
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
  const DeformableSurface start = MakeStart(result.Tree, PlacesOutside(constraints), threading.For);
  result.StageSeconds[1] = watch.Lap();
  result.Surface = FitToOutline(result.Tree, start, constraints, volume.Geometry.Spacing.minCoeff(),
    settings, threading.For, fitting);
  result.StageSeconds[2] = watch.Lap();
  if (result.Surface.Reason == StopReason::Aborted)
  {
    return result;
  }
  // Where cells of the start surface meet in a hollow, faces have five corners or six.
  result.Surface.Mesh =
    BuildMeshAtRest(result.Surface.Mesh.NumberOfPoints(), CutLargeFaces(result.Surface.Mesh.Faces));
  result.Surface.SelfIntersections =
    CountSelfIntersections(result.Surface.Points, result.Surface.Mesh.Faces, threading.For);
  if (settings.Step.Guard && result.Surface.SelfIntersections > 0)
  {
    throw std::logic_error("the surface intersects itself in " +
      std::to_string(result.Surface.SelfIntersections) +
      " pairs of faces although every step was certified, which should be impossible; please "
      "report it with the image and the points");
  }
  result.Confidence = ConfidenceOf(result.Tree, settings.Confidence);
  AddWarnings(volume.Geometry, points, settings.Confidence.Doubtful, result);
  result.Voxels = VoxelizeSurface(result.Surface.Points, result.Surface.Mesh.Triangles,
    volume.Geometry, threading.For);
  result.StageSeconds[3] = watch.Lap();
  return result;
}

} // namespace FlipFree

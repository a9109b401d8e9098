// Vessels between points: a volume and points in, surface, label map and centerline out.
#include "Answers.h"
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Vessel/Polyline.h"
#include "Vessel/VesselParameters.h"
#include "Vessel/VesselProvenance.h"

#include <nanobind/stl/array.h>

namespace FlipFree
{
namespace
{

// Per branch its center, the radius and the length at each point, and the branch that it begins on.
nb::list BranchesOf(const VesselTree& tree)
{
  nb::list branches;
  for (const VesselBranch& branch : tree.Branches)
  {
    PointList centers = branch.Sections.Centers();
    Eigen::VectorXd radii = branch.Sections.MeanRadii();
    Eigen::VectorXd lengths = ArcLengths(centers);
    const auto size = static_cast<std::size_t>(centers.rows());
    nb::dict one;
    one["points"] = ArrayOf<double>(std::move(centers), { size, 3 });
    one["radius"] = ArrayOf<double>(std::move(radii), { size });
    one["length"] = ArrayOf<double>(std::move(lengths), { size });
    one["parent"] = branch.Parent;
    branches.append(one);
  }
  return branches;
}

// Kind, x, y, z.
using CorrectionRow = std::tuple<int, double, double, double>;

ConstraintList ConstraintsOf(const std::vector<CorrectionRow>& rows)
{
  ConstraintList constraints;
  for (const auto& [kind, x, y, z] : rows)
  {
    constraints.push_back({ static_cast<ConstraintKind>(kind), { x, y, z }, 0 });
  }
  return constraints;
}

nb::dict Trace(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const std::vector<Triple>& places, const std::vector<CorrectionRow>& rows,
  const VesselSegmentationSettings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  PointList points(static_cast<Eigen::Index>(places.size()), 3);
  for (Eigen::Index point = 0; point < points.rows(); ++point)
  {
    points.row(point) = Eigen::Map<const Eigen::RowVector3d>(places[point].data());
  }
  VesselSegmentation result;
  {
    const nb::gil_scoped_release unlocked;
    const Monitor monitor = MonitorOf(report, 0, 0.95);
    if (!MonitorOf(report)(0))
    {
      result.Surface.Reason = StopReason::Aborted;
    }
    else
    {
      result = SegmentVessel(GrayVolumeOf(voxels, geometry), ImageName, points, ConstraintsOf(rows),
        settings, PoolThreading(), monitor);
    }
  }
  OrganSurface& surface = result.Surface;
  nb::dict answer;
  answer["stop_reason"] = std::string(ToString(surface.Reason));
  if (surface.Reason == StopReason::Aborted)
  {
    return answer;
  }
  answer["boundary_found"] = surface.Reason != StopReason::NoBoundaryFound;
  answer["self_intersections"] = surface.SelfIntersections;
  answer["iterations"] = ColumnsOf(surface.Iterations);
  answer["warnings"] = result.Warnings;
  answer["labels"] = LabelsOf(result.Voxels, settings.LabelValue, geometry);
  answer["branches"] = BranchesOf(result.Tree);
  answer["support"] = result.Tree.Support;
  answer["confidence"] = result.Confidence.Value;
  answer["stage_seconds"] =
    std::vector<double>(result.StageSeconds.begin(), result.StageSeconds.end());
  nb::dict found =
    SurfaceDict(std::move(surface.Mesh.Faces), std::move(surface.Points), std::move(surface.Field));
  found["provenance"] = ProvenanceOf(points, ConstraintsOf(rows), settings, geometry);
  answer["surface"] = found;
  report(1.0);
  return answer;
}

} // namespace

void BindVessels(nb::module_& module)
{
  BindSettings<VesselSegmentationSettings>(module, "VesselSettings", &VesselParameters)
    .def(nb::init<>());
  module.def("trace", &Trace, nb::arg("voxels").noconvert(), nb::arg("spacing"), nb::arg("origin"),
    nb::arg("direction"), nb::arg("points"), nb::arg("corrections"), nb::arg("settings"),
    nb::arg("report"));
}

} // namespace FlipFree

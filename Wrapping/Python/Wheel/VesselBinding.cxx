// A vessel, or a tree of vessels: a volume and points in; surface, label map and convergence out.
#include "Answers.h"
#include "Bindings.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Vessel/VesselParameters.h"

#include <nanobind/stl/array.h>

#include <array>
#include <utility>

namespace FlipFree
{
namespace
{

using Settings = VesselSegmentationSettings;

PointList PointsOf(const std::vector<std::tuple<double, double, double>>& rows)
{
  PointList points(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::Index at = 0;
  for (const auto& [x, y, z] : rows)
  {
    points.row(at++) = Eigen::RowVector3d(x, y, z);
  }
  return points;
}

nb::dict Trace(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const std::vector<std::tuple<double, double, double>>& rows, int label,
  const Settings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  const PointList points = PointsOf(rows);
  VesselSegmentation result;
  {
    const nb::gil_scoped_release unlocked;
    RequireNumbers(settings);
    RequireVoxels(geometry);
    const GrayVolume volume = VisitVoxels(voxels, geometry,
      [](const auto& view) { return GrayVolumeOf(view, ImageName, PoolThreading()); });
    result = SegmentVessel(volume, ImageName, points, settings, PoolThreading(),
      MonitorOf(report, 0, 0.95));
  }
  OrganSurface& vessel = result.Surface;
  nb::dict answer;
  answer["stop_reason"] = std::string(ToString(vessel.Reason));
  if (vessel.Reason == StopReason::Aborted)
  {
    return answer;
  }
  answer["self_intersections"] = vessel.SelfIntersections;
  answer["iterations"] = ColumnsOf(vessel.Iterations);
  answer["warnings"] = result.Warnings;
  answer["labels"] = LabelsOf(result.Voxels, label, geometry);
  answer["surface"] =
    DictOf(std::move(vessel.Mesh.Faces), std::move(vessel.Points), std::move(vessel.Field));
  report(1.0);
  return answer;
}

} // namespace

void BindVessels(nb::module_& module)
{
  BindSettings<Settings>(module, "VesselSettings", &VesselParameters).def(nb::init<>());
  module.def("trace", &Trace, nb::arg("voxels").noconvert(), nb::arg("spacing"), nb::arg("origin"),
    nb::arg("direction"), nb::arg("points"), nb::arg("label"), nb::arg("settings"),
    nb::arg("report"));
}

} // namespace FlipFree

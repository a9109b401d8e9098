// The whole method: a volume and a seed in, surface, label map and convergence out.
#include "Answers.h"
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Deformation/Provenance.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/SegmentationRequest.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <optional>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

// Points and faces of a start surface.
using Start = std::tuple<Rows3, Indices, Indices>;

GivenSurface SurfaceOf(const Start& start, const std::string& name)
{
  const auto& [points, corners, offsets] = start;
  GivenSurface surface;
  surface.Name = name;
  surface.Points =
    Eigen::Map<const PointList>(points.data(), static_cast<Eigen::Index>(points.shape(0)), 3);
  surface.Faces.Connectivity.assign(corners.data(), corners.data() + corners.size());
  surface.Faces.Offsets.assign(offsets.data(), offsets.data() + offsets.size());
  return surface;
}

// Kind, place and radius.
using ConstraintRow = std::tuple<int, double, double, double, double>;

ConstraintList ConstraintsOf(const std::vector<ConstraintRow>& rows)
{
  ConstraintList constraints;
  for (const auto& [kind, x, y, z, radius] : rows)
  {
    constraints.push_back({ static_cast<ConstraintKind>(kind), { x, y, z }, radius });
  }
  return constraints;
}

// The surface with its confidence, which are used up, and where it comes from.
nb::dict ResultDict(VolumeSegmentation& result, const std::string& provenance)
{
  OrganSurface& organ = result.Organ;
  nb::dict surface =
    SurfaceDict(std::move(organ.Mesh.Faces), std::move(organ.Points), std::move(organ.Field));
  std::vector<float>& ofVertices = result.Confidence.OfVertices;
  const std::size_t vertices = ofVertices.size();
  surface["vertex_confidence"] = ArrayOf<float>(std::move(ofVertices), { vertices });
  surface["confidence"] = result.Confidence.OfSurface;
  surface["provenance"] = provenance;
  return surface;
}

// A kept iteration.
struct Iteration
{
  FaceList Faces;
  PointList Points;
  CorrespondenceField Field;
};

nb::list HistoryList(std::vector<Iteration>& history)
{
  nb::list surfaces;
  for (Iteration& iteration : history)
  {
    surfaces.append(SurfaceDict(std::move(iteration.Faces), std::move(iteration.Points),
      std::move(iteration.Field)));
  }
  return surfaces;
}

nb::dict SegmentOrgan(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const Triple& center, double radius, const std::optional<Start>& start,
  const std::optional<LabelMap>& labels, int label, const std::vector<ConstraintRow>& rows,
  const Settings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  OrganRequest request;
  if (!labels)
  {
    request.Seed = SeedSphere{ Eigen::Vector3d(center.data()), radius };
  }
  request.Constraints = ConstraintsOf(rows);
  request.Settings = settings;
  std::vector<Iteration> history;
  std::string noLabels;
  OrganAnswer found;
  found.Result.Organ.Reason = StopReason::Aborted;
  {
    const nb::gil_scoped_release unlocked;
    if (MonitorOf(report)(0))
    {
      OrganSession session(GrayVolumeOf(voxels, geometry), ImageName, PoolThreading());
      if (labels)
      {
        const LabelVolume volume = LabelVolumeOf(*labels, "the start labels");
        session.FillLabel(volume, label);
        noLabels = WarningOfNoLabels(volume.Values(), label, volume.Name, "is filled");
      }
      if (start)
      {
        session.StartFrom(SurfaceOf(*start, "the start surface"));
      }
      found = session.Segment(request, MonitorOf(report, 0, 0.95),
        [&history](const ContourMesh& mesh, const PointList& points,
          const CorrespondenceField& field, const IterationRecord&) {
          history.push_back({ mesh.Faces, points, field });
        });
    }
  }
  VolumeSegmentation& result = found.Result;
  const OrganSurface& organ = result.Organ;
  nb::dict answer;
  answer["stop_reason"] = std::string(ToString(organ.Reason));
  answer["aborted"] = organ.Reason == StopReason::Aborted;
  if (organ.Reason == StopReason::Aborted)
  {
    return answer;
  }
  answer["boundary_found"] = organ.Reason != StopReason::NoBoundaryFound;
  answer["self_intersections"] = organ.SelfIntersections;
  answer["stage_seconds"] = result.StageSeconds;
  answer["iterations"] = ColumnsOf(organ.Iterations);
  if (!noLabels.empty())
  {
    result.Warnings.push_back(noLabels);
  }
  answer["warnings"] = result.Warnings;
  answer["questions"] = ColumnsOf(QuestionColumns(), result.Questions);
  answer["labels"] = LabelsOf(result.Voxels, settings.LabelValue, geometry);
  answer["history"] = HistoryList(history);
  answer["surface"] = ResultDict(result, found.Provenance);
  report(1.0);
  return answer;
}

// Name, center and radius of the seed, constraints.
using OrganRow = std::tuple<std::string, Triple, double, std::vector<ConstraintRow>>;

nb::dict SegmentOrgans(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const std::vector<OrganRow>& rows, const std::vector<Start>& surfaces,
  const Settings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  GroupRequest request;
  for (const auto& [name, center, radius, points] : rows)
  {
    request.Organs.push_back(
      { name, { { ConstraintKind::Seed, Eigen::Vector3d(center.data()), radius } } });
    ConstraintList& constraints = request.Organs.back().Constraints;
    const ConstraintList more = ConstraintsOf(points);
    constraints.insert(constraints.end(), more.begin(), more.end());
  }
  for (const Start& surface : surfaces)
  {
    const std::size_t number = request.Fixed.size() + 1;
    request.Fixed.push_back(SurfaceOf(surface, "the fixed surface " + std::to_string(number)));
  }
  request.Settings = settings;
  GroupAnswer found;
  {
    const nb::gil_scoped_release unlocked;
    found = SegmentGroup(GrayVolumeOf(voxels, geometry), ImageName, request, PoolThreading(),
      MonitorOf(report, 0, 0.95));
  }
  nb::dict answer;
  nb::list list;
  std::vector<std::vector<VoxelRun>> runs;
  for (VolumeSegmentation& result : found.Results)
  {
    OrganSurface& organ = result.Organ;
    if (organ.Reason == StopReason::Aborted)
    {
      return answer;
    }
    nb::dict entry;
    entry["stop_reason"] = std::string(ToString(organ.Reason));
    entry["boundary_found"] = organ.Reason != StopReason::NoBoundaryFound;
    entry["self_intersections"] = organ.SelfIntersections;
    entry["stage_seconds"] = result.StageSeconds;
    entry["iterations"] = ColumnsOf(organ.Iterations);
    entry["warnings"] = result.Warnings;
    entry["questions"] = ColumnsOf(QuestionColumns(), result.Questions);
    entry["surface"] = ResultDict(result, found.Provenance);
    runs.push_back(std::move(result.Voxels));
    list.append(entry);
  }
  answer["organs"] = list;
  answer["labels"] = LabelsOf(runs, settings.LabelValue, geometry);
  report(1.0);
  return answer;
}

Settings SettingsOf(const std::string& preset)
{
  return { SettingsOfPreset(preset) };
}

} // namespace

void BindSegmentation(nb::module_& module)
{
  BindSettings<Settings>(module, "SegmentationSettings", &SegmentationParameters)
    .def(nb::new_(&SettingsOf), nb::arg("preset"));
  module.def("comments_on", &CommentsOn, nb::arg("provenance"));
  module.def("segment", &SegmentOrgan, nb::arg("voxels").noconvert(), nb::arg("spacing"),
    nb::arg("origin"), nb::arg("direction"), nb::arg("center"), nb::arg("radius"),
    nb::arg("start").none(), nb::arg("labels").none(), nb::arg("label"), nb::arg("constraints"),
    nb::arg("settings"), nb::arg("report"));
  module.def("segment_organs", &SegmentOrgans, nb::arg("voxels").noconvert(), nb::arg("spacing"),
    nb::arg("origin"), nb::arg("direction"), nb::arg("organs"), nb::arg("fixed"),
    nb::arg("settings"), nb::arg("report"));
}

} // namespace FlipFree

// The whole method: a volume and a seed in, surface, label map and convergence out.
#include "Answers.h"
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Deformation/OrganGroup.h"
#include "Deformation/Provenance.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/StartMask.h"
#include "Deformation/VolumeSegmentation.h"
#include "Image/GridCheck.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <optional>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

const char* const LabelsName = "the start labels on port 3";

// Points and faces of a start surface.
using Start = std::tuple<Rows3, Indices, Indices>;

DeformableSurface SurfaceOf(const Start& start, const std::string& name, bool requireEmbedded)
{
  const auto& [points, corners, offsets] = start;
  if (points.shape(0) == 0)
  {
    throw std::invalid_argument(name + " has no points; give one that has");
  }
  FaceList faces;
  faces.Connectivity.assign(corners.data(), corners.data() + corners.size());
  faces.Offsets.assign(offsets.data(), offsets.data() + offsets.size());
  const PointList copy =
    Eigen::Map<const PointList>(points.data(), static_cast<Eigen::Index>(points.shape(0)), 3);
  return MakeStartSurface(copy, faces, name, requireEmbedded, PoolFor);
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

// Voxels, spacing, origin, direction.
using LabelMap = std::tuple<Voxels, Triple, Triple, Nine>;

BitMask StartMaskOf(const LabelMap& labels, int label, const ImageGeometry& image)
{
  const auto& [voxels, spacing, origin, direction] = labels;
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  if (geometry.NumberOfVoxels() == 0)
  {
    throw std::invalid_argument(std::string(LabelsName) + " have no voxels; give a label map");
  }
  RequireProperGrid(geometry, LabelsName);
  RequireSameGeometry(geometry, image, LabelsName, ImageName);
  return VisitVoxels(voxels, geometry,
    [&](const auto& view)
    {
      BitMask mask = MaskOfLabel(view, label == 0 ? -1 : label, LabelsName, PoolThreading());
      RequireStartLabel(
        mask, label, [&view]() { return LabelsIn(view, PoolFor); }, LabelsName);
      return mask;
    });
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

// What one organ is segmented from, beside the image.
struct OrganRequest
{
  SeedSphere Seed;
  ConstraintList Constraints;
  const std::optional<Start>& Surface;
  const std::optional<LabelMap>& Labels;
  int Label;
};

// Runs without Python's lock.
VolumeSegmentation SegmentOrgan(const Voxels& voxels, const ImageGeometry& geometry,
  const OrganRequest& request, const Settings& settings, const Monitor& monitor,
  std::vector<Iteration>& history)
{
  RequireNumbers(settings);
  RequireVoxels(geometry);
  BitMask mask;
  SeedSphere seed = request.Seed;
  if (request.Labels)
  {
    mask = StartMaskOf(*request.Labels, request.Label, geometry);
    seed = LargestBallIn(mask, LabelsName, PoolFor);
  }
  RequireSeed(geometry, seed, ImageName);
  std::optional<DeformableSurface> surface;
  if (request.Surface)
  {
    surface =
      SurfaceOf(*request.Surface, "the start surface on port 1", settings.Method.Step.Guard);
  }
  const GrayVolume volume = VisitVoxels(voxels, geometry,
    [](const auto& view) { return GrayVolumeOf(view, ImageName, PoolThreading()); });
  VolumeSegmenter segmenter(volume, ImageName, seed, surface ? &*surface : nullptr, settings,
    PoolThreading());
  if (request.Labels)
  {
    segmenter.SetForeground(std::move(mask), LabelsName);
  }
  return segmenter.Segment(request.Constraints, monitor,
    [&](const ContourMesh& mesh, const PointList& points, const CorrespondenceField& field,
      const IterationRecord&)
    {
      if (settings.KeepHistory)
      {
        history.push_back({ mesh.Faces, points, field });
      }
    });
}

OrganProvenance OriginOf(const OrganRequest& request)
{
  OrganProvenance provenance;
  provenance.Seed = request.Seed;
  provenance.Constraints = request.Constraints;
  provenance.HasStartSurface = request.Surface.has_value();
  provenance.StartLabel = request.Labels ? request.Label : -1;
  return provenance;
}

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

nb::dict Segment(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const Triple& center, double radius, const std::optional<Start>& start,
  const std::optional<LabelMap>& labels, int label, const std::vector<ConstraintRow>& rows,
  const Settings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  OrganRequest request{ { Eigen::Vector3d(center.data()), radius }, ConstraintsOf(rows), start,
    labels, label };
  if (!labels)
  {
    TakeLargestSeed(request.Seed, request.Constraints);
  }
  std::vector<Iteration> history;
  VolumeSegmentation result;
  result.Organ.Reason = StopReason::Aborted;
  {
    const nb::gil_scoped_release unlocked;
    if (MonitorOf(report)(0))
    {
      result =
        SegmentOrgan(voxels, geometry, request, settings, MonitorOf(report, 0, 0.95), history);
    }
  }
  const OrganSurface& organ = result.Organ;
  nb::dict answer;
  answer["stop_reason"] = std::string(ToString(organ.Reason));
  answer["aborted"] = organ.Reason == StopReason::Aborted;
  if (organ.Reason == StopReason::Aborted)
  {
    return answer;
  }
  answer["self_intersections"] = organ.SelfIntersections;
  answer["iterations"] = ColumnsOf(organ.Iterations);
  answer["warnings"] = result.Warnings;
  answer["labels"] = LabelsOf(result.Voxels, settings.LabelValue, geometry);
  answer["history"] = HistoryList(history);
  answer["surface"] = ResultDict(result, ProvenanceOf(OriginOf(request), settings, geometry));
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
  std::vector<SeededOrgan> organs;
  std::vector<ConstraintList> constraints;
  for (const auto& [name, center, radius, points] : rows)
  {
    organs.push_back({ name, { Eigen::Vector3d(center.data()), radius } });
    constraints.push_back(ConstraintsOf(points));
    TakeLargestSeed(organs.back().Seed, constraints.back());
  }
  std::vector<VolumeSegmentation> results;
  {
    const nb::gil_scoped_release unlocked;
    const Monitor monitor = MonitorOf(report, 0, 0.95);
    RequireNumbers(settings);
    RequireVoxels(geometry);
    if (settings.LabelValue + static_cast<int>(rows.size()) > 256)
    {
      throw std::invalid_argument(
        "labels go up to 255, which leaves none for the last organ; lower LabelValue, or remove "
        "organs");
    }
    std::vector<FixedSurface> fixed;
    for (const Start& surface : surfaces)
    {
      const std::string name =
        "the fixed surface " + std::to_string(fixed.size() + 1) + " on port 2";
      fixed.push_back({ name, SurfaceOf(surface, name, true) });
    }
    const GrayVolume volume = VisitVoxels(voxels, geometry,
      [](const auto& view) { return GrayVolumeOf(view, ImageName, PoolThreading()); });
    OrganGroup group(volume, ImageName, organs, std::move(fixed), settings, PoolThreading());
    results = group.Segment(constraints, monitor,
      [](std::size_t, const ContourMesh&, const PointList&, const CorrespondenceField&,
        const IterationRecord&) {});
  }
  std::vector<OrganProvenance> origins;
  for (std::size_t index = 0; index < organs.size(); ++index)
  {
    origins.push_back({ organs[index].Name, organs[index].Seed, constraints[index] });
  }
  const std::string provenance = ProvenanceOf(origins, surfaces.size(), settings, geometry);
  nb::dict answer;
  nb::list list;
  std::vector<std::vector<VoxelRun>> runs;
  for (VolumeSegmentation& result : results)
  {
    OrganSurface& organ = result.Organ;
    if (organ.Reason == StopReason::Aborted)
    {
      return answer;
    }
    nb::dict entry;
    entry["stop_reason"] = std::string(ToString(organ.Reason));
    entry["self_intersections"] = organ.SelfIntersections;
    entry["iterations"] = ColumnsOf(organ.Iterations);
    entry["warnings"] = result.Warnings;
    entry["surface"] = ResultDict(result, provenance);
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
  Settings settings;
  settings.Method = SettingsOfPreset(preset);
  return settings;
}

} // namespace

void BindSegmentation(nb::module_& module)
{
  BindSettings<Settings>(module, "SegmentationSettings", &SegmentationParameters)
    .def(nb::new_(&SettingsOf), nb::arg("preset"));
  module.def("segment", &Segment, nb::arg("voxels").noconvert(), nb::arg("spacing"),
    nb::arg("origin"), nb::arg("direction"), nb::arg("center"), nb::arg("radius"),
    nb::arg("start").none(), nb::arg("labels").none(), nb::arg("label"), nb::arg("constraints"),
    nb::arg("settings"), nb::arg("report"));
  module.def("segment_organs", &SegmentOrgans, nb::arg("voxels").noconvert(), nb::arg("spacing"),
    nb::arg("origin"), nb::arg("direction"), nb::arg("organs"), nb::arg("fixed"),
    nb::arg("settings"), nb::arg("report"));
}

} // namespace FlipFree

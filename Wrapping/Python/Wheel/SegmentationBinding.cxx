// The whole method: a volume and a seed in, surface, label map and convergence out.
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Deformation/ConvergenceColumns.h"
#include "Deformation/SegmentationParameters.h"
#include "Deformation/VolumeSegmentation.h"
#include "Image/GridCheck.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <optional>

namespace FlipFree
{
namespace
{

using Settings = VolumeSegmentationSettings;

const char* const ImageName = "the image on port 0";

// A surface on its way to Python.
nb::dict DictOf(FaceList faces, PointList points, CorrespondenceField field)
{
  const auto size = static_cast<std::size_t>(points.rows());
  // Of no iteration: nothing is wanted.
  if (field.States.size() != size)
  {
    field.Displacements = PointList::Zero(points.rows(), 3);
    field.States.assign(size, VertexState::Solitary);
  }
  std::vector<std::uint8_t> states(size);
  std::transform(field.States.begin(), field.States.end(), states.begin(),
    [](VertexState state) { return static_cast<std::uint8_t>(state); });
  const std::size_t corners = faces.Connectivity.size();
  const std::size_t offsets = faces.Offsets.size();
  nb::dict surface;
  surface["points"] = ArrayOf<double>(std::move(points), { size, 3 });
  surface["corners"] = ArrayOf<int>(std::move(faces.Connectivity), { corners });
  surface["offsets"] = ArrayOf<int>(std::move(faces.Offsets), { offsets });
  surface["displacements"] = ArrayOf<double>(std::move(field.Displacements), { size, 3 });
  surface["correspondence"] = ArrayOf<std::uint8_t>(std::move(states), { size });
  return surface;
}

nb::dict ColumnsOf(const std::vector<IterationRecord>& records)
{
  nb::dict columns;
  for (const ConvergenceColumn& column : ConvergenceColumns())
  {
    const auto read = [&](auto zero)
    {
      std::vector<decltype(zero)> values;
      for (const IterationRecord& record : records)
      {
        values.push_back(static_cast<decltype(zero)>(column.Read(record)));
      }
      return ArrayOf<decltype(zero)>(std::move(values), { records.size() });
    };
    columns[column.Name] = column.IsCount ? read(int()) : read(double());
  }
  return columns;
}

// The system provides large blocks cleared, page by page on first use; most of a volume is never
// touched.
nb::object LabelsOf(const std::vector<VoxelRun>& runs, int label, const ImageGeometry& geometry)
{
  auto* const voxels =
    static_cast<std::uint8_t*>(std::calloc(std::max<std::size_t>(1, geometry.NumberOfVoxels()), 1));
  if (!voxels)
  {
    throw std::bad_alloc();
  }
  const nb::capsule owner(voxels, [](void* p) noexcept { std::free(p); });
  FillRuns(runs, static_cast<std::uint8_t>(label), geometry, voxels);
  const auto& size = geometry.Dimensions;
  return nb::cast(nb::ndarray<nb::numpy, std::uint8_t>(voxels,
    { static_cast<std::size_t>(size[2]), static_cast<std::size_t>(size[1]),
      static_cast<std::size_t>(size[0]) },
    owner));
}

void RequireGrid(const ImageGeometry& geometry)
{
  if (geometry.NumberOfVoxels() == 0)
  {
    throw std::invalid_argument("the image on port 0 has no voxels; give one that has");
  }
  RequireProperGrid(geometry, ImageName);
}

// Points and faces of a start surface.
using Start = std::tuple<Rows3, Indices, Indices>;

std::optional<DeformableSurface> SurfaceOf(const std::optional<Start>& start, bool requireEmbedded)
{
  if (!start)
  {
    return {};
  }
  const auto& [points, corners, offsets] = *start;
  const std::string name = "the start surface on port 1";
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

nb::dict Segment(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const Triple& center, double radius, const std::optional<Start>& start,
  const std::vector<ConstraintRow>& rows, const Settings& settings, const nb::callable& report)
{
  const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
  SeedSphere seed{ Eigen::Vector3d(center.data()), radius };
  ConstraintList constraints = ConstraintsOf(rows);
  TakeLargestSeed(seed, constraints);
  struct Iteration
  {
    FaceList Faces;
    PointList Points;
    CorrespondenceField Field;
  };
  std::vector<Iteration> history;
  VolumeSegmentation result;
  {
    const nb::gil_scoped_release unlocked;
    const Monitor monitor = MonitorOf(report, 0, 0.95);
    if (!MonitorOf(report)(0))
    {
      result.Organ.Reason = StopReason::Aborted;
    }
    else
    {
      RequireNumbers(settings);
      RequireGrid(geometry);
      RequireSeed(geometry, seed, ImageName);
      const std::optional<DeformableSurface> surface = SurfaceOf(start, settings.Method.Step.Guard);
      const GrayVolume volume = VisitVoxels(voxels, geometry,
        [](const auto& view) { return GrayVolumeOf(view, ImageName, PoolThreading()); });
      VolumeSegmenter segmenter(volume, ImageName, seed, surface ? &*surface : nullptr, settings,
        PoolThreading());
      result = segmenter.Segment(constraints, monitor,
        [&](const ContourMesh& mesh, const PointList& points, const CorrespondenceField& field,
          const IterationRecord&)
        {
          if (settings.KeepHistory)
          {
            history.push_back({ mesh.Faces, points, field });
          }
        });
    }
  }
  OrganSurface& organ = result.Organ;
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
  nb::list surfaces;
  for (Iteration& iteration : history)
  {
    surfaces.append(
      DictOf(std::move(iteration.Faces), std::move(iteration.Points), std::move(iteration.Field)));
  }
  answer["history"] = surfaces;
  nb::dict surface =
    DictOf(std::move(organ.Mesh.Faces), std::move(organ.Points), std::move(organ.Field));
  std::vector<float>& ofVertices = result.Confidence.OfVertices;
  const std::size_t vertices = ofVertices.size();
  surface["vertex_confidence"] = ArrayOf<float>(std::move(ofVertices), { vertices });
  surface["confidence"] = result.Confidence.OfSurface;
  answer["surface"] = surface;
  report(1.0);
  return answer;
}

Settings SettingsOf(const std::string& preset)
{
  Settings settings;
  settings.Method = preset == "published" ? PublishedSettings()
    : preset == "naive"                   ? NaiveSettings()
                                          : OrganSegmentationSettings();
  return settings;
}

} // namespace

void BindSegmentation(nb::module_& module)
{
  BindSettings<Settings>(module, "SegmentationSettings", &SegmentationParameters)
    .def(nb::new_(&SettingsOf), nb::arg("preset"));
  module.def("segment", &Segment, nb::arg("voxels").noconvert(), nb::arg("spacing"),
    nb::arg("origin"), nb::arg("direction"), nb::arg("center"), nb::arg("radius"),
    nb::arg("start").none(), nb::arg("constraints"), nb::arg("settings"), nb::arg("report"));
}

} // namespace FlipFree

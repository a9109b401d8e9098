// Label maps: where their grids lie, which label of a file is meant, and the surfaces of all.
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Exchange/SegmentationLayers.h"
#include "Image/GridCheck.h"
#include "LabelSurface/LabelColumns.h"
#include "LabelSurface/LabelSurfaceParameters.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>

#include <cmath>

namespace FlipFree
{
namespace
{

// The layer of a file, and the value of the label if one was chosen.
std::pair<int, std::optional<int>> ChooseLabelOf(const VolumeFileHeader& header,
  const std::string& choice)
{
  const LabelChoice chosen =
    ChooseLabel(SegmentsOf(header), header.Layers.Count, choice, header.Name);
  return { chosen.Layer, chosen.Label };
}

// The value of a label of a DICOM series, whose labels have no names.
std::optional<int> ChooseValueOf(const std::string& choice, const std::string& name)
{
  return ChooseLabel({}, 1, choice, name).Label;
}

std::map<int, std::string> LabelNamesOf(const VolumeFileHeader& header, int layer)
{
  std::map<int, std::string> names;
  for (const Segment& segment : SegmentsOf(header))
  {
    if (segment.Layer == layer)
    {
      names.emplace(segment.Label, segment.Name);
    }
  }
  return names;
}

// By the names of the columns.
nb::list RowsOf(const std::vector<LabelMeasures>& all)
{
  nb::list rows;
  for (const LabelMeasures& measures : all)
  {
    nb::dict row;
    for (const TableColumn<LabelMeasures>& column : LabelColumns())
    {
      const double value = column.Read(measures);
      row[column.Name] = column.IsCount ? nb::cast(std::llround(value)) : nb::cast(value);
    }
    rows.append(row);
  }
  return rows;
}

nb::dict MakeSurfaces(const Voxels& voxels, const Triple& spacing, const Triple& origin,
  const Nine& direction, const std::vector<int>& wanted, const LabelSurfaceSettings& settings,
  const nb::callable& report)
{
  LabelSurfaces surfaces;
  {
    const nb::gil_scoped_release unlocked;
    const ImageGeometry geometry = GeometryOf(voxels, spacing, origin, direction);
    const std::string name = "the label map";
    RequireVoxels(geometry, name);
    surfaces = VisitVoxels(voxels, geometry,
      [&](const auto& view)
      {
        return MakeLabelSurfaces(MakeLabelGrid(view, wanted, name, PoolFor), geometry, settings,
          PoolFor, MonitorOf(report));
      });
  }
  const auto rows = [](const auto& matrix) { return static_cast<std::size_t>(matrix.rows()); };
  std::vector<int> labels;
  for (const auto& pair : surfaces.Walls.Labels)
  {
    labels.push_back(surfaces.Values[pair[0]]);
    labels.push_back(surfaces.Values[pair[1]]);
  }
  nb::dict answer;
  const std::size_t triangles = rows(surfaces.Walls.Triangles);
  answer["boundary_labels"] = ArrayOf<int>(std::move(labels), { triangles, 2 });
  answer["triangles"] = ArrayOf<int>(std::move(surfaces.Walls.Triangles), { triangles, 3 });
  const std::size_t points = rows(surfaces.Walls.Points);
  answer["points"] = ArrayOf<double>(std::move(surfaces.Walls.Points), { points, 3 });
  answer["wrong_voxels"] = surfaces.WrongVoxels;
  answer["greatest_distance"] = surfaces.GreatestDistance;
  answer["collapse_distance"] = surfaces.CollapseDistance;
  answer["rows"] = RowsOf(surfaces.Measures);
  return answer;
}

} // namespace

void BindLabels(nb::module_& module)
{
  module.def("choose_label", &ChooseLabelOf);
  module.def("choose_value", &ChooseValueOf);
  module.def("label_names", &LabelNamesOf);
  BindSettings<LabelSurfaceSettings>(module, "LabelSurfaceSettings", &LabelSurfaceParameters)
    .def(nb::init<>());
  module.def("make_surfaces", &MakeSurfaces);
}

} // namespace FlipFree

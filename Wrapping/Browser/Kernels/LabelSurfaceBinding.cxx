// The surfaces of all labels of a label map, with what they measure.
#include "Answers.h"

#include "Exchange/FileNames.h"
#include "Exchange/TableText.h"
#include "Image/GridCheck.h"
#include "LabelSurface/LabelColumns.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "Mesh/SurfaceTopology.h"

#include <emscripten/bind.h>

#include <map>
#include <stdexcept>

namespace FlipFree
{
namespace
{

// Null for a label without a surface.
val SurfaceOfLabel(const TrianglesByLabel& triangles, int index)
{
  const LabelBoundary boundary = triangles.BoundaryOf(index);
  return boundary.Triangles.rows() == 0
    ? val::null()
    : SurfaceObject(boundary.Points, FacesOf(boundary.Triangles));
}

// By the columns of tables: the fields of a LabelSurface.
const std::map<std::string, const char*>& Fields()
{
  static const std::map<std::string, const char*> fields{ { "Label", "label" },
    { "Milliliters", "volume" }, { "Voxels", "voxels" }, { "VoxelMilliliters", "voxelVolume" },
    { "WrongVoxels", "wrongVoxels" }, { "Area", "area" }, { "EulerNumber", "eulerNumber" },
    { "Triangles", "triangles" } };
  return fields;
}

val MeasuresOf(const LabelMeasures& measures)
{
  val object = val::object();
  for (const TableColumn<LabelMeasures>& column : LabelColumns())
  {
    object.set(Fields().at(column.Name), column.Read(measures));
  }
  return object;
}

val FieldNames()
{
  val names = val::array();
  for (const TableColumn<LabelMeasures>& column : LabelColumns())
  {
    names.call<void>("push", std::string(Fields().at(column.Name)));
  }
  return names;
}

// { text }, of rows { ...measures, name, file }, which the package has checked.
val TableOf(const val& rows)
{
  std::vector<std::string> columns;
  for (const TableColumn<LabelMeasures>& column : LabelColumns())
  {
    columns.emplace_back(column.Name);
  }
  std::vector<std::vector<TableCell>> cells;
  for (const val& row : emscripten::vecFromJSArray<val>(rows))
  {
    cells.emplace_back();
    for (const TableColumn<LabelMeasures>& column : LabelColumns())
    {
      const auto value = row[Fields().at(column.Name)].as<double>();
      cells.back().push_back(
        column.IsCount ? TableCell(static_cast<std::int64_t>(value)) : TableCell(value));
    }
    cells.back().insert(cells.back().begin() + 1, row["name"].as<std::string>());
    cells.back().push_back(row["file"].as<std::string>());
  }
  columns.insert(columns.begin() + 1, "Name");
  columns.push_back("File");
  val answer = val::object();
  answer.set("text", TextOfTable(columns, cells));
  return answer;
}

val AnswerOf(const LabelSurfaces& found)
{
  if (!found.Complete)
  {
    throw std::runtime_error("stopped");
  }
  const TrianglesByLabel triangles(found.Walls, found.Values.size());
  val labels = val::array();
  for (std::size_t index = 0; index < found.Measures.size(); ++index)
  {
    val label = MeasuresOf(found.Measures[index]);
    label.set("certified", true);
    label.set("surface", SurfaceOfLabel(triangles, static_cast<int>(index) + 1));
    labels.call<void>("push", label);
  }
  val answer = val::object();
  answer.set("labels", labels);
  answer.set("wrongVoxels", static_cast<double>(found.WrongVoxels));
  answer.set("greatestDistance", found.GreatestDistance);
  answer.set("collapseDistance", found.CollapseDistance);
  return answer;
}

val MakeSurfaces(const Volume& labels, const val& only, const val& parameters, const val& report)
{
  return Guarded(
    [&]
    {
      LabelSurfaceSettings settings;
      SetParameters(LabelSurfaceParameters(), parameters, settings);
      const auto wanted = emscripten::vecFromJSArray<int>(only);
      const std::string name = "the label map";
      RequireVoxels(labels.GetGeometry(), name);
      return labels.VisitVoxels(
        [&](const auto& view)
        {
          return AnswerOf(MakeLabelSurfaces(MakeLabelGrid(view, wanted, name, SerialFor),
            view.Geometry, settings, SerialFor, MonitorOf(report)));
        });
    });
}

val DefaultLabelSurfaceParameters()
{
  return ParametersOf(LabelSurfaceParameters(), LabelSurfaceSettings());
}

} // namespace

void BindLabelSurfaces()
{
  emscripten::function("labelSurfaceParameters", &DefaultLabelSurfaceParameters);
  emscripten::function("labelSurfaces", &MakeSurfaces);
  emscripten::function("labelFileName", &LabelFileName);
  emscripten::function("labelFields", &FieldNames);
  emscripten::function("labelTable", &TableOf);
}

} // namespace FlipFree

// The surfaces of all labels of a label map, with what they measure.
#include "Answers.h"

#include "Exchange/FileNames.h"
#include "Image/GridCheck.h"
#include "LabelSurface/LabelSurfaceParameters.h"
#include "Mesh/SurfaceTopology.h"

#include <emscripten/bind.h>

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

val MeasuresOf(const LabelMeasures& measures)
{
  val object = val::object();
  object.set("label", measures.Label);
  object.set("volume", measures.Volume / 1000);
  object.set("voxels", static_cast<double>(measures.Voxels));
  object.set("voxelVolume", measures.VoxelVolume / 1000);
  object.set("wrongVoxels", static_cast<double>(measures.WrongVoxels));
  object.set("area", measures.Area);
  object.set("eulerNumber", measures.EulerNumber);
  object.set("triangles", measures.Triangles);
  return object;
}

val AnswerOf(const LabelSurfaces& found)
{
  const TrianglesByLabel triangles(found.Walls, found.Values.size());
  val labels = val::array();
  for (std::size_t index = 0; index < found.Measures.size(); ++index)
  {
    val label = MeasuresOf(found.Measures[index]);
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
  emscripten::function("fileNamePart", &FileNamePart);
}

} // namespace FlipFree

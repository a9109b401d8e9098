// Scores of a surface or a label map against a reference.
#include "Answers.h"
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Measures/ScoreColumns.h"
#include "Measures/ScoreParameters.h"
#include "Measures/ScoreSummary.h"
#include "Measures/SegmentationScores.h"
#include "Measures/SurfaceValidity.h"
#include "Mesh/SurfaceTopology.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>

namespace FlipFree
{
namespace
{

// By the names of the columns, which Python spells its own way.
nb::dict DictOf(const SegmentationScores& scores)
{
  nb::dict answer;
  ForEachScore(scores, [&answer](const char* name, const auto& value) { answer[name] = value; });
  answer["warnings"] = scores.Warnings;
  return answer;
}

// Names and units of the columns.
std::vector<std::pair<std::string, std::string>> ColumnsOfScores()
{
  std::vector<std::pair<std::string, std::string>> columns;
  for (const ScoreColumn& column : ScoreColumns())
  {
    columns.emplace_back(column.Name, column.Unit);
  }
  for (const ScoreTextColumn& column : ScoreTextColumns())
  {
    columns.emplace_back(column.Name, "");
  }
  return columns;
}

// A reference with its label.
LabelMask ReferenceOf(const LabelMap& reference, const ScoreSettings& settings)
{
  return LabelMaskOf(LabelVolumeOf(reference, "the reference"), settings.ReferenceLabel,
    "ReferenceLabel");
}

nb::dict ScoreOfLabels(const LabelMap& segmentation, const LabelMap& reference,
  const ScoreSettings& settings, const nb::callable& report)
{
  SegmentationScores scores;
  {
    const nb::gil_scoped_release unlocked;
    const LabelMask wanted = ReferenceOf(reference, settings);
    const LabelMask mask = LabelMaskOf(LabelVolumeOf(segmentation, "the segmentation"),
      settings.SegmentationLabel, "SegmentationLabel");
    scores = ScoreLabels(mask, wanted, settings, PoolFor, MonitorOf(report));
  }
  return DictOf(scores);
}

struct Polygons
{
  PointList Points;
  FaceList Faces;
};

Polygons PolygonsOf(const Rows3& points, const Indices& corners, const Indices& offsets)
{
  Polygons polygons;
  polygons.Points =
    Eigen::Map<const PointList>(points.data(), static_cast<Eigen::Index>(points.shape(0)), 3);
  polygons.Faces.Connectivity.assign(corners.data(), corners.data() + corners.size());
  polygons.Faces.Offsets.assign(offsets.data(), offsets.data() + offsets.size());
  RequireValidFaces(polygons.Points, polygons.Faces, "the segmentation");
  return polygons;
}

nb::dict ScoreOfSurface(const Rows3& points, const Indices& corners, const Indices& offsets,
  const LabelMap& reference, const ScoreSettings& settings, const nb::callable& report)
{
  SegmentationScores scores;
  {
    const nb::gil_scoped_release unlocked;
    const LabelMask wanted = ReferenceOf(reference, settings);
    const Polygons surface = PolygonsOf(points, corners, offsets);
    scores = ScoreSurface(surface.Points, Triangulate(surface.Faces), wanted, settings, PoolFor,
      MonitorOf(report));
  }
  return DictOf(scores);
}

// Of the columns' values by their names.
std::string SummaryOfScores(const nb::dict& values)
{
  SegmentationScores scores;
  for (const ScoreColumn& column : ScoreColumns())
  {
    scores.*column.Member = nb::cast<double>(values[column.Name]);
  }
  for (const ScoreTextColumn& column : ScoreTextColumns())
  {
    scores.*column.Member = nb::cast<std::string>(values[column.Name]);
  }
  return SummaryOf(scores);
}

std::string ValidityOf(const Rows3& points, const Indices& corners, const Indices& offsets,
  const nb::callable& report)
{
  const nb::gil_scoped_release unlocked;
  const Polygons surface = PolygonsOf(points, corners, offsets);
  return SummaryOf(
    MeasureValidity(surface.Points, surface.Faces, nullptr, PoolFor, MonitorOf(report)));
}

} // namespace

void BindEvaluation(nb::module_& module)
{
  BindSettings<ScoreSettings>(module, "ScoreSettings", &ScoreParameters).def(nb::init<>());
  module.def("score_columns", &ColumnsOfScores);
  module.def("score_labels", &ScoreOfLabels);
  module.def("score_surface", &ScoreOfSurface);
  module.def("score_summary", &SummaryOfScores);
  module.def("validity_summary", &ValidityOf);
}

} // namespace FlipFree

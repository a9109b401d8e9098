// Scores of a surface or a label map against a reference.
#include "Answers.h"
#include "Bindings.h"
#include "Numpy.h"
#include "Report.h"
#include "ThreadPool.h"

#include "Measures/SegmentationScores.h"
#include "Measures/SurfaceValidity.h"
#include "Mesh/SurfaceTopology.h"

#include <nanobind/stl/array.h>

namespace FlipFree
{
namespace
{

nb::dict DictOf(const SegmentationScores& scores)
{
  nb::dict answer;
  answer["dice"] = scores.Dice;
  answer["jaccard"] = scores.Jaccard;
  answer["relative_volume_difference"] = scores.RelativeVolumeDifference;
  answer["asd"] = scores.ASD;
  answer["rms"] = scores.RMS;
  answer["hd95"] = scores.HD95;
  answer["hd"] = scores.HD;
  answer["segmentation_volume"] = scores.SegmentationVolume;
  answer["reference_volume"] = scores.ReferenceVolume;
  answer["overlap_of"] = scores.OverlapOf;
  answer["distance_of"] = scores.DistanceOf;
  answer["warning"] = scores.Warning;
  return answer;
}

LabelMask ReferenceOf(const LabelMap& reference, const ScoreSettings& settings)
{
  return LabelMaskOf(LabelVolumeOf(reference, "the reference on port 1"), settings.ReferenceLabel,
    "ReferenceLabel");
}

nb::dict ScoreOfLabels(const LabelMap& segmentation, const LabelMap& reference,
  const ScoreSettings& settings, const nb::callable& report)
{
  SegmentationScores scores;
  {
    const nb::gil_scoped_release unlocked;
    const LabelMask wanted = ReferenceOf(reference, settings);
    const LabelMask mask = LabelMaskOf(LabelVolumeOf(segmentation, "the segmentation on port 0"),
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
  RequireValidFaces(polygons.Points, polygons.Faces, "the segmentation on port 0");
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

nb::dict ValidityOf(const Rows3& points, const Indices& corners, const Indices& offsets,
  const nb::callable& report)
{
  SurfaceValidity validity;
  {
    const nb::gil_scoped_release unlocked;
    const Polygons surface = PolygonsOf(points, corners, offsets);
    validity = MeasureValidity(surface.Points, surface.Faces, nullptr, PoolFor, MonitorOf(report));
  }
  nb::dict answer;
  answer["valid"] = validity.IsValid();
  answer["boundary_edges"] = validity.Quality.Topology.BoundaryEdges;
  answer["euler_number"] = validity.Quality.Topology.EulerNumber();
  answer["self_intersections"] = validity.SelfIntersections;
  return answer;
}

} // namespace

void BindEvaluation(nb::module_& module)
{
  BindSettings<ScoreSettings>(module, "ScoreSettings", &ScoreParameters).def(nb::init<>());
  module.def("score_labels", &ScoreOfLabels);
  module.def("score_surface", &ScoreOfSurface);
  module.def("surface_validity", &ValidityOf);
}

} // namespace FlipFree

#include "Measures/SegmentationScores.h"

#include "Error.h"
#include "Image/GridCheck.h"
#include "Measures/ScoreParameters.h"
#include "Measures/SurfaceDistance.h"
#include "Measures/VoxelOverlap.h"
#include "Mesh/SurfaceVoxelization.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

BitMask Voxelize(const PointList& points, const TriangleList& triangles, const LabelMask& reference,
  const ParallelFor& parallelFor)
{
  const ImageGeometry& geometry = reference.Mask.GetGeometry();
  const std::vector<VoxelRun> runs = VoxelizeSurface(points, triangles, geometry, parallelFor);
  if (runs.empty())
  {
    throw Error(ErrorCode::EmptyMask,
      "the segmentation, a surface, encloses no voxel center of " + reference.Name +
        "; check that both are in the same physical coordinates");
  }
  BitMask mask(geometry);
  for (const VoxelRun& run : runs)
  {
    mask.InsertRun(run.Begin, run.End, run.J, run.K);
  }
  return mask;
}

void Store(const VoxelOverlap& overlap, const ImageGeometry& geometry, SegmentationScores& scores)
{
  scores.Dice = overlap.Dice();
  scores.Jaccard = overlap.Jaccard();
  scores.RelativeVolumeDifference = overlap.RelativeVolumeDifference();
  scores.SegmentationVolume = geometry.Milliliters(overlap.Segmentation);
  scores.ReferenceVolume = geometry.Milliliters(overlap.Reference);
}

void Store(const SurfaceDistance& distance, SegmentationScores& scores)
{
  scores.ASD = distance.Average;
  scores.RMS = distance.RootMeanSquare;
  scores.HD95 = distance.Hausdorff95;
  scores.HD = distance.Hausdorff;
  scores.Complete = distance.Complete;
}

// A surface may follow the border of the image; what lies further out is another image's.
void WarnOfPointsOutside(const PointList& points, const TriangleList& triangles,
  const LabelMask& reference, std::vector<std::string>& warnings)
{
  constexpr double margin = 1; // voxels beyond the outer faces
  const ImageGeometry& geometry = reference.Mask.GetGeometry();
  const Eigen::Array3d end =
    Eigen::Array3i(geometry.Dimensions[0], geometry.Dimensions[1], geometry.Dimensions[2])
      .cast<double>();
  const auto isOutside = [&](Eigen::Index point)
  {
    const Eigen::Array3d index = geometry.ToIndex(points.row(point)).array() + 0.5;
    return (index < -margin).any() || (index > end + margin).any();
  };
  Eigen::Index outside = 0;
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (const int corner : triangles.row(triangle))
    {
      outside += isOutside(corner) ? 1 : 0;
    }
  }
  if (outside > 0)
  {
    const long percent =
      std::max(1L, std::min(99L, std::lround(100.0 * outside / triangles.size())));
    warnings.push_back("About " + std::to_string(percent) +
      " % of the segmentation's surface lies outside " + reference.Name +
      ", by more than a voxel; overlap and volume count only what lies within it; check that both "
      "are in the same physical coordinates.");
  }
}

// A segmentation of one organ, or a surface, against a reference of several.
void WarnOfLabels(const LabelMask* segmentation, const LabelMask& reference,
  std::vector<std::string>& warnings)
{
  if (reference.Label >= 0)
  {
    return;
  }
  // Mostly there is but one, and the segmentation need not be looked through.
  const LabelValues values = reference.Values();
  if (!values.AreSeveral() ||
    (segmentation && segmentation->Label < 0 && segmentation->Values().AreSeveral()))
  {
    return;
  }
  const std::string labels = TextOf(values.Labels);
  const std::string others = TextOf(values.Others);
  warnings.push_back(others.empty() ? "The reference has the labels " + labels +
        "; the segmentation has one organ only: it is compared with all of them together; to "
        "compare it with one, set {ReferenceLabel}."
                                    : "The reference has the values " + others +
        ", which are not valid labels; every nonzero voxel counts as inside; give it a label map" +
        (labels.empty() ? "" : ", or set {ReferenceLabel} to one of " + labels) + ".");
}

void RequireLabel(const LabelMask& labelMap, const std::string& property)
{
  if (labelMap.Label < 0 || !labelMap.Mask.Bounds().IsEmpty())
  {
    return;
  }
  const LabelValues values = labelMap.Values();
  const std::string labels = TextOf(values.Labels);
  const std::string others = TextOf(values.Others);
  std::string message =
    labelMap.Name + " is empty: no voxel has the label " + std::to_string(labelMap.Label);
  if (!labels.empty())
  {
    message += "; set {" + property + "} to one of " + labels +
      (others.empty() ? "" : ", if it is a label map: it also contains " + others);
  }
  else
  {
    message += others.empty() ? ", all are 0; check that it is the intended label map"
                              : "; it is not a label map; it contains " + others +
        ", but a label map contains only whole numbers from 0 up; give it a label map";
  }
  throw Error(ErrorCode::EmptyMask, message);
}

} // namespace

LabelMask LabelMaskOf(const LabelVolume& labels, int label, const std::string& property)
{
  if (labels.Geometry.NumberOfVoxels() == 0)
  {
    throw Error(ErrorCode::InvalidGeometry, labels.Name + " has no voxels; give a label map");
  }
  RequireProperGrid(labels.Geometry, labels.Name);
  LabelMask mask{ labels.MaskOf(label), label, labels.Values, labels.Name };
  RequireLabel(mask, property);
  return mask;
}

SegmentationScores ScoreSurface(const PointList& points, const TriangleList& triangles,
  const LabelMask& reference, const ScoreSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  RequireNumbers(ScoreParameters(), settings);
  const ImageGeometry& geometry = reference.Mask.GetGeometry();
  const BitMask voxels = Voxelize(points, triangles, reference, parallelFor);
  SegmentationScores scores;
  Store(MeasureOverlap(voxels, reference.Mask, parallelFor), geometry, scores);
  scores.OverlapOf = "voxelized mesh";
  scores.DistanceOf = settings.ScoreVoxelization ? "surface of voxelized mesh" : "mesh";
  const LabelSurface surface = settings.ScoreVoxelization
    ? SurfaceOf(voxels, settings.LabelSmoothing)
    : LabelSurface{ points, triangles };
  const LabelSurface wanted = SurfaceOf(reference.Mask, settings.LabelSmoothing);
  Store(MeasureSurfaceDistance(surface.Points, surface.Triangles, wanted.Points, wanted.Triangles,
          settings.SampleSpacing, parallelFor, monitor),
    scores);
  // After all errors: one of them is enough.
  if (scores.Complete)
  {
    WarnOfPointsOutside(points, triangles, reference, scores.Warnings);
    WarnOfLabels(nullptr, reference, scores.Warnings);
  }
  return scores;
}

SegmentationScores ScoreLabels(const LabelMask& segmentation, const LabelMask& reference,
  const ScoreSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor)
{
  RequireNumbers(ScoreParameters(), settings);
  SegmentationScores scores;
  Store(MeasureOverlap(segmentation.Mask, reference.Mask, parallelFor),
    reference.Mask.GetGeometry(), scores);
  scores.OverlapOf = "label map";
  scores.DistanceOf = "surface of label map";
  const LabelSurface surface = SurfaceOf(segmentation.Mask, settings.LabelSmoothing);
  const LabelSurface wanted = SurfaceOf(reference.Mask, settings.LabelSmoothing);
  Store(MeasureSurfaceDistance(surface.Points, surface.Triangles, wanted.Points, wanted.Triangles,
          settings.SampleSpacing, parallelFor, monitor),
    scores);
  if (scores.Complete)
  {
    WarnOfLabels(&segmentation, reference, scores.Warnings);
  }
  return scores;
}

} // namespace FlipFree

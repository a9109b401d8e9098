#include "Measures/SegmentationScores.h"

#include "Error.h"
#include "Image/GridCheck.h"
#include "Image/LatticePlacement.h"
#include "Measures/ScoreParameters.h"
#include "Measures/SurfaceDistance.h"
#include "Measures/VoxelOverlap.h"
#include "Mesh/SurfaceVoxelization.h"
#include "MessageText.h"

#include <algorithm>
#include <cmath>

namespace FlipFree
{
namespace
{

// Of the grid around a segmentation and a reference: far more than scans have. A surface in other
// units would need far more memory than this.
constexpr int MostAlongAxis = 1 << 16;
constexpr double MostVoxels = 4294967296.0; // half a gigabyte of bits

const char* const WhatItNeeds = ", but a label map contains only whole numbers from 0 up, one for "
                                "each organ; give it a label map";

// A box of the reference's lattice that holds both; beyond its own grid, the reference is empty.
ImageGeometry GridAround(const VoxelBox& box, const LabelMask& reference)
{
  const ImageGeometry& own = reference.Mask.GetGeometry();
  const double voxels = 1.0 * box.Size(0) * box.Size(1) * box.Size(2);
  const int longest = std::max({ box.Size(0), box.Size(1), box.Size(2) });
  if (!(box == WholeBox(own)) && (voxels > MostVoxels || longest > MostAlongAxis))
  {
    throw Error(ErrorCode::TooLarge,
      "the segmentation reaches too far beyond " + reference.Name +
        ": a grid around both would have " + TextOf(voxels) +
        " voxels; check that both are in the same physical coordinates");
  }
  return CropGeometry(own, box);
}

// Which fraction of a mask's voxels is not in a box of it.
double FractionOutside(const BitMask& mask, const VoxelBox& box)
{
  const auto count = static_cast<double>(mask.Count());
  return count == 0 ? 0 : 1 - static_cast<double>(mask.Cropped(box).Count()) / count;
}

VoxelBox Moved(VoxelBox box, const std::array<int, 3>& first)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    box.Begin[axis] -= first[axis];
    box.End[axis] -= first[axis];
  }
  return box;
}

BitMask MaskOf(const std::vector<VoxelRun>& runs, const ImageGeometry& geometry)
{
  BitMask mask(geometry);
  mask.InsertRuns(runs);
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

// Where a surface lies on the reference's lattice.
struct SurfacePlace
{
  double Outside = 0; // which fraction of its corners lies outside the reference
  VoxelBox Box;       // the reference's grid, and what lies outside
};

// A surface may follow the border of the image, and that is not outside.
SurfacePlace PlaceOf(const PointList& points, const TriangleList& triangles,
  const ImageGeometry& geometry)
{
  constexpr double margin = 1;     // voxels beyond the outer faces
  constexpr double farthest = 1e9; // which an index can hold, and no grid
  SurfacePlace place;
  place.Box = WholeBox(geometry);
  const Eigen::Array3d end =
    Eigen::Array3i(geometry.Dimensions[0], geometry.Dimensions[1], geometry.Dimensions[2])
      .cast<double>();
  Eigen::Index outside = 0;
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    for (const int corner : triangles.row(triangle))
    {
      const Eigen::Array3d index = geometry.ToIndex(points.row(corner)).array();
      if (!(index + 0.5 < -margin).any() && !(index + 0.5 > end + margin).any())
      {
        continue;
      }
      ++outside;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double at = std::max(-farthest, std::min(farthest, index[axis]));
        place.Box.Begin[axis] = std::min(place.Box.Begin[axis], static_cast<int>(std::floor(at)));
        place.Box.End[axis] = std::max(place.Box.End[axis], static_cast<int>(std::ceil(at)) + 1);
      }
    }
  }
  place.Outside = static_cast<double>(outside) / static_cast<double>(triangles.size());
  return place;
}

// What nobody chose of a label map, where there is a choice.
void WarnOfLabels(const LabelMask& labelMap, bool isReference, bool isOtherOfOne,
  std::vector<std::string>& warnings)
{
  const LabelValues& values = labelMap.Values;
  const std::string noLabels =
    WarningOfNoLabels(values, labelMap.Label, labelMap.Name, "counts as inside");
  if (!noLabels.empty())
  {
    warnings.push_back(noLabels);
  }
  else if (labelMap.Label < 0 && values.AreSeveral() && isOtherOfOne)
  {
    const std::string own = isReference ? "reference" : "segmentation";
    const std::string other = isReference ? "segmentation" : "reference";
    warnings.push_back("The " + own + " has the labels " + TextOf(values.Labels) + "; the " +
      other + " has one organ only: it is compared with all of them together; to compare it " +
      "with one, set {" + (isReference ? "ReferenceLabel" : "SegmentationLabel") + "}.");
  }
}

void RequireLabel(const LabelMask& labelMap, const std::string& property)
{
  if (labelMap.Label < 0 || !labelMap.Mask.Bounds().IsEmpty())
  {
    return;
  }
  const LabelValues& values = labelMap.Values;
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
                              : "; it is not a label map; it contains " + others + WhatItNeeds;
  }
  throw Error(ErrorCode::EmptyMask, message);
}

// Of a scan or of probabilities, nothing is the organ.
void RequireNoGrayValues(const LabelMask& labelMap)
{
  if (!labelMap.Values.AreGrayValues(labelMap.Label))
  {
    return;
  }
  const std::string others = TextOf(labelMap.Values.Others);
  throw Error(ErrorCode::InvalidInput,
    labelMap.Name + " is not a label map; it contains " +
      (others.empty() ? "more than " +
            std::to_string(labelMap.Label < 0 ? LabelValues::MostOrgans : LabelValues::Most) +
            " different values"
                      : others) +
      WhatItNeeds);
}

} // namespace

LabelMask LabelMaskOf(const LabelVolume& labels, int label, const std::string& property)
{
  if (labels.Geometry.NumberOfVoxels() == 0)
  {
    throw Error(ErrorCode::InvalidGeometry, labels.Name + " has no voxels; give a label map");
  }
  RequireProperGrid(labels.Geometry, labels.Name);
  LabelMask mask{ labels.MaskOf(label), label, labels.Values(), labels.Name };
  RequireLabel(mask, property);
  RequireNoGrayValues(mask);
  return mask;
}

SegmentationScores ScoreSurface(const PointList& points, const TriangleList& triangles,
  const LabelMask& reference, const ScoreSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor)
{
  RequireNumbers(ScoreParameters(), settings);
  const ImageGeometry& own = reference.Mask.GetGeometry();
  const SurfacePlace place = PlaceOf(points, triangles, own);
  const ImageGeometry grid = GridAround(place.Box, reference);
  const BitMask voxels = MaskOf(VoxelizeSurface(points, triangles, grid, parallelFor), grid);
  if (voxels.Cropped(Moved(WholeBox(own), place.Box.Begin)).Count() == 0)
  {
    throw Error(ErrorCode::EmptyMask,
      "the segmentation, a surface, encloses no voxel center of " + reference.Name +
        "; check that both are in the same physical coordinates");
  }
  const BitMask known = PlacedIn(place.Box, own, {}, reference.Mask);
  SegmentationScores scores;
  Store(MeasureOverlap(voxels, known, parallelFor), grid, scores);
  scores.OverlapOf = "voxelized mesh";
  scores.DistanceOf = settings.ScoreVoxelization ? "surface of voxelized mesh" : "mesh";
  const MaskSurface surface = settings.ScoreVoxelization
    ? SurfaceOf(voxels, settings.LabelSmoothing)
    : MaskSurface{ points, triangles };
  const MaskSurface wanted = SurfaceOf(reference.Mask, settings.LabelSmoothing);
  Store(MeasureSurfaceDistance(surface.Points, surface.Triangles, wanted.Points, wanted.Triangles,
          settings.SampleSpacing, parallelFor, monitor),
    scores);
  // After all errors: one of them is enough.
  if (scores.Complete)
  {
    if (place.Outside > 0)
    {
      scores.Warnings.push_back("About " + PercentOf(place.Outside) +
        " of the segmentation's surface lies outside " + reference.Name +
        ", by more than a voxel, where " + reference.Name +
        " counts as empty; check that both are in the same physical coordinates.");
    }
    WarnOfLabels(reference, true, true, scores.Warnings);
  }
  return scores;
}

SegmentationScores ScoreLabels(const LabelMask& segmentation, const LabelMask& reference,
  const ScoreSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor)
{
  RequireNumbers(ScoreParameters(), settings);
  const ImageGeometry& own = reference.Mask.GetGeometry();
  const ImageGeometry& other = segmentation.Mask.GetGeometry();
  const LatticePlacement placement = PlacementOn(own, other, reference.Name, segmentation.Name);
  const VoxelBox place = placement.BoxOf(WholeBox(other));
  const VoxelBox box = place.Joined(WholeBox(own));
  const ImageGeometry grid = GridAround(box, reference);
  const BitMask voxels = PlacedIn(box, own, placement, segmentation.Mask);
  const BitMask known = PlacedIn(box, own, {}, reference.Mask);
  SegmentationScores scores;
  Store(MeasureOverlap(voxels, known, parallelFor), grid, scores);
  scores.OverlapOf = "label map";
  scores.DistanceOf = "surface of label map";
  const MaskSurface surface = SurfaceOf(voxels, settings.LabelSmoothing);
  const MaskSurface wanted = SurfaceOf(known, settings.LabelSmoothing);
  Store(MeasureSurfaceDistance(surface.Points, surface.Triangles, wanted.Points, wanted.Triangles,
          settings.SampleSpacing, parallelFor, monitor),
    scores);
  if (scores.Complete)
  {
    const auto warn =
      [&scores](double outside, const LabelMask& of, const LabelMask& beyond, const std::string& as)
    {
      if (outside > 0)
      {
        scores.Warnings.push_back(PercentOf(outside) + " of the voxels of " + of.Name +
          " lie outside the grid of " + beyond.Name + ", and count as " + as + ".");
      }
    };
    warn(FractionOutside(voxels, Moved(WholeBox(own), box.Begin)), segmentation, reference,
      "wrong");
    warn(FractionOutside(known, Moved(place, box.Begin)), reference, segmentation, "missed");
    const auto isOfOne = [](const LabelMask& mask)
    { return mask.Label >= 0 || !mask.Values.AreSeveral(); };
    WarnOfLabels(segmentation, false, isOfOne(reference), scores.Warnings);
    WarnOfLabels(reference, true, isOfOne(segmentation), scores.Warnings);
  }
  return scores;
}

} // namespace FlipFree

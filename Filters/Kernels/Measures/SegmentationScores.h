/**
 * How well a segmentation agrees with a reference label map: overlap of the voxels and distance of
 * the surfaces.
 */
#ifndef FlipFreeSegmentationScores_h
#define FlipFreeSegmentationScores_h

#include "Image/LabelValues.h"
#include "Measures/MaskSurface.h"

#include <limits>
#include <string>
#include <vector>

namespace FlipFree
{

struct ScoreSettings
{
  int SegmentationLabel = -1;     ///< negative: every value but 0
  int ReferenceLabel = -1;        ///< negative: every value but 0
  double SampleSpacing = 1;       ///< greatest distance of neighboring samples, in millimeters
  int LabelSmoothing = 0;         ///< iterations of windowed sinc smoothing of the labels' surfaces
  bool ScoreVoxelization = false; ///< measure the surface of a mesh's voxels, not the mesh
};

struct SegmentationScores
{
  static constexpr double None = std::numeric_limits<double>::quiet_NaN();

  double Dice = None;
  double Jaccard = None;
  double RelativeVolumeDifference = None; ///< negative where the segmentation is smaller
  double ASD = None;                      ///< weighted by area; mm, as are the next three
  double RMS = None;
  double HD95 = None;
  double HD = None;
  double SegmentationVolume = None; ///< milliliters
  double ReferenceVolume = None;
  std::string OverlapOf;  ///< "label map" or "voxelized mesh"
  std::string DistanceOf; ///< "surface of label map", "mesh" or "surface of voxelized mesh"
  std::vector<std::string> Warnings;
  /// False when the monitor stopped it; the numbers are then meaningless.
  bool Complete = false;
};

/// The voxels of one label of a label map, or of all, and its values.
struct LabelMask
{
  BitMask Mask;
  int Label = -1;
  LabelValues Values;
  std::string Name = "the label map"; ///< in messages
};

/// The voxels of a label, or all nonzero voxels for a negative one. Throws Error for a label map
/// without voxels or a proper grid, for a voxel that is not a finite number, where no voxel has the
/// label, unless it is negative, and for gray values. `property` is what chooses the label.
LabelMask LabelMaskOf(const LabelVolume& labels, int label, const std::string& property);

/// Both compare on a grid that holds segmentation and reference: what lies outside the grid of one
/// of them counts as not in it, with a warning if there is anything. A label map's voxels must be
/// the reference's, up to cropping and the order of axes (LatticePlacement.h). Both throw Error for
/// a setting that is not a number, a mask that is empty, label maps with other voxels, and a
/// surface that is open, encloses no voxel of the reference's grid, or would need too many samples.
SegmentationScores ScoreSurface(const PointList& points, const TriangleList& triangles,
  const LabelMask& reference, const ScoreSettings& settings, const ParallelFor& parallelFor,
  const Monitor& monitor);
SegmentationScores ScoreLabels(const LabelMask& segmentation, const LabelMask& reference,
  const ScoreSettings& settings, const ParallelFor& parallelFor, const Monitor& monitor);

} // namespace FlipFree

#endif

/**
 * Correspondence search (paper section 3.3, Eq. 2): from each vertex along its normal to the
 * boundary between feature and background. Beyond the paper, targets snap to the strongest edge.
 */
#ifndef FlipFreeCorrespondence_h
#define FlipFreeCorrespondence_h

#include "Image/BitMask.h"
#include "Image/EdgeRamp.h"
#include "Mesh/ContourMesh.h"

namespace FlipFree
{

/// The values of the array `Correspondence`.
enum class VertexState : unsigned char
{
  Solitary = 0, ///< no target
  Matched = 1,  ///< has a target
  Flipping = 2  ///< has a target that would flip an edge to a neighbor
};

struct CorrespondenceSettings
{
  /// Length of the search lines, in millimeters. TargetSettings derives it where it is zero.
  double SearchDistance = 0;

  /// Length of the run of consecutive voxels on the other side: in voxels (N + 1), or in
  /// millimeters if RunLength is positive.
  int RunVoxels = 4;
  double RunLength = 2;

  /// A vertex in the background looks inward for the foreground. Off: Eq. 2 read literally.
  bool SearchInward = true;

  /// A search line that leaves the image, or enters a place without data, within this distance, in
  /// millimeters, has its target there: an organ that the image cuts off has its boundary there.
  /// Zero: solitary.
  double ImageBoundaryDistance = 12;

  /// Standard deviation, in millimeters, of the Gaussian window around the crossing in which the
  /// target snaps to the strongest edge. Zero leaves the target on the voxel's face.
  double EdgeWindow = 3;

  /// Maps the intensities before edges are sought; only edges at which the mapped intensity falls
  /// outward are used.
  EdgeRamp Ramp;
};

struct CorrespondenceField
{
  PointList Displacements; ///< target minus point; zero where solitary
  std::vector<VertexState> States;
};

/// Searches all vertices. `normals` are unit vectors; `foreground` holds the voxels whose feature
/// is at or above its threshold (Gamma), and `noData` those without data, unless it is empty;
/// `edges` is the image in which targets are refined (may be the null view if EdgeWindow is zero).
/// All are on one grid.
CorrespondenceField FindCorrespondences(const Eigen::Ref<const PointList>& points,
  const PointList& normals, const BitMask& foreground, const BitMask& noData,
  const ImageView<float>& edges, const CorrespondenceSettings& settings,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

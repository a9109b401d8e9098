/**
 * Correspondence search (paper section 3.3, Eq. 2): from each vertex along its normal to the
 * boundary between feature and background.
 */
#ifndef FlipFreeCorrespondence_h
#define FlipFreeCorrespondence_h

#include "Image/BitMask.h"
#include "Image/EdgeRamp.h"
#include "Mesh/ContourMesh.h"

namespace FlipFree
{

/// What a vertex has found; the values of the array `Correspondence`.
enum class VertexState : unsigned char
{
  Solitary = 0, ///< no target
  Matched = 1,  ///< has a target
  Flipping = 2  ///< has a target that may not be reached together with its neighbors'
};

struct CorrespondenceSettings
{
  /// Length of the search lines, in millimeters. TargetSettings derives it where it is zero.
  double SearchDistance = 0;

  /// Length of the run of consecutive voxels on the other side: in voxels (N + 1), or, if the other
  /// one is positive, in millimeters.
  int RunVoxels = 4;
  double RunLength = 2;

  /// A vertex in the background looks inward for the foreground. Off: Eq. 2 read literally.
  bool SearchInward = true;

  /// A vertex this near to the image's end, in millimeters along its line, takes the end for its
  /// target: an organ that the image cuts has its boundary there. Zero: it is solitary.
  double ImageBoundaryDistance = 12;

  /// Where the strongest edge is looked for around the crossing: the deviation, in millimeters, of
  /// the Gaussian window that weighs it. Zero leaves the target on the voxel's face.
  double EdgeWindow = 3;

  /// How gray values are read there; edges count where it falls outward.
  EdgeRamp Ramp;
};

struct CorrespondenceField
{
  PointList Displacements; ///< target minus point; zero where solitary
  std::vector<VertexState> States;
};

/// Searches all vertices. `normals` are unit vectors; `foreground` are the voxels whose feature is
/// at or above its threshold (Gamma); `edges` is the gray image in which the target is refined (may
/// be the null view if EdgeWindow is zero), on the same grid.
CorrespondenceField FindCorrespondences(const PointList& points, const PointList& normals,
  const BitMask& foreground, const ImageView<float>& edges, const CorrespondenceSettings& settings,
  const ParallelFor& parallelFor);

} // namespace FlipFree

#endif

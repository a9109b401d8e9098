/**
 * One iteration's targets: normals, correspondence search, and steps beyond the paper: a cap on the
 * window in which the search snaps to the strongest edge (Correspondence.h), rejection of outliers,
 * and a limit to the displacements.
 */
#ifndef FlipFreeTargetSearch_h
#define FlipFreeTargetSearch_h

#include "Deformation/Correspondence.h"

namespace FlipFree
{

struct TargetSettings
{
  /// If its SearchDistance is zero, SearchScale applies; its EdgeWindow is capped at 1.5 voxels.
  CorrespondenceSettings Correspondence;

  /// Length of the search lines in radii of the organ (the seed's, until more is known), clamped to
  /// 15 to 60 mm; used if SearchDistance is zero.
  double SearchScale = 1.6;

  /// Averaging passes of the normals over neighbors.
  int NormalSmoothingIterations = 2;

  /// Targets farther from the median of the two-ring than this many robust standard deviations plus
  /// a voxel are dropped. Zero keeps all.
  double OutlierStandardDeviations = 3;

  /// In voxels of the largest spacing. Zero: unlimited.
  double MaximumDisplacement = 8;
};

/// The length of the search lines. It and `organRadius`, which is the seed's until more is known of
/// the organ, are in millimeters.
double SearchDistanceOf(const TargetSettings& settings, double organRadius);

/// The standard deviation of the window in which targets are refined, in millimeters.
double EdgeWindowOf(const TargetSettings& settings, const ImageGeometry& geometry);

struct TargetReport
{
  double MeanDistance = 0; ///< mm, over the matched vertices, before displacements are limited
  int Matched = 0;
  int Solitary = 0;
  int WithoutBoundary = 0; ///< solitary, as their search found none; the others were outliers
};

/// Makes the vertices solitary whose displacement along the normal is farther from the median of
/// their two-ring than `deviations` robust standard deviations plus `allowance` millimeters.
void RejectOutliers(const ContourMesh& mesh, const PointList& normals, double deviations,
  double allowance, const ParallelFor& parallelFor, CorrespondenceField& field);

/// Shortens displacements to at most `limit` millimeters.
void LimitDisplacements(double limit, CorrespondenceField& field);

/// Finds a target for every vertex that sees a boundary. The masks are those of
/// FindCorrespondences(). If `edges` is the null view, targets stay on the faces of voxels.
/// `organRadius` is as in SearchDistanceOf().
CorrespondenceField FindTargets(const ContourMesh& mesh, const Eigen::Ref<const PointList>& points,
  const BitMask& foreground, const BitMask& noData, const ImageView<float>& edges,
  double organRadius, const TargetSettings& settings, const ParallelFor& parallelFor,
  TargetReport& report);

} // namespace FlipFree

#endif

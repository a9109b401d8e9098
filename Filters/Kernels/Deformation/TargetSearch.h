/**
 * One iteration's targets: normals, correspondence search, and two remedies beyond the paper that
 * take back what the search found too boldly.
 */
#ifndef FlipFreeTargetSearch_h
#define FlipFreeTargetSearch_h

#include "Deformation/Correspondence.h"

namespace FlipFree
{

struct TargetSettings
{
  CorrespondenceSettings Correspondence;

  /// Passes of averaging over neighbors that the normals get.
  int NormalSmoothingIterations = 2;

  /// Targets farther from the two-ring's median than this many robust deviations, plus a voxel, are
  /// dropped; zero keeps all.
  double OutlierStandardDeviations = 3;

  /// Greatest displacement in millimeters; zero does not limit it.
  double MaximumDisplacement = 0;
};

struct TargetReport
{
  double MeanDistance = 0; ///< mm, over the matched vertices, before displacements are limited
  int Matched = 0;
  int Solitary = 0;
  int WithoutBoundary = 0; ///< of these, the ones whose search found none; the others were outliers
};

/// Makes the vertices solitary whose displacement along the normal is unlike those of their
/// two-ring: beyond `deviations` robust standard deviations plus `allowance` millimeters from the
/// median.
void RejectOutliers(const ContourMesh& mesh, const PointList& normals, double deviations,
  double allowance, const ParallelFor& parallelFor, CorrespondenceField& field);

/// Shortens displacements to at most `limit` millimeters.
void LimitDisplacements(double limit, CorrespondenceField& field);

CorrespondenceField FindTargets(const ContourMesh& mesh, const PointList& points,
  const BitMask& foreground, const ImageView<float>& edges, const TargetSettings& settings,
  const ParallelFor& parallelFor, TargetReport& report);

} // namespace FlipFree

#endif

/**
 * The distance of two surfaces.
 *
 * Both surfaces are sampled evenly. Each sample stands for a patch of area, and its distance to the
 * other surface's triangles is exact. Average and root mean square are taken over the pooled
 * samples of both surfaces, so the result is symmetric and independent of the triangulations.
 */
#ifndef FlipFreeSurfaceDistance_h
#define FlipFreeSurfaceDistance_h

#include "KernelTypes.h"

namespace FlipFree
{

/// All in millimeters.
struct SurfaceDistance
{
  double Average = 0;        ///< average symmetric surface distance (ASD), weighted by area
  double RootMeanSquare = 0; ///< over the same samples
  /// The 95th percentile over a surface's area; the maximum over both surfaces.
  double Hausdorff95 = 0;
  /// The maximum distance of any sample or vertex of either surface.
  double Hausdorff = 0;
  /// False when the monitor stopped the measurement; the numbers are then meaningless.
  bool Complete = false;
};

/// Neighboring samples of a triangle are at most sampleSpacing (mm) apart; small triangles have one
/// sample, and none has more than 512 x 512. Throws Error when a surface has no area or too large a
/// one, is not valid (RequireValidFaces), or would need more than a hundred million samples, or
/// when the spacing is not positive.
SurfaceDistance MeasureSurfaceDistance(const PointList& firstPoints,
  const TriangleList& firstTriangles, const PointList& secondPoints,
  const TriangleList& secondTriangles, double sampleSpacing = 1.0,
  const ParallelFor& parallelFor = SerialFor, const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif

/**
 * How far two surfaces lie apart.
 *
 * Both surfaces are sampled evenly, each sample standing for a patch of area; its distance is the
 * exact one to the other surface's triangles. Average and root mean square run over the pooled
 * samples of both surfaces, so that neither surface's number of triangles matters, and swapping the
 * two changes nothing. Spacing plays no role: coordinates are millimeters already.
 */
#ifndef FlipFreeSurfaceDistance_h
#define FlipFreeSurfaceDistance_h

#include "KernelTypes.h"

namespace FlipFree
{

/// All in millimeters.
struct SurfaceDistance
{
  double Average = 0;        ///< average symmetric surface distance (ASD)
  double RootMeanSquare = 0; ///< over the same samples
  /// The greater of the two distances that 95 % of a surface's area does not exceed.
  double Hausdorff95 = 0;
  /// The greatest distance of any sample or vertex of either surface.
  double Hausdorff = 0;
  /// False when the monitor stopped the measurement; the numbers are then meaningless.
  bool Complete = false;
};

/// Small triangles are sampled at their centroid, others on a lattice: neighboring samples of one
/// are at most sampleSpacing (mm) apart. Throws std::invalid_argument when a surface has no area,
/// is not valid (RequireValidFaces), or would need more than a hundred million samples, or when the
/// spacing is not positive.
SurfaceDistance MeasureSurfaceDistance(const PointList& firstPoints,
  const TriangleList& firstTriangles, const PointList& secondPoints,
  const TriangleList& secondTriangles, double sampleSpacing = 1.0,
  const ParallelFor& parallelFor = SerialFor, const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif

/**
 * The quality of a polygonal surface as a mesh for simulation: topology, shape of faces, dihedral
 * angles, evenness of edges.
 */
#ifndef FlipFreeSurfaceQuality_h
#define FlipFreeSurfaceQuality_h

#include "Mesh/SurfaceTopology.h"

namespace FlipFree
{

struct SurfaceQuality
{
  SurfaceTopology Topology;

  /// Per face, the minimum over its corners of the sine of the corner's angle, relative to that of
  /// a regular polygon and signed by its turn about the face's mean normal. 1 for a square or an
  /// equilateral triangle, 0 for a degenerate face, negative for a concave or twisted quad.
  std::vector<double> ScaledJacobians;
  double MinimumScaledJacobian = 0;
  double FirstPercentileScaledJacobian = 0;

  /// In degrees, between two triangles that share an edge, which may be the diagonal of a polygon:
  /// 180 if flat, 0 if folded back. Only edges of two consistently oriented faces count.
  double MinimumDihedralAngle = 180;

  /// Standard deviation of the edges' lengths over their mean.
  double EdgeLengthVariation = 0;
};

/// The surface must be valid (RequireValidFaces); it may be open.
SurfaceQuality MeasureQuality(const PointList& points, const FaceList& faces);

/// Per face, the number of corners whose normal differs from that at the reference positions by 90
/// degrees or more. A corner that is degenerate in either counts.
std::vector<int> CountFlippedCorners(const PointList& points, const PointList& reference,
  const FaceList& faces);

} // namespace FlipFree

#endif

/**
 * Whether a surface of polygons is fit for simulation: its topology, the shapes of its faces, the
 * angles between them, and the evenness of its edges.
 */
#ifndef FlipFreeSurfaceQuality_h
#define FlipFreeSurfaceQuality_h

#include "Mesh/SurfaceTopology.h"

namespace FlipFree
{

struct SurfaceQuality
{
  SurfaceTopology Topology;

  /// Per face, the least over its corners: the sine of the corner's angle over that of a regular
  /// polygon's, with the sign of its turn about the face's mean normal. 1 for a square or an
  /// equilateral triangle, 0 for a degenerate face, negative for a concave or twisted quad.
  std::vector<double> ScaledJacobians;
  double MinimumScaledJacobian = 0;
  double FirstPercentileScaledJacobian = 0; ///< that one face in a hundred does not exceed

  /// In degrees, between two triangles that share an edge, diagonals of polygons included: 180
  /// where flat, 0 where folded back. Edges that are not on two faces oriented alike do not count.
  double MinimumDihedralAngle = 180;

  /// Standard deviation of the edges' lengths over their mean.
  double EdgeLengthVariation = 0;
};

/// The surface must be valid (RequireValidFaces); it may be open.
SurfaceQuality MeasureQuality(const PointList& points, const FaceList& faces);

/// Per face, the number of corners whose normal has turned by 90 degrees or more since the
/// reference positions of the same vertices. A corner without area in either counts.
std::vector<int> CountFlippedCorners(const PointList& points, const PointList& reference,
  const FaceList& faces);

} // namespace FlipFree

#endif

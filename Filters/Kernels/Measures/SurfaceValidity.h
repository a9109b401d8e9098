/**
 * Whether a surface of polygons is a valid one, and which of its faces are not: closed, oriented,
 * free of self-intersections and of flipped corners.
 */
#ifndef FlipFreeSurfaceValidity_h
#define FlipFreeSurfaceValidity_h

#include "Measures/SurfaceQuality.h"

namespace FlipFree
{

struct SurfaceValidity
{
  /// What is wrong with a face; several add up.
  enum Defect : unsigned char
  {
    SelfIntersecting = 1,
    FlippedCorner = 2,
    BoundaryEdge = 4,
    BadEdge = 8 ///< of three faces or more, or of two that are oriented differently
  };

  SurfaceQuality Quality;
  std::vector<unsigned char> Defects; ///< per face
  int SelfIntersections = 0;          ///< pairs of triangles
  int FlippedCorners = -1;            ///< -1 without a reference
  double MinimumGap = 0;              ///< 0 where there are self-intersections
  /// False when the monitor stopped the measurement; the numbers are then meaningless.
  bool Complete = false;

  bool IsValid() const
  {
    const SurfaceTopology& topology = this->Quality.Topology;
    return topology.BoundaryEdges + topology.NonManifoldEdges + topology.MisorientedEdges == 0 &&
      this->SelfIntersections == 0 && this->FlippedCorners <= 0;
  }
};

/// Flipped corners are counted against the reference positions of the same vertices, if there are
/// any. The surface must be valid in the sense of RequireValidFaces.
SurfaceValidity MeasureValidity(const PointList& points, const FaceList& faces,
  const PointList* reference, const ParallelFor& parallelFor = SerialFor,
  const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif

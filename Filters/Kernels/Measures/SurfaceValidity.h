/**
 * Whether a polygonal surface is valid (closed, consistently oriented, free of self-intersections
 * and flipped corners), and the faces that violate it.
 */
#ifndef FlipFreeSurfaceValidity_h
#define FlipFreeSurfaceValidity_h

#include "Measures/SurfaceQuality.h"

namespace FlipFree
{

struct SurfaceValidity
{
  /// Bits of the defects of a face.
  enum Defect : unsigned char
  {
    SelfIntersecting = 1,
    FlippedCorner = 2,
    BoundaryEdge = 4,
    BadEdge = 8 ///< of three faces or more, or of two that are oriented inconsistently
  };

  SurfaceQuality Quality;
  std::vector<unsigned char> Defects; ///< per face
  int SelfIntersections = 0;          ///< pairs of faces, for any cut
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

/// Flipped corners are counted only if there are reference positions of the vertices. The faces
/// must be valid (RequireValidFaces).
SurfaceValidity MeasureValidity(const PointList& points, const FaceList& faces,
  const PointList* reference, const ParallelFor& parallelFor = SerialFor,
  const Monitor& monitor = NeverStop);

} // namespace FlipFree

#endif

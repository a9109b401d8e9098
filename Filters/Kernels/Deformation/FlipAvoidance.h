/**
 * Flip detection and avoidance (paper sections 3.4 and 3.5, Eq. 3), contour by contour.
 */
#ifndef FlipFreeFlipAvoidance_h
#define FlipFreeFlipAvoidance_h

#include "Deformation/Correspondence.h"

namespace FlipFree
{

/// Marks the vertices whose targets flip the edge to the next non-solitary vertex of a contour: the
/// unit vectors of u_i - u_j and v_i - v_j have a dot product below r, or the targets coincide.
/// Returns their number. Clears earlier marks.
int DetectFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field);

/// Makes all but the middle vertex of each run of flipping vertices solitary, and repeats this
/// until nothing flips. Returns how many vertices lost their target.
int AvoidFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field);

} // namespace FlipFree

#endif

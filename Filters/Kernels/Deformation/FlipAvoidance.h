/**
 * Flip detection and avoidance (paper sections 3.4 and 3.5, Eq. 3), contour by contour.
 */
#ifndef FlipFreeFlipAvoidance_h
#define FlipFreeFlipAvoidance_h

#include "Deformation/Correspondence.h"

namespace FlipFree
{

/// Marks the vertices whose targets would turn the edge to the next non-solitary vertex of a
/// contour: those for which the unit vectors of u_i - u_j and v_i - v_j have a dot product below r,
/// and those whose targets coincide. Returns how many it marked; marks of a former call are
/// cleared.
int DetectFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field);

/// Makes flipping vertices solitary, all but the middle one of each run on a contour, and repeats
/// until nothing flips. Returns the number of vertices that lost their target.
int AvoidFlips(const ContourMesh& mesh, const PointList& points, double r,
  CorrespondenceField& field);

} // namespace FlipFree

#endif

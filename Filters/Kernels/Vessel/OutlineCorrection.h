/**
 * Moves the outline of a vessel to where a user says that it is: past the points inside, before
 * those outside, to those on the boundary.
 */
#ifndef FlipFreeOutlineCorrection_h
#define FlipFreeOutlineCorrection_h

#include "Image/PointConstraint.h"
#include "Vessel/VesselPath.h"

namespace FlipFree
{

/// Each point moves the outline of the nearest section, and less so the outline near it: by a
/// Gaussian of about the vessel's radius. Points whose side is right move nothing. The surface
/// obeys exactly only under the ConstraintEnforcer, which has little to do then.
void CorrectOutline(const ConstraintList& constraints, VesselTree& tree);

} // namespace FlipFree

#endif

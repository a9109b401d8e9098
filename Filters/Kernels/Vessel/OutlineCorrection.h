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
/// obeys exactly only under the ConstraintEnforcer, which has little to do then. Throws Error,
/// naming the point, for one inside or on the boundary that is farther from every section's center
/// than three times its mean radius and 10 mm.
void CorrectOutline(const ConstraintList& constraints, VesselTree& tree);

} // namespace FlipFree

#endif

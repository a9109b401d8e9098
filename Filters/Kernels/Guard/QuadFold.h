/**
 * Quads that are folded so sharply that a program that cuts them may consider them invalid.
 *
 * A quad is folded if the normal of one of its corners points away from the normal of the whole:
 * seen along that normal, the quad is not convex. VTK's triangulation, for one, then omits one or
 * both triangles, which leaves the surface open.
 */
#ifndef FlipFreeQuadFold_h
#define FlipFreeQuadFold_h

#include "Guard/MotionTest.h"

namespace FlipFree
{

/// The faces of four corners, in their order.
std::vector<Hull> ListQuads(const FaceList& faces);

/// Whether the quad of these vertices, in order, is folded or degenerate.
bool IsFolded(const PointList& points, const Hull& quad);

/// A time until which a quad that is not folded at the start is proven to stay so. 1 if that is
/// proven throughout, and for a quad that is folded at the start or at rest.
double TimeOfFold(const Motion& motion, const Hull& quad);

} // namespace FlipFree

#endif

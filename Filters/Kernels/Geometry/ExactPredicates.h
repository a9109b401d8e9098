/**
 * The sign of a determinant of coordinates, without rounding error: a double evaluation with a
 * bound on its error first and, only where that cannot tell, exact expansion arithmetic
 * (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
 * predicates", 1997). Exact for coordinates that are zero or from 1e-91 to 1e100: they are
 * multiples of 2^-358, so that no product of three differences has bits below the least double,
 * 2^-1074, and none overflows.
 */
#ifndef FlipFreeExactPredicates_h
#define FlipFreeExactPredicates_h

namespace FlipFree
{

/// +1 when d lies below the plane through a, b, c (which is counter-clockwise seen from above), -1
/// when above, 0 when the four points are coplanar.
int Orientation3D(const double* a, const double* b, const double* c, const double* d);

/// +1 when a, b, c turn counter-clockwise in the plane of the coordinates `x` and `y`, -1 when
/// clockwise, 0 when they are collinear there.
int Orientation2D(const double* a, const double* b, const double* c, int x, int y);

} // namespace FlipFree

#endif

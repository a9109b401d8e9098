/**
 * Solids as signed distance bounds, from which phantoms are composed: primitives and the set
 * operations on them.
 *
 * The sampler relies on this contract: a shape's value is negative inside, positive outside, and
 * its magnitude never exceeds the distance to the surface. A ball of radius |value| around a point
 * is thus entirely inside or entirely outside. "Exact distance" marks shapes whose value is the
 * signed distance itself.
 */
#ifndef FlipFreeImplicitShape_h
#define FlipFreeImplicitShape_h

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace FlipFree
{

/// Millimeters in, millimeters out.
using ImplicitShape = std::function<double(const Eigen::Vector3d& point)>;

/// Exact distance.
ImplicitShape MakeSphere(const Eigen::Vector3d& center, double radius);

/// An axis-parallel box with edges rounded by `rounding`; exact distance.
ImplicitShape MakeBox(const Eigen::Vector3d& center, const Eigen::Vector3d& halfEdges,
  double rounding = 0);

/// An ellipsoid whose axes are the columns of `axes`; the value is exact on the surface and at the
/// center, elsewhere a lower bound.
ImplicitShape MakeEllipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii,
  const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());

/// An infinite elliptic cylinder along z; values as those of the ellipsoid.
ImplicitShape MakeEllipticCylinder(const Eigen::Vector2d& center, const Eigen::Vector2d& radii);

/// An infinite rectangular column along z, its four edges rounded by `rounding`; exact distance.
ImplicitShape MakeColumn(const Eigen::Vector2d& center, const Eigen::Vector2d& halfEdges,
  double rounding);

/// The half space where normal . (point - origin) < 0; the normal has unit length. Exact distance.
ImplicitShape MakeHalfSpace(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal);

/// A round tube along a polyline, with spherical ends and a radius that runs linearly between the
/// points. Exact distance outside (and, but for sharp bends, inside) where the radius is constant.
ImplicitShape MakeTube(const std::vector<Eigen::Vector3d>& centerline,
  const std::vector<double>& radii);

/// The same along the Catmull-Rom spline through the points.
ImplicitShape MakeSplineTube(const std::vector<Eigen::Vector3d>& points,
  const std::vector<double>& radii);

/// A cup that opens along +z: the wall of thickness 2 halfWall around a half sphere of `radius`
/// below `center` and a cylinder of `height` above it, its rim rounded. Exact distance.
ImplicitShape MakeCup(const Eigen::Vector3d& center, double radius, double halfWall, double height);

/// A tube along a half circle of `bendRadius` in the xz plane below `center` and two legs of length
/// `leg` upwards from its ends, which are round. Exact distance.
ImplicitShape MakeUTube(const Eigen::Vector3d& center, double bendRadius, double tubeRadius,
  double leg);

/// The union of one shape or more.
ImplicitShape Unite(std::vector<ImplicitShape> shapes);

/// The union, with a fillet where two surfaces are closer than `blend` mm.
ImplicitShape SmoothUnite(std::vector<ImplicitShape> shapes, double blend);

/// The intersection of one shape or more.
ImplicitShape Intersect(std::vector<ImplicitShape> shapes);

/// The intersection, its edges rounded by about `blend` mm.
ImplicitShape SmoothIntersect(std::vector<ImplicitShape> shapes, double blend);

/// The rest of space.
ImplicitShape Complement(ImplicitShape shape);

/// The shape grown by `distance` mm (shrunk where negative), as far as its value is the distance.
ImplicitShape Grow(ImplicitShape shape, double distance);

/// Moves a point near a surface onto it, by Newton's method along the gradient, which is a central
/// difference over `step` mm.
Eigen::Vector3d ProjectOntoSurface(const ImplicitShape& shape, Eigen::Vector3d point, double step);

} // namespace FlipFree

#endif

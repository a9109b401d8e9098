/**
 * Makes a deforming surface obey points that must lie inside, outside, or on it, by certified steps
 * alone.
 *
 * An inside point is an obstacle of the guard once the surface has enclosed it, an outside point
 * from the start or from the last level on. If, at the end, the image has not brought a point to
 * its side of the surface, or onto the surface, the surface is pulled toward the point, step by
 * step under the guard.
 */
#ifndef FlipFreeConstraintEnforcer_h
#define FlipFreeConstraintEnforcer_h

#include "Geometry/WindingNumber.h"
#include "Guard/EmbeddingGuard.h"
#include "Image/PointConstraint.h"

#include <functional>

namespace FlipFree
{

/// Moves the surface by as much of a motion as is safe, and returns where its vertices end.
/// `obstacles` are the enforcer's.
using GuardedStep =
  std::function<PointList(const PointList& obstacles, const PointList& points, PointList& motion)>;

class ConstraintEnforcer
{
public:
  /// `spacing` is the image's smallest, in millimeters: the surface ends within half of it of every
  /// boundary point.
  ConstraintEnforcer(const ConstraintList& constraints, double spacing,
    OutsidePoints outside = OutsidePoints::FromTheStart);

  /// Begins with an embedded surface; the hulls are of its faces. Throws Error, naming the point,
  /// if an outside point lies in it or on it where it must not.
  void Begin(const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points);

  /// Looks which inside points the surface encloses by now, and makes obstacles of them.
  void Update(const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points);

  /// What the surface must not pass from now on, one row each.
  const PointList& GetObstacles() const { return this->Obstacles; }

  /// Before the last level: pulls the surface back from outside points that may be passed until
  /// then, and makes obstacles of them. Otherwise as Finish().
  bool PullBack(const ContourMesh& mesh, const FaceHulls& hulls, const GuardedStep& step,
    const Monitor& monitor, PointList& points);

  /// Pulls the surface toward the points that it does not obey yet, by guarded steps; the hulls are
  /// of the mesh's faces. Returns false if the monitor stopped it. Throws Error, naming the point,
  /// if one cannot be obeyed.
  bool Finish(const ContourMesh& mesh, const FaceHulls& hulls, const GuardedStep& step,
    const Monitor& monitor, PointList& points);

private:
  void MakeObstacles(const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points,
    bool withOutside);
  bool Pull(bool outsideOnly, const ContourMesh& mesh, const FaceHulls& hulls,
    const GuardedStep& step, const Monitor& monitor, PointList& points);
  std::vector<const PointConstraint*> OpenOf(const std::vector<const PointConstraint*>& constraints,
    const ContourMesh& mesh, const FaceHulls& hulls, const PointList& points) const;
  /// Returns how far a vertex has moved at most.
  double PullTogether(const std::vector<const PointConstraint*>& constraints,
    const ContourMesh& mesh, const GuardedStep& step, PointList& points) const;
  bool IsOpen(const PointConstraint& constraint, const ContourMesh& mesh, const FaceHulls& hulls,
    const PointList& points) const;
  Eigen::Vector3d PullOf(const PointConstraint& constraint, const ContourMesh& mesh,
    const PointList& points, const SurfacePlace& place) const;

  ConstraintList Constraints;
  std::vector<bool> IsObstacle; // per constraint
  PointList Obstacles = PointList(0, 3);
  const double Spacing;
  bool MayPassOutside; ///< outside points
  const bool MayBeginAround;
};

} // namespace FlipFree

#endif

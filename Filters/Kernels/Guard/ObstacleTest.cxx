#include "Guard/ObstacleTest.h"

#include "Geometry/ClosestDirection.h"

#include <algorithm>

namespace FlipFree
{
namespace
{

HullCorners CornersOf(const PointList& points, const Hull& hull)
{
  return { { points.row(hull[0]), points.row(hull[1]), points.row(hull[2]), points.row(hull[3]) } };
}

} // namespace

double TimeToObstacle(const Motion& motion, const Hull& hull, const Eigen::Vector3d& obstacle,
  const MinimumDistance& distance)
{
  PointList from(5, 3);
  PointList to(5, 3);
  for (int corner = 0; corner < 4; ++corner)
  {
    from.row(corner) = motion.From.row(hull[corner]);
    to.row(corner) = motion.To.row(hull[corner]);
  }
  from.row(4) = obstacle.transpose();
  to.row(4) = obstacle.transpose();
  return TimeOfImpact(Motion{ from, to }, Hull{ { 0, 1, 2, 3 } }, Hull{ { 4, 4, 4, 4 } }, distance);
}

// Along an axis, the hull stays between the least and the greatest coordinate at both ends.
//
// Rounding: only the two sums are rounded, to u = 2^-53 of themselves, so that of the gap all but
// u (X + gap) is kept, X being the hull's greatest coordinate at either end. The gaps of the guard
// and of the refinement are about 1e-12 X or more, so they lose less than a thousandth. The
// obstacle's own coordinates are compared as they are, however great. One that is not passed over
// lies within the gap of the hull's box, so its coordinates are at most X + gap, and the bound of
// MotionTest.h holds for it, too.
bool MayComeNear(const Motion& motion, const Hull& hull, const Eigen::Vector3d& obstacle,
  double gap)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = motion.From(hull[0], axis);
    double high = low;
    for (const int corner : hull)
    {
      low = std::min({ low, motion.From(corner, axis), motion.To(corner, axis) });
      high = std::max({ high, motion.From(corner, axis), motion.To(corner, axis) });
    }
    if (obstacle[axis] < low - gap || obstacle[axis] > high + gap)
    {
      return false;
    }
  }
  return true;
}

std::vector<Hull> HullsNearerThan(double gap, const PointList& points, const FaceHulls& hulls,
  const Eigen::Vector3d& obstacle)
{
  std::vector<Hull> near;
  const HullCorners point{ { obstacle, obstacle, obstacle, obstacle } };
  for (int index = 0; index < hulls.NumberOfHulls(); ++index)
  {
    const Hull hull = hulls.HullAt(index);
    if (!MayComeNear({ points, points }, hull, obstacle, gap))
    {
      continue;
    }
    if (!(ProvenDistance(CornersOf(points, hull), point) >= gap))
    {
      near.push_back(hull);
    }
  }
  return near;
}

} // namespace FlipFree

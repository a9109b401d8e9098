/**
 * How far surfaces lie apart, for tests of what corrections move.
 */
#ifndef FlipFreeSurfaceMotion_h
#define FlipFreeSurfaceMotion_h

#include "Deformation/OrganSegmentation.h"
#include "Geometry/WindingNumber.h"

#include <gtest/gtest.h>

namespace FlipFree
{

/// How far a surface is from another one, in the mean of its vertices for which `counts` is true;
/// of these, more than the minimum count are expected.
template <typename Counts>
double MeanMotion(const OrganSurface& surface, const OrganSurface& other, int minimumCount,
  const Counts& counts)
{
  const PointList places =
    ClosestPlaces(other.Points, other.Mesh.Triangles, surface.Points, SerialFor);
  double sum = 0;
  int count = 0;
  for (Eigen::Index vertex = 0; vertex < surface.Points.rows(); ++vertex)
  {
    if (counts(Eigen::Vector3d(surface.Points.row(vertex).transpose())))
    {
      sum += (places.row(vertex) - surface.Points.row(vertex)).norm();
      ++count;
    }
  }
  EXPECT_GT(count, minimumCount);
  return sum / count;
}

/// The same, of the vertices farther than 30 mm from a point.
inline double MotionBeyond(const Eigen::Vector3d& point, const OrganSurface& surface,
  const OrganSurface& other, int minimumCount)
{
  return MeanMotion(surface, other, minimumCount,
    [&](const Eigen::Vector3d& at) { return (at - point).norm() > 30; });
}

} // namespace FlipFree

#endif

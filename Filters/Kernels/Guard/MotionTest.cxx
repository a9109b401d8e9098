#include "Guard/MotionTest.h"

#include "Geometry/ClosestDirection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Of the motion: the search ends with a step shorter than this, the parts being about to touch.
constexpr double MinimumAdvance = 0.01;

// Parts that are nearer than wanted at the start keep this fraction of their distance; keeping all
// of it would leave no room for rounding.
constexpr double KeptFraction = 1 - 1e-6;

// Relative to the square of the greatest length, well above the rounding errors of a normal.
constexpr double NormalError = 1e-12;

// The greatest error of a normal whose edges are at most 1 long. With u = 2^-53 and
// gamma_n = n u / (1 - n u): a component of an edge is rounded twice, by its subtraction and its
// division, so that each product of two carries four roundings, its own, and that of the
// difference. A component of the normal is off by at most gamma_6 (|a_j b_k| + |a_k b_j|), and the
// normal by sqrt(2) gamma_6 |a| |b| < 9.5e-16.
constexpr double CrossError = 2e-15;

template <std::size_t N>
bool AreAtRest(const Motion& motion, const std::array<int, N>& vertices)
{
  return std::all_of(vertices.begin(), vertices.end(),
    [&](int vertex) { return motion.IsAtRest(vertex); });
}

HullCorners CornersAt(const Motion& motion, const Hull& hull, double time)
{
  return { { motion.At(hull[0], time), motion.At(hull[1], time), motion.At(hull[2], time),
    motion.At(hull[3], time) } };
}

// Where corners lie along a direction.
struct Projection
{
  Projection(const HullCorners& corners, const Vector3d& direction)
  {
    for (int i = 0; i < 4; ++i)
    {
      this->Places[i] = corners[i].dot(direction);
    }
  }
  double Low() const { return this->Places.minCoeff(); }
  double High() const { return this->Places.maxCoeff(); }

  Eigen::Array4d Places;
};

// The component of the normal along the first one is quadratic in time, and positive if its three
// Bernstein coefficients are. That decides nearly all corners without a square root. The
// coefficients are sums of products of four edge components. Each product is rounded at most twelve
// times: four edges, two in each of the two normals, the sum of two of these, and three in the dot
// product. The absolute products sum up to at most 4 times the fourth power of the longest edge,
// the errors to 4 gamma_12 times that, which is below 1e-14.
bool StaysClearlyUpright(const Motion& motion, const std::array<int, 3>& corner)
{
  const auto edge = [&](const PointList& points, int end) -> Vector3d
  { return (points.row(corner[end]) - points.row(corner[1])).transpose(); };
  const Vector3d a = edge(motion.From, 2);
  const Vector3d b = edge(motion.From, 0);
  const Vector3d c = edge(motion.To, 2);
  const Vector3d d = edge(motion.To, 0);
  const double greatest =
    std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm(), d.squaredNorm() });
  const double error = 4 * NormalError * greatest * greatest;
  const Vector3d normal = a.cross(b);
  // Within these bounds, no product underflows or overflows.
  return greatest > 1e-60 && greatest < 1e60 && normal.squaredNorm() > error &&
    normal.dot(a.cross(d) + c.cross(b)) > error && normal.dot(c.cross(d)) > error;
}

} // namespace

// Conservative advancement: the direction between the closest points proves that the parts are
// apart until some time; the next direction is taken at the positions of that time.
double TimeOfImpact(const Motion& motion, const Hull& one, const Hull& two,
  const MinimumDistance& distance, double maximumTime)
{
  if (AreAtRest(motion, one) && AreAtRest(motion, two))
  {
    return 1;
  }
  const HullCorners oneEnd = CornersAt(motion, one, 1);
  const HullCorners twoEnd = CornersAt(motion, two, 1);
  double time = 0;
  double kept = distance.Wanted;
  while (true)
  {
    const HullCorners oneNow = CornersAt(motion, one, time);
    const HullCorners twoNow = CornersAt(motion, two, time);
    const Vector3d direction = ClosestDirection(oneNow, twoNow).normalized();

    const Projection oneBefore(oneNow, direction);
    const Projection twoBefore(twoNow, direction);
    const double separation = oneBefore.Low() - twoBefore.High();
    if (time == 0)
    {
      kept = std::min(distance.Wanted, KeptFraction * separation);
    }
    if (!(kept >= distance.Resolution && kept > 0))
    {
      return -1;
    }
    if (!(separation >= kept) || time >= maximumTime)
    {
      return time;
    }

    const Projection oneAfter(oneEnd, direction);
    const Projection twoAfter(twoEnd, direction);
    if (oneAfter.Low() - twoAfter.High() >= kept)
    {
      return 1;
    }
    // The earliest time at which two vertices are nearer than `kept` along the direction.
    double reached = 1;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        const double end = oneAfter.Places[i] - twoAfter.Places[j];
        if (!(end >= kept))
        {
          const double now = oneBefore.Places[i] - twoBefore.Places[j];
          reached = std::min(reached, (now - kept) / (now - end));
        }
      }
    }
    const double advance = (1 - time) * reached;
    if (!(advance > 0))
    {
      return time;
    }
    time += advance;
    if (advance <= MinimumAdvance)
    {
      return time;
    }
  }
}

double TimeOfFlip(const Motion& motion, const std::array<int, 3>& corner)
{
  if (StaysClearlyUpright(motion, corner) || AreAtRest(motion, corner))
  {
    return 1;
  }
  Vector3d edges[2][2];
  double greatest = 0;
  for (int end = 0; end < 2; ++end)
  {
    const PointList& points = end == 0 ? motion.From : motion.To;
    const Vector3d vertex = points.row(corner[1]);
    edges[end][0] = points.row(corner[2]).transpose() - vertex;
    edges[end][1] = points.row(corner[0]).transpose() - vertex;
    greatest = std::max({ greatest, edges[end][0].norm(), edges[end][1].norm() });
  }
  if (greatest == 0)
  {
    return 1;
  }
  for (auto& pair : edges)
  {
    pair[0] /= greatest; // so that no product underflows
    pair[1] /= greatest;
  }
  const Vector3d normal = edges[0][0].cross(edges[0][1]);
  const double length = normal.norm();
  if (length <= NormalError)
  {
    return 1;
  }
  // The component of the normal along the first one, less what rounding may make of it, is
  // b0 (1 - t)^2 + 2 b1 t (1 - t) + b2 t^2. The error of the first normal counts in proportion to
  // the other one: that of a sliver says little about where its normal points. The rest, of the
  // other normal (sqrt(2) gamma_7), of the product (gamma_3) and of the two subtractions (3 u), is
  // below 2e-15 of the first. In b0, the first normal counts twice: below 3e-15 of it.
  const double error = NormalError * length;
  const Vector3d middle = 0.5 * (edges[0][0].cross(edges[1][1]) + edges[1][0].cross(edges[0][1]));
  const Vector3d last = edges[1][0].cross(edges[1][1]);
  const double b0 = length * length - error;
  const double b1 = normal.dot(middle) - error - CrossError * middle.norm();
  const double b2 = normal.dot(last) - error - CrossError * last.norm();
  // What is rounded from here on lets the polynomial fall to -14 u L at most before the time
  // returned. That is 1.6e-15 L, L being the length, and 1e-12 L has been taken off. Proof, to
  // first order in u: edges are at most 1 long, but for rounding, so L <= 1, 0 <= b0 <= L^2, and b1
  // and b2 are at most 1.01 L.
  //
  // The discriminant D is computed as (b1^2 (1 + d1) - b0 b2 (1 + d2)) (1 + d3), each |d| being at
  // most u, also where the compiler fuses operations. If that is negative, the polynomial has no
  // zero once b1 is changed by u |b1|. Otherwise the root r is such that r^2 differs from D by at
  // most 4 u M^2, M^2 being b1^2 for b2 > 0, and D else. (If D itself is negative, there is no zero
  // at all.) Both formulas then give, in exact arithmetic, the first zero of the polynomial whose
  // b1 is changed by |r^2 - D| / (2 (|b1| + r)) <= 2 u M < 3 u L.
  //
  // The sum and the quotient change the ratio by 2 u of itself, and the time by u / 2; the last sum
  // and quotient change the time by 2 u. The slope is at most 4.1 L, so that makes 10.3 u L.
  // Products that underflow change the polynomial by less than 1e-150. (The guard relies only on
  // whether the time is 1: a motion that it shortens is tested again.)
  const double discriminant = b1 * b1 - b0 * b2;
  if (b2 > 0 && (b1 >= 0 || discriminant < 0))
  {
    return 1;
  }
  // The first zero as t / (1 - t), without cancellation: for a corner that is thin at both ends and
  // wide in between, b1 is so large that b0 and b2 would be lost beside it.
  const double root = std::sqrt(std::max(0.0, discriminant));
  const double ratio = b1 < 0 ? b0 / (root - b1) : (root + b1) / -b2;
  const double time = std::isfinite(ratio) ? ratio / (1 + ratio) : 1;
  return std::min(time, std::nextafter(1.0, 0.0));
}

} // namespace FlipFree

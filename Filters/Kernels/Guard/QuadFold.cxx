#include "Guard/QuadFold.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace FlipFree
{
namespace
{

using Eigen::Vector3d;

// Relative to the fourth power of the longest side L: well above the rounding errors of the product
// of two normals. With u = 2^-53: a coefficient is a sum of products of four components of sides,
// each rounded at most 18 times (four sides, two diagonals, two in each of the two normals, a sum
// of two of these in each, three in a dot product, three in a sum of three of those). The absolute
// products sum up to at most 8 L^4: sqrt(2) L^2 for the corner's normal, sqrt(2) (2 L)^2 for that
// of the diagonals. Seven halvings of the interval take means, by four roundings each. That is at
// most 8 (18 + 28) u L^4 = 4.1e-14 L^4.
constexpr double ProductError = 1e-11;

// Intervals of time are halved down to this.
constexpr double MinimumInterval = 1.0 / 128;

// In Bernstein form over the unit interval: positive where all coefficients are.
using Quadratic = std::array<Vector3d, 3>;
using Quartic = std::array<double, 5>;

using Sides = std::array<Vector3d, 4>;

Sides SidesOf(const PointList& points, const Hull& quad)
{
  Sides sides;
  for (int i = 0; i < 4; ++i)
  {
    sides[i] = points.row(quad[(i + 1) % 4]) - points.row(quad[i]);
  }
  return sides;
}

double LongestSquare(const Sides& sides)
{
  double longest = 0;
  for (const Vector3d& side : sides)
  {
    longest = std::max(longest, side.squaredNorm());
  }
  return longest;
}

// Vectors that change linearly in time have a cross product that is quadratic in it.
inline Quadratic Cross(const Vector3d& oneStart, const Vector3d& oneEnd, const Vector3d& twoStart,
  const Vector3d& twoEnd)
{
  return { { oneStart.cross(twoStart), 0.5 * (oneStart.cross(twoEnd) + oneEnd.cross(twoStart)),
    oneEnd.cross(twoEnd) } };
}

Quartic Dot(const Quadratic& one, const Quadratic& two)
{
  return { { one[0].dot(two[0]), 0.5 * (one[0].dot(two[1]) + one[1].dot(two[0])),
    (one[0].dot(two[2]) + 4 * one[1].dot(two[1]) + one[2].dot(two[0])) / 6,
    0.5 * (one[1].dot(two[2]) + one[2].dot(two[1])), one[2].dot(two[2]) } };
}

bool IsAbove(const Quartic& coefficients, double bound)
{
  return std::all_of(coefficients.begin(), coefficients.end(),
    [bound](double coefficient) { return coefficient > bound; });
}

// The time until which the polynomial is proven to be above the bound, at which it starts.
double TimeAbove(const Quartic& whole, double bound)
{
  if (IsAbove(whole, bound))
  {
    return 1;
  }
  double time = 0;
  double length = 1;
  Quartic rest = whole; // from `time` to the end of the interval
  while (length > MinimumInterval)
  {
    // De Casteljau's halves.
    Quartic left;
    Quartic right = rest;
    for (int step = 0; step < 5; ++step)
    {
      left[step] = right[0];
      for (int i = 0; i + step < 4; ++i)
      {
        right[i] = 0.5 * (right[i] + right[i + 1]);
      }
    }
    length /= 2;
    if (!IsAbove(left, bound))
    {
      rest = left;
      continue;
    }
    time += length;
    if (IsAbove(right, bound))
    {
      return time + length; // the end of the interval; nothing is claimed beyond it
    }
    rest = right;
  }
  return time;
}

} // namespace

std::vector<Hull> ListQuads(const FaceList& faces)
{
  std::vector<Hull> quads;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    if (faces.FaceSize(face) == 4)
    {
      const int* const v = faces.Face(face);
      quads.push_back({ { v[0], v[1], v[2], v[3] } });
    }
  }
  return quads;
}

bool IsFolded(const PointList& points, const Hull& quad)
{
  const Sides sides = SidesOf(points, quad);
  const Vector3d normal = (sides[0] + sides[1]).cross(sides[1] + sides[2]);
  const double longest = LongestSquare(sides);
  for (int corner = 0; corner < 4; ++corner)
  {
    if (!(sides[(corner + 3) % 4].cross(sides[corner]).dot(normal) >
          ProductError * longest * longest))
    {
      return true;
    }
  }
  return false;
}

double TimeOfFold(const Motion& motion, const Hull& quad)
{
  const Sides start = SidesOf(motion.From, quad);
  const Sides end = SidesOf(motion.To, quad);
  if (start == end)
  {
    return 1;
  }
  const double longestAtStart = LongestSquare(start);
  const double longest = std::max(longestAtStart, LongestSquare(end));
  const double bound = ProductError * longest * longest;
  const Quadratic normal =
    Cross(start[0] + start[1], end[0] + end[1], start[1] + start[2], end[1] + end[2]);
  std::array<Quartic, 4> products;
  double time = 1;
  for (int corner = 0; corner < 4; ++corner)
  {
    const int before = (corner + 3) % 4;
    products[corner] = Dot(Cross(start[before], end[before], start[corner], end[corner]), normal);
    if (!(products[corner][0] > ProductError * longestAtStart * longestAtStart))
    {
      return 1; // folded at the start
    }
    if (!(products[corner][0] > bound))
    {
      time = 0; // too long a motion to tell
    }
  }
  for (const Quartic& product : products)
  {
    time = time > 0 ? std::min(time, TimeAbove(product, bound)) : 0;
  }
  return time;
}

} // namespace FlipFree

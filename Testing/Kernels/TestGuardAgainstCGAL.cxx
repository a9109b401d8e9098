// The guard's bounds on rounding errors, against exact arithmetic, at the limits of what it
// accepts.
#include "AdverseMotions.h"
#include "FindWithCGAL.h"
#include "Geometry/ExactPredicates.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/QuadFold.h"

#include <CGAL/Exact_rational.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

using Exact = CGAL::Exact_rational;
using ExactVector = std::array<Exact, 3>;

ExactVector ExactDifference(const double* a, const double* b)
{
  return { { Exact(a[0]) - Exact(b[0]), Exact(a[1]) - Exact(b[1]), Exact(a[2]) - Exact(b[2]) } };
}

ExactVector ExactSum(const ExactVector& a, const ExactVector& b)
{
  return { { a[0] + b[0], a[1] + b[1], a[2] + b[2] } };
}

ExactVector ExactCross(const ExactVector& a, const ExactVector& b)
{
  return { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] } };
}

Exact ExactDot(const ExactVector& a, const ExactVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int SignOf(const Exact& value)
{
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

int ExactSideOf(const PointList& points)
{
  const auto fromLast = [&](int i)
  { return ExactDifference(points.row(i).data(), points.row(3).data()); };
  return SignOf(ExactDot(ExactCross(fromLast(0), fromLast(1)), fromLast(2)));
}

int ExactTurnOf(const PointList& points, int x, int y)
{
  const auto fromLast = [&](int i)
  { return ExactDifference(points.row(i).data(), points.row(2).data()); };
  const ExactVector a = fromLast(0);
  const ExactVector b = fromLast(1);
  return SignOf(Exact(a[x] * b[y] - a[y] * b[x]));
}

double PlainDeterminant(const PointList& points)
{
  const Eigen::RowVector3d a = points.row(0) - points.row(3);
  const Eigen::RowVector3d b = points.row(1) - points.row(3);
  const Eigen::RowVector3d c = points.row(2) - points.row(3);
  return a.cross(b).dot(c);
}

// Four points in a plane, and perhaps the first three on a line, but for the rounding of their
// coordinates, which are from 1 to 2.
PointList NearlyFlat(bool onLine, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(0, 1);
  PointList points = PointList::NullaryExpr(4, 3, [&] { return 1 + uniform(random); });
  const auto between = [&](int one, int two) -> Eigen::RowVector3d
  { return points.row(one) + uniform(random) * (points.row(two) - points.row(one)); };
  if (onLine)
  {
    points.row(2) = between(0, 1);
  }
  points.row(3) = between(0, 1);
  points.row(3) = between(3, 2);
  return points;
}

// Positions between two ends.
PointList Blend(const PointList& one, const PointList& two, double part)
{
  return (1 - part) * one + part * two;
}

// The end of a motion, between one that is accepted and one that is not, at which this changes.
template <typename Accepts>
PointList LastAccepted(const PointList& accepted, const PointList& refused, const Accepts& accepts)
{
  double low = 0;
  double high = 1;
  for (int halving = 0; halving < 60; ++halving)
  {
    const double middle = 0.5 * (low + high);
    (accepts(Blend(accepted, refused, middle)) ? low : high) = middle;
  }
  return Blend(accepted, refused, low);
}

using ExactQuadratic = std::array<ExactVector, 3>; // in Bernstein form

// Of the corner 0-1-2.
ExactQuadratic ExactNormals(const PointList& from, const PointList& to)
{
  const auto edge = [](const PointList& points, int end)
  { return ExactDifference(points.row(end).data(), points.row(1).data()); };
  ExactVector middle =
    ExactSum(ExactCross(edge(from, 2), edge(to, 0)), ExactCross(edge(to, 2), edge(from, 0)));
  for (Exact& component : middle)
  {
    component /= 2;
  }
  return { { ExactCross(edge(from, 2), edge(from, 0)), middle,
    ExactCross(edge(to, 2), edge(to, 0)) } };
}

// Whether the corner's normal turns by less than 90 degrees.
bool IsExactlyUpright(const PointList& from, const PointList& to)
{
  const ExactQuadratic normals = ExactNormals(from, to);
  const Exact b0 = ExactDot(normals[0], normals[0]);
  const Exact b1 = ExactDot(normals[0], normals[1]);
  const Exact b2 = ExactDot(normals[0], normals[2]);
  return b0 > 0 && b2 > 0 && (b1 >= 0 || b1 * b1 < b0 * b2);
}

// Whether it stays so by more than what rounding may hide, of edges up to about 1 long.
bool IsWellUpright(const PointList& from, const PointList& to)
{
  const ExactQuadratic normals = ExactNormals(from, to);
  const auto lengthOf = [](const ExactVector& normal)
  { return std::sqrt(CGAL::to_double(ExactDot(normal, normal))); };
  const double first = lengthOf(normals[0]);
  return std::all_of(normals.begin() + 1, normals.end(),
    [&](const ExactVector& normal)
    {
      const double along = CGAL::to_double(ExactDot(normals[0], normal)) / first;
      return along > 2e-12 + 4e-15 / first * lengthOf(normal);
    });
}

const std::array<int, 3> TheCorner{ { 0, 1, 2 } };

bool IsTakenForUpright(const PointList& from, const PointList& to)
{
  return TimeOfFlip({ from, to }, TheCorner) == 1;
}

// A corner of this height, and one that is wide and across it but for a small angle.
std::array<PointList, 2> SliverAndWideCorner(double height, double angle, std::mt19937& random)
{
  const PointList noise = WhiteNoise(5, 1, random);
  const Eigen::RowVector3d along = noise.row(0).normalized();
  const Eigen::RowVector3d up = along.cross(noise.row(1)).normalized();
  PointList from(3, 3);
  from << along, 0, 0, 0, 0.4 * along + height * up;
  const Eigen::RowVector3d normal = up.cross(along);
  const Eigen::RowVector3d across =
    (normal.cross(noise.row(2)).normalized() + angle * normal).normalized();
  const Eigen::RowVector3d one = across.cross(noise.row(3)).normalized();
  PointList to(3, 3);
  to << across.cross(one), 0, 0, 0, one;
  const double far = noise(4, 0) > 0 ? 10 : 0;
  from.rowwise() += far * noise.row(4);
  return { from, to };
}

// Of the product of a corner's normal and that of the diagonals, over time.
std::array<Exact, 5> ExactFold(const PointList& from, const PointList& to, int corner)
{
  const auto side = [](const PointList& points, int i)
  { return ExactDifference(points.row((i + 1) % 4).data(), points.row(i % 4).data()); };
  const auto cross =
    [](const ExactVector& a0, const ExactVector& a1, const ExactVector& b0, const ExactVector& b1)
  {
    ExactVector middle = ExactSum(ExactCross(a0, b1), ExactCross(a1, b0));
    for (Exact& component : middle)
    {
      component /= 2;
    }
    return ExactQuadratic{ { ExactCross(a0, b0), middle, ExactCross(a1, b1) } };
  };
  const auto diagonal = [&](const PointList& points, int i)
  { return ExactSum(side(points, i), side(points, i + 1)); };
  const ExactQuadratic n =
    cross(diagonal(from, 0), diagonal(to, 0), diagonal(from, 1), diagonal(to, 1));
  const ExactQuadratic c =
    cross(side(from, corner + 3), side(to, corner + 3), side(from, corner), side(to, corner));
  return { { ExactDot(c[0], n[0]), (ExactDot(c[0], n[1]) + ExactDot(c[1], n[0])) / 2,
    (ExactDot(c[0], n[2]) + 4 * ExactDot(c[1], n[1]) + ExactDot(c[2], n[0])) / 6,
    (ExactDot(c[1], n[2]) + ExactDot(c[2], n[1])) / 2, ExactDot(c[2], n[2]) } };
}

// Whether a polynomial in Bernstein form is seen to be above a bound, by halvings of the interval.
bool IsExactlyAbove(const std::array<Exact, 5>& whole, const Exact& bound, int halvings)
{
  if (std::all_of(whole.begin(), whole.end(), [&](const Exact& b) { return b > bound; }))
  {
    return true;
  }
  if (halvings == 0 || whole[0] <= bound || whole[4] <= bound)
  {
    return false;
  }
  std::array<Exact, 5> left;
  std::array<Exact, 5> right = whole;
  for (int step = 0; step < 5; ++step)
  {
    left[step] = right[0];
    for (int i = 0; i + step < 4; ++i)
    {
      right[i] = (right[i] + right[i + 1]) / 2;
    }
  }
  return IsExactlyAbove(left, bound, halvings - 1) && IsExactlyAbove(right, bound, halvings - 1);
}

double FourthPowerOfLongestSide(const PointList& from, const PointList& to)
{
  double longest = 0;
  for (int i = 0; i < 4; ++i)
  {
    longest = std::max({ longest, (from.row((i + 1) % 4) - from.row(i)).squaredNorm(),
      (to.row((i + 1) % 4) - to.row(i)).squaredNorm() });
  }
  return longest * longest;
}

// The squared height of a point above the plane of the first three, divided by that of the normal.
double ExactHeightAbove(const PointList& points, int point)
{
  const auto from = [&](int i)
  { return ExactDifference(points.row(i).data(), points.row(0).data()); };
  const ExactVector normal = ExactCross(from(1), from(2));
  const Exact height = ExactDot(normal, from(point));
  const double square = CGAL::to_double(Exact(height * height / ExactDot(normal, normal)));
  return height > 0 ? std::sqrt(square) : -std::sqrt(square);
}

} // namespace

// Where plain arithmetic mostly errs, at all magnitudes for which exactness is promised.
TEST(ExactPredicatesAgainstCGAL, SignsOfNearlyFlatPoints)
{
  std::mt19937 random(1);
  int wrongIfPlain = 0;
  std::array<int, 3> signs{};
  for (const double size : { 1.0, 1e30, 5e99, 1e-30, 1e-91 })
  {
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      const PointList points = size * NearlyFlat(repeat % 2 == 1, random);
      const auto at = [&](int i) { return points.row(i).data(); };
      const int side = ExactSideOf(points);
      ASSERT_EQ(Orientation3D(at(0), at(1), at(2), at(3)), side) << size;
      ASSERT_EQ(Orientation3D(at(1), at(0), at(2), at(3)), -side) << size;
      for (int x = 0; x < 3; ++x)
      {
        const int y = (x + 1) % 3;
        ASSERT_EQ(Orientation2D(at(0), at(1), at(2), x, y), ExactTurnOf(points, x, y)) << size;
      }
      wrongIfPlain += SignOf(Exact(PlainDeterminant(points))) != side ? 1 : 0;
      ++signs[side + 1];
    }
  }
  EXPECT_GT(wrongIfPlain, 1000);
  EXPECT_GT(signs[0], 1000);
  EXPECT_GT(signs[2], 1000);
}

// Differences of every size beside each other, and exact zeros among them.
TEST(ExactPredicatesAgainstCGAL, SignsOfPointsOfAllSizes)
{
  std::mt19937 random(2);
  std::uniform_int_distribution<int> exponent(-60, 60);
  std::uniform_int_distribution<int> small(-1, 1);
  int flat = 0;
  for (int repeat = 0; repeat < 5000; ++repeat)
  {
    PointList points(4, 3);
    for (Eigen::Index i = 0; i < points.size(); ++i)
    {
      points.data()[i] = std::ldexp(small(random), exponent(random));
    }
    const auto at = [&](int i) { return points.row(i).data(); };
    const int side = ExactSideOf(points);
    ASSERT_EQ(Orientation3D(at(0), at(1), at(2), at(3)), side) << repeat;
    ASSERT_EQ(Orientation2D(at(0), at(1), at(2), 0, 1), ExactTurnOf(points, 0, 1)) << repeat;
    flat += side == 0 ? 1 : 0;
  }
  EXPECT_GT(flat, 50);
  EXPECT_LT(flat, 4000);
}

// The thinner a corner is, the less its rounded normal says; and no more is held back than that
// explains.
TEST(MotionTestAgainstCGAL, SliversDoNotTurnByARightAngle)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> power(-16, -3);
  for (const double height : { 0.5, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10 })
  {
    int accepted = 0;
    int refused = 0;
    for (int repeat = 0; repeat < 1500; ++repeat)
    {
      const double angle = (repeat % 2 == 0 ? 1 : -1) * std::pow(10.0, power(random));
      const auto [from, to] = SliverAndWideCorner(height, angle, random);
      const bool isAccepted = IsTakenForUpright(from, to);
      (isAccepted ? accepted : refused) += 1;
      ASSERT_TRUE(!isAccepted || IsExactlyUpright(from, to)) << height << " at " << angle;
      ASSERT_TRUE(isAccepted || !IsWellUpright(from, to)) << height << " at " << angle;
    }
    EXPECT_GT(accepted, 40) << height;
    EXPECT_GT(refused, 500) << height;
  }
}

// The last motions that are taken for upright: they end at a right angle, or touch it on the way.
TEST(MotionTestAgainstCGAL, TheLastUprightCornersAreUpright)
{
  std::mt19937 random(4);
  int onTheWay = 0;
  for (int repeat = 0; repeat < 1500; ++repeat)
  {
    PointList from = WhiteNoise(3, 1, random);
    from.row(2) = from.row(0) + std::pow(0.1, repeat % 8) * (from.row(2) - from.row(0));
    const PointList good = from + WhiteNoise(3, 0.7, random);
    const PointList bad = from + WhiteNoise(3, 1.5, random);
    const auto accepts = [&](const PointList& to) { return IsTakenForUpright(from, to); };
    if (!accepts(good) || accepts(bad))
    {
      continue;
    }
    const PointList last = LastAccepted(good, bad, accepts);
    ASSERT_TRUE(IsExactlyUpright(from, last)) << repeat;
    const ExactQuadratic normals = ExactNormals(from, last);
    const double end = CGAL::to_double(ExactDot(normals[0], normals[2]));
    const double start = CGAL::to_double(ExactDot(normals[0], normals[0]));
    onTheWay += end > 1e-3 * start ? 1 : 0;
  }
  EXPECT_GT(onTheWay, 50);
}

// The last motions by which a quad is not folded keep all of the bound but what its derivation says
// that rounding takes.
TEST(QuadFoldAgainstCGAL, TheLastUnfoldedQuadsKeepTheBound)
{
  std::mt19937 random(5);
  const Hull quad{ { 0, 1, 2, 3 } };
  PointList square(4, 3);
  square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  int limits = 0;
  for (int repeat = 0; repeat < 600; ++repeat)
  {
    PointList from = square + WhiteNoise(4, 0.3, random);
    from.col(1) *= std::pow(0.1, repeat % 4);
    from.rowwise() += (repeat % 3) * 100 * WhiteNoise(1, 1, random).row(0);
    const PointList bad = from + WhiteNoise(4, 2, random);
    const auto accepts = [&](const PointList& to) { return TimeOfFold({ from, to }, quad) == 1; };
    if (IsFolded(from, quad) || accepts(bad))
    {
      continue;
    }
    const PointList last = LastAccepted(from, bad, accepts);
    const double fourth = FourthPowerOfLongestSide(from, last);
    for (int corner = 0; corner < 4; ++corner)
    {
      ASSERT_TRUE(
        IsExactlyAbove(ExactFold(from, last, corner), Exact((1e-11 - 4.2e-14) * fourth), 8))
        << repeat;
    }
    ++limits;
  }
  EXPECT_GT(limits, 200);
}

// Sheets that come together, far from the origin, while they move along: the last motions that are
// proven keep the distance but for the error that MotionTest.h derives, and sheets that are nearer
// than that can be trusted are not moved.
TEST(MotionTestAgainstCGAL, TheLastMotionsKeepTheirDistance)
{
  std::mt19937 random(6);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  int limits = 0;
  for (int repeat = 0; repeat < 1000; ++repeat)
  {
    const Eigen::RowVector3d normal = WhiteNoise(1, 1, random).row(0).normalized();
    const Eigen::RowVector3d x = normal.cross(WhiteNoise(1, 1, random).row(0)).normalized();
    const Eigen::RowVector3d y = normal.cross(x);
    const Eigen::RowVector3d far = std::pow(10.0, repeat % 4) * WhiteNoise(1, 1, random).row(0);
    const Eigen::RowVector3d shared = 30 * WhiteNoise(1, 1, random).row(0);
    const double extent = 100 + far.norm() + shared.norm();
    const MinimumDistance distance{ 2e-12 * extent, 1e-12 * extent };
    const double start = distance.Resolution * std::pow(10.0, repeat % 5 * 0.5 - 0.5);
    PointList from(6, 3);
    from << -9 * x - 9 * y, 9 * x - 9 * y, 9 * y, -9 * x + 9 * y, 9 * x + 9 * y, -9 * y;
    from.bottomRows(3).rowwise() += start * normal;
    from.rowwise() += far;
    const PointList along = from.rowwise() + shared;
    PointList through = along;
    through.bottomRows(3).rowwise() -= 2 * start * normal;
    const auto accepts = [&](const PointList& to) {
      return TimeOfImpact({ from, to }, one, two, distance) >= 1;
    };
    ASSERT_FALSE(accepts(through));
    if (!accepts(along))
    {
      continue; // too near, or too thin for its normal to be found
    }
    ++limits;
    const PointList last = LastAccepted(along, through, accepts);
    double nearest = 1;
    double kept = distance.Wanted;
    for (int point = 3; point < 6; ++point)
    {
      nearest = std::min(nearest, ExactHeightAbove(last, point));
      kept = std::min(kept, (1 - 1e-6) * ExactHeightAbove(from, point));
    }
    ASSERT_GE(nearest, kept - 1e-14 * extent) << repeat;
    ASSERT_GT(nearest, 0.9 * distance.Resolution) << repeat;
  }
  EXPECT_GT(limits, 200);
}

// Motions that the guard has limited, in CGAL's view, at many times.
TEST(GuardAgainstCGAL, NothingMeetsAtAnyTime)
{
  std::mt19937 random(7);
  const TestSphere sphere(3);
  EmbeddingGuard guard(sphere.Mesh);
  PointList points = sphere.Points();
  std::size_t without = 0;
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    PointList motion = AdverseMotion(kind, sphere.EdgeLength, points, random);
    if (motion.cwiseAbs().maxCoeff() < 1e3)
    {
      without += FindWithCGAL(points + 0.7 * motion, sphere.Faces()).size();
    }
    const PointList to = guard.Limit(points, motion, SerialFor, NeverStop).Positions;
    for (int step = 1; step <= 8; ++step)
    {
      ASSERT_TRUE(FindWithCGAL(Blend(points, to, step / 8.0), sphere.Faces()).empty())
        << AdverseMotionNames[kind] << " at " << step / 8.0;
    }
    points = kind % 2 == 1 ? to : points;
  }
  EXPECT_GT(without, 1000u);
}

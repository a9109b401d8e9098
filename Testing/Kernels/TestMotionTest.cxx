#include "Geometry/ClosestDirection.h"
#include "Geometry/HullIntersection.h"
#include "Guard/MotionBox.h"
#include "Guard/SeparatingDirection.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;
using Eigen::Vector3d;

namespace
{

PointList RandomPoints(Eigen::Index count, std::mt19937& random)
{
  return WhiteNoise(count, 1.0, random);
}

// Two parallel triangles that are 1 apart along z, over each other.
PointList SheetsOneApart(std::mt19937& random)
{
  PointList sheets(6, 3);
  sheets << -9, -9, 1, 9, -9, 1, 0, 9, 1, -9, 9, 0, 9, 9, 0, 0, -9, 0;
  sheets.leftCols(2) += RandomPoints(6, random).leftCols(2);
  return sheets;
}

Eigen::Matrix3d RandomRotation(std::mt19937& random)
{
  return Eigen::Quaterniond(RandomPoints(1, random)(0, 0), RandomPoints(1, random)(0, 0),
    RandomPoints(1, random)(0, 0), RandomPoints(1, random)(0, 0))
    .normalized()
    .toRotationMatrix();
}

HullCorners Padded(std::initializer_list<Vector3d> points)
{
  HullCorners corners;
  corners.fill(*(points.end() - 1));
  std::copy(points.begin(), points.end(), corners.begin());
  return corners;
}

HullCorners Take(const PointList& points, int first, int count)
{
  HullCorners taken;
  for (int i = 0; i < 4; ++i)
  {
    taken[i] = points.row(first + std::min(i, count - 1));
  }
  return taken;
}

// The distance of two convex hulls by a method of its own (Gilbert's): the point of the difference
// body nearest to the origin, improved one vertex at a time.
double DistanceBySearch(const HullCorners& one, const HullCorners& two)
{
  Vector3d nearest = one[0] - two[0];
  for (int iteration = 0; iteration < 20000; ++iteration)
  {
    Vector3d support = nearest;
    for (const Vector3d& a : one)
    {
      for (const Vector3d& b : two)
      {
        if (nearest.dot(a - b) < nearest.dot(support))
        {
          support = a - b;
        }
      }
    }
    const Vector3d step = support - nearest;
    if (-nearest.dot(step) < 1e-9 || step.squaredNorm() == 0)
    {
      break;
    }
    nearest += std::min(1.0, -nearest.dot(step) / step.squaredNorm()) * step;
  }
  return nearest.norm();
}

void CompareDistances(int countOfOne, int countOfTwo, std::mt19937& random)
{
  for (int repeat = 0; repeat < 500; ++repeat)
  {
    const PointList points = RandomPoints(countOfOne + countOfTwo, random);
    HullCorners one = Take(points, 0, countOfOne);
    const HullCorners two = Take(points, countOfOne, countOfTwo);
    for (Vector3d& point : one)
    {
      point += Vector3d(1.5, 0, 0);
    }
    const double expected = DistanceBySearch(one, two);
    if (expected > 0.1)
    {
      // The search ends a little above the least distance.
      const double distance = ClosestDirection(one, two).norm();
      EXPECT_LE(distance, expected * (1 + 1e-12));
      EXPECT_GE(distance, expected * (1 - 1e-2));
      EXPECT_NEAR(ProvenDistance(one, two), distance, 1e-12);
    }
  }
}

// The least distance of two triangles, zero where they intersect, at sampled times.
double SampledDistance(const PointList& from, const PointList& to, double until)
{
  double least = 1e300;
  for (int step = 0; step <= 200; ++step)
  {
    const double time = until * step / 200.0;
    const PointList points = (1 - time) * from + time * to;
    least = std::min(least,
      HullsMeet(points, { { 0, 1, 2, 2 } }, { { 3, 4, 5, 5 } })
        ? 0.0
        : ClosestDirection(Take(points, 0, 3), Take(points, 3, 3)).norm());
  }
  return least;
}

Vector3d CornerNormal(const Motion& motion, const std::array<int, 3>& corner, double time)
{
  const Vector3d origin = motion.At(corner[0], time);
  const Vector3d one = motion.At(corner[1], time) - origin;
  const Vector3d two = motion.At(corner[2], time) - origin;
  return one.cross(two);
}

} // namespace

TEST(ClosestDirection, AgreesWithASearch)
{
  std::mt19937 random(1);
  for (int one = 1; one <= 4; ++one)
  {
    for (int two = 1; two <= 4; ++two)
    {
      CompareDistances(one, two, random);
    }
  }
}

TEST(ClosestDirection, DegenerateSimplices)
{
  const Vector3d o(0, 0, 0);
  const Vector3d x(1, 0, 0);
  const Vector3d y(0, 1, 0);
  // Parallel segments, a point as a segment, a segment as a triangle.
  EXPECT_NEAR(ClosestDirection(Padded({ o, x }), Padded({ y, Vector3d(x + y) })).norm(), 1, 1e-15);
  EXPECT_NEAR(ClosestDirection(Padded({ o, x }), Padded({ y, y })).norm(), 1, 1e-15);
  EXPECT_NEAR(
    ClosestDirection(Padded({ Vector3d(0.5, 2, 0) }), Padded({ o, x, Vector3d(2 * x) })).norm(), 2,
    1e-15);
  // From the second to the first.
  EXPECT_EQ(ClosestDirection(Padded({ Vector3d(0.2, 0.2, 3) }), Padded({ o, x, y })),
    Vector3d(0, 0, 3));
}

// Whenever it says that two triangles keep their gap, they do at every sampled time; and it does
// not give up where there is room.
TEST(MotionTest, TrianglesStayApart)
{
  std::mt19937 random(2);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  const MinimumDistance gap{ 0.01, 1e-12 };
  int proven = 0;
  int refused = 0;
  for (int repeat = 0; repeat < 3000; ++repeat)
  {
    PointList from = RandomPoints(6, random);
    from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
    // Large motion in common, smaller motion of its own.
    const Eigen::RowVector3d shared = RandomPoints(1, random);
    const PointList to =
      (from + 0.5 * (1 + repeat % 3) * RandomPoints(6, random)).rowwise() + 10 * shared;
    const Motion motion{ from, to };
    const double start = SampledDistance(from, to, 0);
    const double least = SampledDistance(from, to, 1);
    const double until = TimeOfImpact(motion, one, two, gap);
    if (until >= 1)
    {
      ++proven;
      EXPECT_GE(least, 0.999 * std::min(start, gap.Wanted));
    }
    else
    {
      ++refused;
      EXPECT_LE(least, 2 * gap.Wanted);
      // What is proven holds, and it is most of what there is.
      EXPECT_EQ(until < 0, start < gap.Resolution);
      EXPECT_GE(SampledDistance(from, to, std::max(0.0, until)),
        0.999 * std::min(start, gap.Wanted));
      if (start > 2 * gap.Wanted)
      {
        EXPECT_LE(SampledDistance(from, to, until + 0.15), 2 * gap.Wanted);
      }
    }
  }
  EXPECT_GT(proven, 500);
  EXPECT_GT(refused, 500);
}

namespace
{

SinglePrecisionMotion Rounded(const Motion& motion, const Vector3d& origin)
{
  SinglePrecisionMotion rounded(motion.From.rows(), origin);
  for (int vertex = 0; vertex < motion.From.rows(); ++vertex)
  {
    rounded.Update(motion, vertex);
  }
  return rounded;
}

} // namespace

// A separating direction is a proof, at any scale and far from the origin, and mostly there is one.
TEST(MotionTest, SeparatingDirectionsHold)
{
  std::mt19937 random(4);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  for (double size : { 1e-20, 1e-6, 1.0, 1e4, 1e20 })
  {
    const MinimumDistance gap{ 0.01 * size, 1e-12 * size };
    int apart = 0;
    int proven = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      PointList from = RandomPoints(6, random);
      from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
      const Eigen::RowVector3d shared = RandomPoints(1, random);
      PointList to = (from + 0.3 * RandomPoints(6, random)).rowwise() + 10 * shared;
      from *= size;
      to *= size;
      const Motion motion{ from, to };
      const bool isApart = TimeOfImpact(motion, one, two, gap) >= 1;
      apart += isApart ? 1 : 0;
      if (HaveSeparatingDirection(Rounded(motion, size * RandomPoints(1, random).row(0)), one, two,
            gap.Wanted))
      {
        ++proven;
        EXPECT_GE(SampledDistance(from, to, 1), (1 - 1e-9) * gap.Wanted);
      }
    }
    EXPECT_GT(apart, 500);
    if (size > 1e-5 && size < 1e4)
    {
      EXPECT_GT(proven, 0.8 * apart) << size;
    }
    else if (size < 1e-10 || size > 1e10)
    {
      EXPECT_EQ(proven, 0) << size; // out of range
    }
  }
}

// What is less than the gap by no more than the rounding of single precision proves nothing, nor
// does what is lost in the rounding of large coordinates.
TEST(MotionTest, SeparatingDirectionsAllowForRounding)
{
  std::mt19937 random(5);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  for (double far : { 0.0, 1.0, 100.0, 1e4, 1e6 })
  {
    int proven = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      // Parallel triangles that are 1 apart along a random direction, over each other.
      const Eigen::Matrix3d turn = RandomRotation(random);
      PointList from = SheetsOneApart(random);
      from = (from * turn.transpose()).rowwise() + far * RandomPoints(1, random).row(0);
      const PointList to = from.rowwise() + 5 * RandomPoints(1, random).row(0);
      const SinglePrecisionMotion rounded = Rounded({ from, to }, Vector3d::Zero());
      // Positions far away are themselves rounded, in double precision.
      const double gap = 1 + 1e-12 + 1e-15 * far;
      EXPECT_FALSE(HaveSeparatingDirection(rounded, one, two, gap)) << far;
      proven += HaveSeparatingDirection(rounded, one, two, 0.9) ? 1 : 0;
    }
    if (far < 1e5)
    {
      EXPECT_EQ(proven, 2000) << far;
    }
    else
    {
      EXPECT_LT(proven, 500) << far;
    }
  }
}

// A search that may end early ends with what is true, no sooner than it may.
TEST(MotionTest, StopsAtTheMaximumTime)
{
  std::mt19937 random(6);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  const MinimumDistance gap{ 0.01, 1e-12 };
  int shortened = 0;
  for (int repeat = 0; repeat < 3000; ++repeat)
  {
    PointList from = RandomPoints(6, random);
    from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
    const PointList to = from + (1 + repeat % 3) * RandomPoints(6, random);
    const Motion motion{ from, to };
    const double until = TimeOfImpact(motion, one, two, gap);
    for (double maximumTime : { 0.0, 0.1, 0.4 })
    {
      const double early = TimeOfImpact(motion, one, two, gap, maximumTime);
      if (until < 0 || until < maximumTime)
      {
        EXPECT_EQ(early, until);
      }
      else
      {
        EXPECT_GE(early, maximumTime);
        EXPECT_LE(early, until);
        shortened += early < until ? 1 : 0;
      }
    }
  }
  EXPECT_GT(shortened, 500);
}

// Boxes of motions that are nearer than their margins are never found apart, whatever the rounding,
// and otherwise they are; what they share of their motion does not matter.
TEST(MotionTest, BoxesAllowForRoundingAndUnderflow)
{
  std::mt19937 random(9);
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  for (double size : { 1e20, 1.0, 1e-20, 1e-36, 1e-40, 1e-42, 1e-44 })
  {
    int tests = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      PointList points = 0.3 * RandomPoints(6, random);
      points.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
      points *= size;
      const auto low = [&](int axis, int first)
      { return points.col(axis).segment(first, 3).minCoeff(); };
      const auto high = [&](int axis, int first)
      { return points.col(axis).segment(first, 3).maxCoeff(); };
      const double gap = low(0, 3) - high(0, 0);
      const auto overlap = [&](int axis)
      { return low(axis, 0) <= high(axis, 3) && low(axis, 3) <= high(axis, 0); };
      // Along the other axes they overlap, or the first one would not decide.
      if (gap <= 0.1 * size || !overlap(1) || !overlap(2))
      {
        continue;
      }
      ++tests;
      const PointList to =
        repeat % 2 == 0 ? points : points.rowwise() + 10 * size * RandomPoints(1, random).row(0);
      const auto areApart = [&](double distance)
      {
        const Motion motion{ points, to };
        return MotionBox(motion, one, distance / 2)
          .StaysApartFrom(MotionBox(motion, two, distance / 2));
      };
      EXPECT_FALSE(areApart(gap * (1 + 1e-6))) << size;
      EXPECT_TRUE(areApart(0.9 * gap) || size < 1e-42) << size;
    }
    EXPECT_GT(tests, 20) << size;
  }
}

TEST(MotionTest, RestIsSafeWhereverItIs)
{
  PointList points = PointList::Zero(6, 3);
  const MinimumDistance gap{ 0.01, 1e-12 };
  const Hull one{ { 0, 1, 2, 2 } };
  const Hull two{ { 3, 4, 5, 5 } };
  EXPECT_EQ(TimeOfImpact({ points, points }, one, two, gap), 1);
  EXPECT_EQ(TimeOfFlip({ points, points }, { { 0, 1, 2 } }), 1);
  PointList moved = points;
  moved(4, 1) = 1e-3;
  EXPECT_LT(TimeOfImpact({ points, moved }, one, two, gap), 0);
}

TEST(MotionTest, CornersStayUpright)
{
  std::mt19937 random(3);
  const std::array<int, 3> corner{ { 0, 1, 2 } };
  int upright = 0;
  int flipped = 0;
  for (int repeat = 0; repeat < 5000; ++repeat)
  {
    const PointList from = RandomPoints(3, random);
    const PointList to = from + 0.4 * (1 + repeat % 5) * RandomPoints(3, random);
    const Motion motion{ from, to };
    const Vector3d first = CornerNormal(motion, corner, 0);
    const double until = TimeOfFlip(motion, corner);
    double firstZero = 1;
    for (int step = 500; step > 0; --step)
    {
      const double time = step / 500.0;
      firstZero = first.dot(CornerNormal(motion, corner, time)) > 0 ? firstZero : time;
    }
    if (until >= 1)
    {
      ++upright;
      EXPECT_GT(first.dot(CornerNormal(motion, corner, 1)), 0);
      EXPECT_EQ(firstZero, 1);
    }
    else
    {
      ++flipped;
      EXPECT_NEAR(first.dot(CornerNormal(motion, corner, until)), 0,
        1e-9 * (first.squaredNorm() + CornerNormal(motion, corner, 1).squaredNorm()));
      EXPECT_LT(until, firstZero + 1e-6);
    }
  }
  EXPECT_GT(upright, 500);
  EXPECT_GT(flipped, 500);
}

// Corners that are thin at both ends of their motion and wide in between, and those that turn over
// while they are thin: what decides is lost beside what is large, if it is not kept apart.
TEST(MotionTest, SliversThatTurnOverAreNotUpright)
{
  PointList from(3, 3);
  PointList to(3, 3);
  from << -1, 1e-9, 0, 0, 0, 0, 1, 0, 0;
  to << -1.1567222846714935, 1.2203275536361291, 0, 0, 0, 0, 0.84327771532850648,
    -0.88964745456838934, 0;
  EXPECT_LT(TimeOfFlip({ from, to }, { { 0, 1, 2 } }), 1);

  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0.1, 3);
  for (double height : { 1e-7, 3e-8, 1e-8, 1e-9, 1e-10 })
  {
    for (int repeat = 0; repeat < 3000; ++repeat)
    {
      // The same sliver, stretched, turned about its vertex, and turned over.
      const double turn = angle(random);
      const Eigen::Rotation2Dd rotation(turn);
      from << -1, height, 0, 0, 0, 0, 1, 0, 0;
      to.setZero();
      to.row(0).head<2>() = (rotation * Eigen::Vector2d(-1, -3 * height)).transpose();
      to.row(2).head<2>() = (rotation * Eigen::Vector2d(1, 0)).transpose();
      const Motion motion{ from, to };
      const Vector3d first = CornerNormal(motion, { { 1, 2, 0 } }, 0);
      const Vector3d last = CornerNormal(motion, { { 1, 2, 0 } }, 1);
      if (first.dot(last) < -1e-9 * first.norm() * last.norm())
      {
        ASSERT_LT(TimeOfFlip(motion, { { 0, 1, 2 } }), 1) << height << " turned by " << turn;
      }
    }
  }
}

TEST(MotionTest, TinyCornersAreJudgedLikeOthers)
{
  for (double size : { 1e-30, 1e-10, 1.0, 1e20 })
  {
    PointList from(3, 3);
    from << size, 0, 0, 0, 0, 0, 0, size, 0;
    PointList flipped = from;
    flipped(0, 0) = -size;
    PointList turned = from;
    turned(0, 1) = 0.5 * size;
    EXPECT_NEAR(TimeOfFlip({ from, flipped }, { { 0, 1, 2 } }), 0.5, 1e-9) << size;
    EXPECT_EQ(TimeOfFlip({ from, turned }, { { 0, 1, 2 } }), 1) << size;
  }
}

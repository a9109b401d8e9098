#include "Geometry/ClosestDirection.h"
#include "Geometry/TriangleIntersection.h"
#include "Guard/MotionBox.h"
#include "Guard/MotionCertificate.h"
#include "Guard/SweptBox.h"
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

template <std::size_t N>
std::array<Vector3d, N> Take(const PointList& points, int first)
{
  std::array<Vector3d, N> taken;
  for (std::size_t i = 0; i < N; ++i)
  {
    taken[i] = points.row(first + static_cast<int>(i));
  }
  return taken;
}

// The distance of two convex hulls by a method of its own (Gilbert's): the point of the difference
// body nearest to the origin, improved one vertex at a time.
template <std::size_t A, std::size_t B>
double DistanceBySearch(const std::array<Vector3d, A>& one, const std::array<Vector3d, B>& two)
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

template <std::size_t A, std::size_t B>
void CompareDistances(std::mt19937& random)
{
  for (int repeat = 0; repeat < 500; ++repeat)
  {
    const PointList points = RandomPoints(A + B, random);
    auto one = Take<A>(points, 0);
    const auto two = Take<B>(points, A);
    for (Vector3d& point : one)
    {
      point += Vector3d(1.5, 0, 0);
    }
    const double expected = DistanceBySearch(one, two);
    if (expected > 0.05)
    {
      // The search ends a little above the least distance.
      const double distance = ClosestDirection(one, two).norm();
      EXPECT_LE(distance, expected * (1 + 1e-12));
      EXPECT_GE(distance, expected * (1 - 1e-2));
    }
  }
}

// The least distance of two triangles, zero where they intersect, at sampled times.
double MinimumDistance(const PointList& from, const PointList& to, double until)
{
  TriangleList triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  double least = 1e300;
  for (int step = 0; step <= 200; ++step)
  {
    const double time = until * step / 200.0;
    const PointList points = (1 - time) * from + time * to;
    least = std::min(least,
      TrianglesIntersect(points, triangles, 0, 1)
        ? 0.0
        : ClosestDirection(Take<3>(points, 0), Take<3>(points, 3)).norm());
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
  CompareDistances<1, 3>(random);
  CompareDistances<2, 2>(random);
  CompareDistances<3, 3>(random);
}

TEST(ClosestDirection, DegenerateSimplices)
{
  const Vector3d o(0, 0, 0);
  const Vector3d x(1, 0, 0);
  const Vector3d y(0, 1, 0);
  using Point = std::array<Vector3d, 1>;
  using Segment = std::array<Vector3d, 2>;
  using Triangle = std::array<Vector3d, 3>;
  // Parallel segments, a point as a segment, a segment as a triangle.
  EXPECT_NEAR(ClosestDirection(Segment{ o, x }, Segment{ y, Vector3d(x + y) }).norm(), 1, 1e-15);
  EXPECT_NEAR(ClosestDirection(Segment{ o, x }, Segment{ y, y }).norm(), 1, 1e-15);
  EXPECT_NEAR(
    ClosestDirection(Point{ Vector3d(0.5, 2, 0) }, Triangle{ o, x, Vector3d(2 * x) }).norm(), 2,
    1e-15);
  // From the second to the first.
  EXPECT_EQ(ClosestDirection(Point{ Vector3d(0.2, 0.2, 3) }, Triangle{ o, x, y }),
    Vector3d(0, 0, 3));
}

// Whenever it says that two triangles keep their gap, they do at every sampled time; and it does
// not give up where there is room.
TEST(MotionCertificate, TrianglesStayApart)
{
  std::mt19937 random(2);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  const MotionGap gap{ 0.01, 1e-12 };
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
    const double start = MinimumDistance(from, to, 0);
    const double least = MinimumDistance(from, to, 1);
    const double until = ApartUntil(motion, one, two, gap);
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
      EXPECT_GE(MinimumDistance(from, to, std::max(0.0, until)),
        0.999 * std::min(start, gap.Wanted));
      if (start > 2 * gap.Wanted)
      {
        EXPECT_LE(MinimumDistance(from, to, until + 0.15), 2 * gap.Wanted);
      }
    }
  }
  EXPECT_GT(proven, 500);
  EXPECT_GT(refused, 500);
}

namespace
{

RoughMotion Rough(const Motion& motion, const Vector3d& origin)
{
  RoughMotion rough(motion.From.rows(), origin);
  for (int vertex = 0; vertex < motion.From.rows(); ++vertex)
  {
    rough.Update(motion, vertex);
  }
  return rough;
}

} // namespace

// A quick proof is a proof, at any scale and far from the origin; and mostly there is one.
TEST(MotionCertificate, QuickProofsHold)
{
  std::mt19937 random(4);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  for (double size : { 1e-20, 1e-6, 1.0, 1e4, 1e20 })
  {
    const MotionGap gap{ 0.01 * size, 1e-12 * size };
    int apart = 0;
    int proven = 0;
    int provenAtStart = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      PointList from = RandomPoints(6, random);
      from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
      const Eigen::RowVector3d shared = RandomPoints(1, random);
      PointList to = (from + 0.3 * RandomPoints(6, random)).rowwise() + 10 * shared;
      from *= size;
      to *= size;
      const Motion motion{ from, to };
      const bool isApart = ApartUntil(motion, one, two, gap) >= 1;
      apart += isApart ? 1 : 0;
      switch (
        ProveApart(Rough(motion, size * RandomPoints(1, random).row(0)), one, two, gap.Wanted))
      {
        case QuickProof::ApartThroughout:
        case QuickProof::ApartOnAnyPart:
          ++proven;
          EXPECT_GE(MinimumDistance(from, to, 1), (1 - 1e-9) * gap.Wanted);
          break;
        case QuickProof::ApartAtStart:
          ++provenAtStart;
          EXPECT_GE(MinimumDistance(from, to, 0), (1 - 1e-9) * gap.Wanted);
          break;
        case QuickProof::None:
          break;
      }
    }
    EXPECT_GT(apart, 500);
    if (size > 1e-5 && size < 1e4)
    {
      EXPECT_GT(proven, 0.8 * apart) << size;
      EXPECT_GT(provenAtStart, 100) << size;
    }
    else if (size < 1e-10 || size > 1e10)
    {
      EXPECT_EQ(proven, 0) << size; // out of range
    }
  }
}

// What is less than the gap by no more than the rounding of single precision proves nothing, nor
// does what is lost in the rounding of large coordinates.
TEST(MotionCertificate, QuickProofsAllowForRounding)
{
  std::mt19937 random(5);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
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
      const RoughMotion rough = Rough({ from, to }, Vector3d::Zero());
      // Positions far away are themselves rounded, in double precision.
      const double gap = 1 + 1e-12 + 1e-15 * far;
      EXPECT_EQ(ProveApart(rough, one, two, gap), QuickProof::None) << far;
      proven += ProveApart(rough, one, two, 0.9) >= QuickProof::ApartThroughout ? 1 : 0;
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
TEST(MotionCertificate, EnoughIsEnough)
{
  std::mt19937 random(6);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  const MotionGap gap{ 0.01, 1e-12 };
  int shortened = 0;
  for (int repeat = 0; repeat < 3000; ++repeat)
  {
    PointList from = RandomPoints(6, random);
    from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
    const PointList to = from + (1 + repeat % 3) * RandomPoints(6, random);
    const Motion motion{ from, to };
    const double until = ApartUntil(motion, one, two, gap);
    for (double enough : { 0.0, 0.1, 0.4 })
    {
      const double early = ApartUntil(motion, one, two, gap, enough);
      if (until < 0 || until < enough)
      {
        EXPECT_EQ(early, until);
      }
      else
      {
        EXPECT_GE(early, enough);
        EXPECT_LE(early, until);
        shortened += early < until ? 1 : 0;
      }
    }
  }
  EXPECT_GT(shortened, 500);
}

TEST(MotionCertificate, RestIsSafeWhereverItIs)
{
  PointList points = PointList::Zero(6, 3);
  const MotionGap gap{ 0.01, 1e-12 };
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  EXPECT_EQ(ApartUntil({ points, points }, one, two, gap), 1);
  EXPECT_EQ(UprightUntil({ points, points }, one), 1);
  PointList moved = points;
  moved(4, 1) = 1e-3;
  EXPECT_LT(ApartUntil({ points, moved }, one, two, gap), 0);
}

TEST(MotionCertificate, CornersStayUpright)
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
    const double until = UprightUntil(motion, corner);
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
TEST(MotionCertificate, SliversThatTurnOverAreNotUpright)
{
  PointList from(3, 3);
  PointList to(3, 3);
  from << -1, 1e-9, 0, 0, 0, 0, 1, 0, 0;
  to << -1.1567222846714935, 1.2203275536361291, 0, 0, 0, 0, 0.84327771532850648,
    -0.88964745456838934, 0;
  EXPECT_LT(UprightUntil({ from, to }, { { 0, 1, 2 } }), 1);

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
        ASSERT_LT(UprightUntil(motion, { { 0, 1, 2 } }), 1) << height << " turned by " << turn;
      }
    }
  }
}

TEST(MotionCertificate, TinyCornersAreJudgedLikeOthers)
{
  for (double size : { 1e-30, 1e-10, 1.0, 1e20 })
  {
    PointList from(3, 3);
    from << size, 0, 0, 0, 0, 0, 0, size, 0;
    PointList flipped = from;
    flipped(0, 0) = -size;
    PointList turned = from;
    turned(0, 1) = 0.5 * size;
    EXPECT_NEAR(UprightUntil({ from, flipped }, { { 0, 1, 2 } }), 0.5, 1e-9) << size;
    EXPECT_EQ(UprightUntil({ from, turned }, { { 0, 1, 2 } }), 1) << size;
  }
}

// Wherever on their ways the vertices are, each for itself, the gap is there.
TEST(MotionCertificate, QuickProofsHoldOnAnyPart)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0, 1);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  const double gap = 0.01;
  for (double motionSize : { 0.05, 0.3, 1.0 })
  {
    int proven = 0;
    for (int repeat = 0; repeat < 1000; ++repeat)
    {
      PointList from = RandomPoints(6, random);
      from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
      const PointList to = from + motionSize * RandomPoints(6, random);
      if (ProveApart(Rough({ from, to }, RandomPoints(1, random).row(0)), one, two, gap) !=
        QuickProof::ApartOnAnyPart)
      {
        continue;
      }
      ++proven;
      for (int sample = 0; sample < 20; ++sample)
      {
        PointList held = to;
        for (int vertex = 0; vertex < 6; ++vertex)
        {
          // Often an end: there the ways come closest.
          const double scale = std::min(1.0, std::max(0.0, 3 * part(random) - 1));
          held.row(vertex) = (1 - scale) * from.row(vertex) + scale * to.row(vertex);
        }
        ASSERT_GE(ClosestDirection(Take<3>(held, 0), Take<3>(held, 3)).norm(), (1 - 1e-9) * gap);
      }
    }
    EXPECT_GT(proven, 100) << motionSize;
  }
}

// Triangles that move together, 2 apart all the way, while their ways are 1 apart.
TEST(MotionCertificate, QuickProofsOfAnyPartAllowForRounding)
{
  std::mt19937 random(7);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  for (double far : { 0.0, 1.0, 100.0, 1e4 })
  {
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      const Eigen::Matrix3d turn = RandomRotation(random);
      PointList from(6, 3);
      from << -9, -9, 2, 9, -9, 2, 0, 9, 2, -9, 9, 0, 9, 9, 0, 0, -9, 0;
      from.leftCols(2) += RandomPoints(6, random).leftCols(2);
      const double sense = repeat % 2 == 0 ? 1 : -1;
      PointList to = from.rowwise() + Eigen::RowVector3d(0.3, 0.2, sense);
      const Eigen::RowVector3d place = far * RandomPoints(1, random).row(0);
      from = (from * turn.transpose()).rowwise() + place;
      to = (to * turn.transpose()).rowwise() + place;
      const RoughMotion rough = Rough({ from, to }, Vector3d::Zero());
      const double gap = 1 + 1e-12 + 1e-15 * far;
      EXPECT_EQ(ProveApart(rough, one, two, gap), QuickProof::ApartThroughout) << far;
      EXPECT_EQ(ProveApart(rough, one, two, 0.9), QuickProof::ApartOnAnyPart) << far;
    }
  }
}

// Triangles that are 1 apart and slide far within their planes: so are their ways, which no tilted
// direction can tell from those of triangles that stay where they are.
TEST(MotionCertificate, QuickProofsOfLongSlidesAllowForRounding)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> angle(0, 6.28);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  for (double slide : { 10.0, 1e3, 1e4 })
  {
    int proven = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
    {
      const Eigen::Matrix3d turn = RandomRotation(random);
      PointList from = SheetsOneApart(random);
      const double towards = angle(random);
      PointList to = from.rowwise() +
        Eigen::RowVector3d(slide * std::cos(towards), slide * std::sin(towards), 0);
      from = from * turn.transpose();
      to = to * turn.transpose();
      const RoughMotion rough = Rough({ from, to }, Vector3d::Zero());
      const double gap = 1 + 1e-12 + 1e-15 * slide;
      EXPECT_EQ(ProveApart(rough, one, two, gap), QuickProof::None) << slide;
      proven += ProveApart(rough, one, two, 0.9) == QuickProof::ApartOnAnyPart ? 1 : 0;
    }
    if (slide < 1e4)
    {
      EXPECT_EQ(proven, 2000) << slide;
    }
  }
}

// Boxes with margins are apart when their contents are by more than the margins, never by less.
TEST(SweptBox, HoldsAllThatIsPassed)
{
  std::mt19937 random(8);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  int apart = 0;
  int notMerged = 0;
  for (int repeat = 0; repeat < 20000; ++repeat)
  {
    const double far = repeat % 2 == 0 ? 0 : 1e5;
    PointList from = 0.5 * RandomPoints(6, random);
    from.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
    PointList to = from + 0.3 * RandomPoints(6, random);
    from.array() += far;
    to.array() += far;
    // Just what the nearest coordinates leave between them.
    double gap = -1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto least = [&](int first)
      {
        return std::min(from.col(axis).segment(first, 3).minCoeff(),
          to.col(axis).segment(first, 3).minCoeff());
      };
      const auto greatest = [&](int first)
      {
        return std::max(from.col(axis).segment(first, 3).maxCoeff(),
          to.col(axis).segment(first, 3).maxCoeff());
      };
      gap = std::max({ gap, least(0) - greatest(3), least(3) - greatest(0) });
    }
    if (gap <= 0.01)
    {
      continue;
    }
    const RoughMotion rough = Rough({ from, to }, Vector3d::Zero());
    const auto boxes = [&](double distance)
    {
      const float margin = static_cast<float>(distance / 2);
      return std::make_pair(SweptBox(rough, one, margin), SweptBox(rough, two, margin));
    };
    const auto tooNear = boxes(gap * (1 + 1e-6));
    EXPECT_FALSE(tooNear.first.IsApartFrom(tooNear.second));
    const auto near = boxes(far == 0 ? gap - 1e-5 : 0.0);
    const bool isApart = near.first.IsApartFrom(near.second);
    EXPECT_TRUE(isApart || far > 0);
    apart += isApart ? 1 : 0;
    SweptBox merged = near.first;
    merged.Merge(near.second);
    notMerged += merged.IsApartFrom(near.first) || merged.IsApartFrom(near.second) ? 1 : 0;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_EQ(notMerged, 0);
}

// Boxes of what is too near, in numbers so small that their rounding is no longer relative to them.
TEST(MotionBoxes, HoldWhatUnderflows)
{
  std::mt19937 random(9);
  const std::array<int, 3> one{ { 0, 1, 2 } };
  const std::array<int, 3> two{ { 3, 4, 5 } };
  int apart = 0;
  for (double size : { 1e-20, 1e-36, 1e-40, 1e-42, 1e-44 })
  {
    for (int repeat = 0; repeat < 1000; ++repeat)
    {
      PointList points = 0.3 * RandomPoints(6, random);
      points.bottomRows(3).rowwise() += Eigen::RowVector3d(1, 0, 0);
      points *= size;
      const double gap = points.col(0).tail(3).minCoeff() - points.col(0).head(3).maxCoeff();
      if (gap <= 0.1 * size)
      {
        continue;
      }
      const Motion motion{ points, points };
      const auto check = [&](double distance, bool mayBeApart)
      {
        const float margin = static_cast<float>(distance / 2);
        const RoughMotion rough = Rough(motion, Vector3d::Zero());
        const bool sweptApart =
          SweptBox(rough, one, margin).IsApartFrom(SweptBox(rough, two, margin));
        const auto boxOf = [&](const std::array<int, 3>& triangle)
        {
          MotionBox box(motion, triangle[0], distance / 2);
          box.Merge(MotionBox(motion, triangle[1], distance / 2));
          box.Merge(MotionBox(motion, triangle[2], distance / 2));
          return box;
        };
        const bool movingApart = boxOf(one).StaysApartFrom(boxOf(two));
        if (!mayBeApart)
        {
          EXPECT_FALSE(sweptApart) << size;
          EXPECT_FALSE(movingApart) << size;
        }
        apart += sweptApart && movingApart ? 1 : 0;
      };
      // Along the other axes they overlap, or the first one would not decide.
      const auto overlap = [&](int axis)
      {
        return points.col(axis).head(3).minCoeff() <= points.col(axis).tail(3).maxCoeff() &&
          points.col(axis).tail(3).minCoeff() <= points.col(axis).head(3).maxCoeff();
      };
      if (overlap(1) && overlap(2))
      {
        check(gap * (1 + 1e-6), false);
        check(0.9 * gap, true);
      }
    }
  }
  EXPECT_GT(apart, 100);
}

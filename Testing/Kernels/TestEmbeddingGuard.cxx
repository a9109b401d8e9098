#include "AdverseMotions.h"
#include "ExampleSurfaces.h"
#include "Geometry/ClosestDirection.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/EmbeddingGuard.h"
#include "Mesh/EdgeLength.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

using namespace FlipFree;

namespace
{

const Eigen::RowVector3d Center(10.0, -20.0, 30.0);

PointList Outward(const TestSphere& sphere)
{
  return sphere.Points().rowwise() - Center;
}

void ExpectValid(const ContourMesh& mesh, const PointList& before, const PointList& displacements)
{
  const PointList after = before + displacements;
  EXPECT_EQ(CountSelfIntersections(after, mesh.Faces), 0);
  EXPECT_EQ(CountFlippedCorners(mesh, before, after), 0);
}

void ExpectValidAllTheWay(const ContourMesh& mesh, const PointList& before,
  const PointList& displacements)
{
  for (int step = 1; step < 16; ++step)
  {
    const PointList between = before + step / 16.0 * displacements;
    EXPECT_EQ(CountSelfIntersections(between, mesh.Faces), 0) << "time " << step / 16.0;
    EXPECT_EQ(CountFlippedCorners(mesh, before, between), 0) << "time " << step / 16.0;
  }
  ExpectValid(mesh, before, displacements);
}

// The least distance of what must stay apart, pair by pair.
double MinimumGap(const ContourMesh& mesh, const PointList& points)
{
  const FaceHulls hulls(points, mesh.Faces);
  const auto cornersOf = [&](const Hull& hull)
  {
    return HullCorners{ { points.row(hull[0]), points.row(hull[1]), points.row(hull[2]),
      points.row(hull[3]) } };
  };
  const auto distanceOf = [&](const Hull& one, const Hull& two)
  { return ProvenDistance(cornersOf(one), cornersOf(two)); };
  double least = std::numeric_limits<double>::infinity();
  for (const HullPair& pair : AdjacentPairsOf(hulls))
  {
    least = std::min(least, distanceOf(pair.One, pair.Two));
  }
  for (int one = 0; one < hulls.NumberOfHulls(); ++one)
  {
    for (int two = one + 1; two < hulls.NumberOfHulls(); ++two)
    {
      if (hulls.AreDisjoint(one, two))
      {
        least = std::min(least, distanceOf(hulls.HullAt(one), hulls.HullAt(two)));
      }
    }
  }
  return least;
}

// Two sheets that all but lie on each other, across the third axis, and do not mirror each other.
struct ThinShape
{
  ThinShape()
    : Sphere(12)
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix();
    this->Points = Outward(this->Sphere) * turn.transpose();
    this->Height = this->Points.col(2) / 25;
    this->Points.col(2).setZero();
    this->EdgeLength = TypicalEdgeLength(this->Sphere.Mesh.Neighbors, this->Points);
    this->Points.col(2) = 0.025 * this->EdgeLength * this->Height;
  }
  // All go along the thin axis, on average by less than a third of an edge, but for one vertex of
  // the leading sheet, which goes back through the trailing one.
  PointList MotionAgainst(int vertex) const
  {
    PointList motion = PointList::Zero(this->Points.rows(), 3);
    motion.col(2).setConstant(0.2 * this->EdgeLength);
    motion(vertex, 2) *= -1;
    return motion;
  }

  TestSphere Sphere;
  PointList Points;
  Eigen::VectorXd Height; // -1 to 1
  double EdgeLength = 0;
};

std::string MessageOf(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST(EmbeddingGuard, LeavesValidMotionsAlone)
{
  std::mt19937 random(1);
  for (int n : { 1, 4, 8 })
  {
    const TestSphere sphere(n);
    EmbeddingGuard guard(sphere.Mesh);
    const PointList outward = Outward(sphere);
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    PointList flattened = outward;
    flattened.col(2) *= -0.95;
    flattened.leftCols(2).setZero();
    const PointList motions[] = { PointList::Zero(sphere.Points().rows(), 3), 3 * outward,
      -0.9 * outward, flattened, outward * turn.transpose() - outward,
      PointList::Constant(sphere.Points().rows(), 3, 500.0),
      WhiteNoise(sphere.Points().rows(), 0.05 * sphere.EdgeLength, random) };
    for (const PointList& motion : motions)
    {
      PointList displacements = motion;
      const GuardReport report = guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
      // But for the rounding to single precision.
      EXPECT_LT((displacements - motion).cwiseAbs().maxCoeff(), 1e-4);
      EXPECT_EQ(report.Guarded, 0);
      EXPECT_EQ(report.Passes, 1);
    }
  }
}

TEST(EmbeddingGuard, AdverseMotionsEndEmbedded)
{
  std::mt19937 random(2);
  int motions = 0;
  int guarded = 0;
  for (int n : { 4, 8, 16 })
  {
    const TestSphere sphere(n);
    EmbeddingGuard guard(sphere.Mesh);
    for (int repeat = 0; repeat < 400 / n; ++repeat)
    {
      for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
      {
        PointList displacements = AdverseMotion(kind, sphere.EdgeLength, sphere.Points(), random);
        const GuardReport report =
          guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
        ExpectValid(sphere.Mesh, sphere.Points(), displacements);
        ASSERT_FALSE(::testing::Test::HasFailure()) << "n " << n << ", kind " << kind;
        ++motions;
        guarded += report.Guarded > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(motions, 2000);
  EXPECT_GT(guarded, 2000);
}

// The way, not only its end: an inversion ends in a perfect sphere, inside out.
TEST(EmbeddingGuard, AdverseMotionsAreValidAllTheWay)
{
  std::mt19937 random(3);
  const TestSphere sphere(6);
  EmbeddingGuard guard(sphere.Mesh);
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    for (int repeat = 0; repeat < 4; ++repeat)
    {
      PointList displacements = AdverseMotion(kind, sphere.EdgeLength, sphere.Points(), random);
      guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
      EXPECT_FALSE(displacements.isZero(0)) << "kind " << kind;
      ExpectValidAllTheWay(sphere.Mesh, sphere.Points(), displacements);
      ASSERT_FALSE(::testing::Test::HasFailure()) << "kind " << kind;
    }
  }
}

// With as few vertices as this, most triangles are neighbors, or all.
TEST(EmbeddingGuard, SmallToriEndEmbedded)
{
  std::mt19937 random(9);
  const auto check = [&](const PointList& points, const ContourMesh& mesh, double edge)
  {
    ASSERT_EQ(mesh.EulerNumber(), 0);
    EmbeddingGuard guard(mesh);
    ASSERT_EQ(CountSelfIntersections(points, mesh.Faces), 0);
    for (int repeat = 0; repeat < 20; ++repeat)
    {
      PointList present = points;
      for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
      {
        PointList displacements = AdverseMotion(kind, edge, present, random);
        guard.Limit(present, displacements, SerialFor, NeverStop);
        ExpectValidAllTheWay(mesh, present, displacements);
        ASSERT_FALSE(::testing::Test::HasFailure())
          << mesh.NumberOfPoints() << " vertices, kind " << kind;
        if (repeat % 2 == 1)
        {
          present += displacements;
        }
      }
    }
  };
  for (int around : { 3, 4, 9 })
  {
    for (int across : { 3, 4 })
    {
      const TestTorus torus(around, across);
      check(torus.Points, torus.Mesh, 15.0);
    }
  }
}

// One step after the other, from ever worse surfaces.
TEST(EmbeddingGuard, SequencesOfAdverseMotionsStayEmbedded)
{
  std::mt19937 random(4);
  for (QuadSphereSpacing spacing : { QuadSphereSpacing::Equiangular, QuadSphereSpacing::Cube })
  {
    const TestSphere sphere(5, spacing);
    EmbeddingGuard guard(sphere.Mesh);
    for (int sequence = 0; sequence < 3; ++sequence)
    {
      PointList points = sphere.Points();
      for (int step = 0; step < 60; ++step)
      {
        PointList displacements = sequence == 0
          ? WhiteNoise(points.rows(), 0.3 * sphere.EdgeLength, random)
          : AdverseMotion((step * sequence) % NumberOfAdverseMotions, sphere.EdgeLength, points,
              random);
        guard.Limit(points, displacements, SerialFor, NeverStop);
        ExpectValid(sphere.Mesh, points, displacements);
        ASSERT_FALSE(::testing::Test::HasFailure()) << "sequence " << sequence << " step " << step;
        points += displacements;
      }
    }
  }
}

TEST(EmbeddingGuard, KeepsTheGap)
{
  std::mt19937 random(5);
  const TestSphere sphere(3);
  EmbeddingGuard guard(sphere.Mesh);
  const double edge = TypicalEdgeLength(sphere.Mesh.Neighbors, sphere.Points());
  ASSERT_GT(MinimumGap(sphere.Mesh, sphere.Points()), 0.1 * edge);
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    PointList displacements = AdverseMotion(kind, sphere.EdgeLength, sphere.Points(), random);
    guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
    EXPECT_GE(MinimumGap(sphere.Mesh, sphere.Points() + displacements), 0.999e-3 * edge)
      << "kind " << kind;
  }
}

// A file of single precision holds the very surface that was certified, vertices that are slowed
// down included; where its numbers are too coarse, positions are left as they are.
TEST(EmbeddingGuard, MovedVerticesEndAtSinglePrecision)
{
  std::mt19937 random(10);
  const TestSphere sphere(6);
  EmbeddingGuard guard(sphere.Mesh);
  for (double far : { 0.0, 1e3, 1e9 })
  {
    for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
    {
      const PointList from = sphere.Points().array() + far;
      PointList displacements = AdverseMotion(kind, sphere.EdgeLength, from, random);
      const PointList to = guard.Limit(from, displacements, SerialFor, NeverStop).Positions;
      EXPECT_TRUE(to.isApprox(from + displacements, 1e-15));
      // In two steps: GCC 12.2 may take a cast to float and back for nothing to do.
      const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> single = to.cast<float>();
      const PointList rounded = single.cast<double>();
      for (Eigen::Index vertex = 0; vertex < to.rows(); ++vertex)
      {
        ASSERT_TRUE(
          far > 1e6 || to.row(vertex) == rounded.row(vertex) || to.row(vertex) == from.row(vertex))
          << kind;
      }
      EXPECT_TRUE(far < 1e6 || displacements.isZero(0) || to != rounded);
    }
  }
}

// Sheets that lie nearer than the gap from the start: they may move, but not toward each other.
TEST(EmbeddingGuard, ThinSurfaces)
{
  std::mt19937 random(6);
  const TestSphere sphere(6);
  EmbeddingGuard guard(sphere.Mesh);
  for (double thickness : { 1e-3, 1e-6, 1e-9, 1e-12, 1e-14 })
  {
    PointList points = Outward(sphere);
    points.col(2) *= thickness;
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix();
    points = points * turn.transpose();
    if (CountSelfIntersections(points, sphere.Faces()) > 0)
    {
      EXPECT_LT(thickness, 1e-11); // rounding closed it
      continue;
    }
    const PointList normal = Eigen::VectorXd::Ones(points.rows()) * turn.col(2).transpose();
    const PointList motions[] = { PointList::Zero(points.rows(), 3), 3 * normal,
      WhiteNoise(points.rows(), 0.1 * sphere.EdgeLength, random) };
    for (const PointList& motion : motions)
    {
      PointList displacements = motion;
      guard.Limit(points, displacements, SerialFor, NeverStop);
      ExpectValid(sphere.Mesh, points, displacements);
    }
    PointList apart = Outward(sphere).col(2) * turn.col(2).transpose();
    guard.Limit(points, apart, SerialFor, NeverStop);
    EXPECT_EQ(CountSelfIntersections(points + apart, sphere.Faces()), 0);
  }
}

// Pairs that move together are apart throughout, until one of the two is held back: they must be
// tested again then, whichever it is.
TEST(EmbeddingGuard, WhatMovesTogetherIsTestedAgain)
{
  const ThinShape shape;
  EmbeddingGuard guard(shape.Sphere.Mesh);
  int tries = 0;
  for (int vertex = 0; vertex < shape.Points.rows(); vertex += 10)
  {
    if (shape.Height[vertex] < 0.5)
    {
      continue;
    }
    ++tries;
    const PointList motion = shape.MotionAgainst(vertex);
    PointList displacements = motion;
    const GuardReport report = guard.Limit(shape.Points, displacements, SerialFor, NeverStop);
    EXPECT_GT(report.Passes, 1);
    int heldOfTrailing = 0;
    for (int other = 0; other < shape.Points.rows(); ++other)
    {
      heldOfTrailing +=
        shape.Height[other] < -0.5 && displacements(other, 2) < motion(other, 2) ? 1 : 0;
    }
    EXPECT_GT(heldOfTrailing, 0);
    ExpectValidAllTheWay(shape.Sphere.Mesh, shape.Points, displacements);
    ASSERT_FALSE(::testing::Test::HasFailure()) << "vertex " << vertex;
  }
  EXPECT_GT(tries, 10);
}

TEST(EmbeddingGuard, HoldsBackOnlyNearTheTrouble)
{
  const TestSphere sphere(16);
  EmbeddingGuard guard(sphere.Mesh);
  PointList displacements = PointList::Constant(sphere.Points().rows(), 3, 1.0);
  // One vertex is pushed through the opposite side.
  displacements.row(0) -= 3 * Outward(sphere).row(0);
  const GuardReport report = guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
  EXPECT_GT(report.Guarded, 0);
  EXPECT_LT(report.Guarded, 40);
  ExpectValid(sphere.Mesh, sphere.Points(), displacements);
}

TEST(EmbeddingGuard, TheNumberOfThreadsDoesNotMatter)
{
  std::mt19937 random(7);
  const TestSphere sphere(8);
  EmbeddingGuard guard(sphere.Mesh);
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    PointList one = AdverseMotion(kind, sphere.EdgeLength, sphere.Points(), random);
    PointList two = one;
    const GuardReport reportOne = guard.Limit(sphere.Points(), one, SerialFor, NeverStop);
    const GuardReport reportTwo = guard.Limit(sphere.Points(), two, ScatteredFor, NeverStop);
    EXPECT_EQ(one, two);
    EXPECT_EQ(reportOne.Guarded, reportTwo.Guarded);
    EXPECT_EQ(reportOne.Passes, reportTwo.Passes);
  }
}

TEST(EmbeddingGuard, StoppedFromOutsideItLeavesNoMotion)
{
  const TestSphere sphere(4);
  PointList displacements = -2 * Outward(sphere);
  EmbeddingGuard(sphere.Mesh)
    .Limit(sphere.Points(), displacements, SerialFor, [](double) { return false; });
  EXPECT_TRUE(displacements.isZero(0));
}

TEST(EmbeddingGuard, RefusesWhatIsNotFinite)
{
  const TestSphere sphere(4);
  EmbeddingGuard guard(sphere.Mesh);
  const PointList zero = PointList::Zero(sphere.Points().rows(), 3);
  const auto messageOf = [&](const PointList& points, PointList displacements)
  { return MessageOf([&] { guard.Limit(points, displacements, SerialFor, NeverStop); }); };
  EXPECT_NE(messageOf(sphere.Points(), PointList::Zero(3, 3)).find("expected 96"),
    std::string::npos);
  for (double bad :
    { std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity() })
  {
    PointList displacements = zero;
    displacements(17, 1) = bad;
    EXPECT_NE(messageOf(sphere.Points(), displacements).find("displacement of vertex 17"),
      std::string::npos);
    PointList points = sphere.Points();
    points(3, 2) = bad;
    EXPECT_NE(messageOf(points, zero).find("position of vertex 3"), std::string::npos);
  }
}

TEST(EmbeddingGuard, RefusesAStartThatIntersectsItself)
{
  std::mt19937 random(8);
  const TestSphere sphere(4);
  EmbeddingGuard guard(sphere.Mesh);
  PointList crossed = sphere.Points();
  crossed.row(5) += 3 * (Center - crossed.row(5));
  const PointList rest = PointList::Zero(crossed.rows(), 3);
  for (const PointList& motion : { rest, WhiteNoise(crossed.rows(), 0.01, random) })
  {
    const auto messageAt = [&](const PointList& points)
    {
      PointList displacements = motion;
      return MessageOf([&] { guard.Limit(points, displacements, SerialFor, NeverStop); });
    };
    EXPECT_EQ(messageAt(sphere.Points()), "accepted");
    const std::string message = messageAt(crossed);
    EXPECT_NE(message.find("intersects itself before it is moved"), std::string::npos) << message;
    EXPECT_NE(message.find("pairs of faces"), std::string::npos) << message;
    EXPECT_NE(message.find("start from"), std::string::npos) << message;
  }
}

TEST(EmbeddingGuard, TestsWhatItHasNotProven)
{
  const TestSphere sphere(4);
  EmbeddingGuard guard(sphere.Mesh);
  PointList motion = 0.1 * Outward(sphere);
  const PointList ended = guard.Limit(sphere.Points(), motion, SerialFor, NeverStop).Positions;
  PointList crossed = ended;
  crossed.row(5) += 3 * (Center - crossed.row(5));
  const PointList rest = PointList::Zero(ended.rows(), 3);
  const auto messageAt = [&](const PointList& points)
  {
    PointList displacements = rest;
    return MessageOf([&] { guard.Limit(points, displacements, SerialFor, NeverStop); });
  };
  EXPECT_NE(messageAt(crossed).find("intersects itself"), std::string::npos);
  // A step that is given up proves nothing of where it began.
  PointList inward = -2 * Outward(sphere);
  guard.Limit(crossed, inward, SerialFor, [](double) { return false; });
  EXPECT_NE(messageAt(crossed).find("intersects itself"), std::string::npos);
  EXPECT_EQ(messageAt(ended), "accepted");
}

TEST(EmbeddingGuard, GivesTheSameStepsAsNewGuards)
{
  std::mt19937 random(11);
  const TestSphere sphere(5);
  EmbeddingGuard guard(sphere.Mesh);
  PointList points = sphere.Points();
  for (int step = 0; step < 5; ++step)
  {
    PointList motion = WhiteNoise(points.rows(), 0.5, random);
    motion.topRows(points.rows() / 2).setZero();
    PointList same = motion;
    const PointList to = guard.Limit(points, motion, SerialFor, NeverStop).Positions;
    EXPECT_EQ(EmbeddingGuard(sphere.Mesh).Limit(points, same, SerialFor, NeverStop).Positions, to);
    points = to;
  }
  EXPECT_NE(points, sphere.Points());
}

// Corners alone hold this vertex back: no pair of triangles is seen to move.
TEST(EmbeddingGuard, RefusesAStartThatIntersectsItselfWhereCornersStopTheMotion)
{
  const TestSphere sphere(6);
  EmbeddingGuard guard(sphere.Mesh);
  PointList points = sphere.Points();
  const Eigen::RowVector3d center = points.colwise().mean();
  const int vertex = 20;
  points.row(vertex) = center - 1.3 * (points.row(vertex) - center);
  ASSERT_GT(CountSelfIntersections(points, sphere.Faces()), 0);
  for (double length : { 1.0, 3000.0, 6000.0 })
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      PointList motion = PointList::Zero(points.rows(), 3);
      motion(vertex, direction % 3) = direction < 3 ? length : -length;
      EXPECT_THROW(guard.Limit(points, motion, SerialFor, NeverStop), std::invalid_argument)
        << length << " in direction " << direction;
    }
  }
}

TEST(EmbeddingGuard, RefusesFacesThatShareADiagonal)
{
  const ContourMesh mesh = BuildContourMesh(16, NeckOfTwoFaces().Faces);
  EXPECT_NE(ErrorOf([&] { EmbeddingGuard guard(mesh); })
              .find("faces 0 and 1 share more than a vertex or an edge: both can be cut along"),
    std::string::npos);
}

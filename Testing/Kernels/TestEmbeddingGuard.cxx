#include "EmbeddingGuard.h"
#include "RandomMotions.h"
#include "SelfIntersection.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <thread>

using namespace FlipFree;

namespace
{

// Corners of the faces, and triangles, whose normal turned by 90 degrees or more.
int CountFlippedCorners(const ContourMesh& mesh, const PointList& before, const PointList& after)
{
  const auto normal = [](const PointList& points, int a, int v, int b) -> Eigen::RowVector3d
  {
    return Eigen::RowVector3d(points.row(b) - points.row(v))
      .cross(Eigen::RowVector3d(points.row(a) - points.row(v)));
  };
  int count = 0;
  const auto check = [&](int a, int v, int b)
  { count += normal(before, a, v, b).dot(normal(after, a, v, b)) > 0 ? 0 : 1; };
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int* vertices = mesh.Faces.Face(face);
    const int size = mesh.Faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      check(vertices[(corner + size - 1) % size], vertices[corner], vertices[(corner + 1) % size]);
    }
  }
  for (Eigen::Index row = 0; row < mesh.Triangles.rows(); ++row)
  {
    check(mesh.Triangles(row, 0), mesh.Triangles(row, 1), mesh.Triangles(row, 2));
  }
  return count;
}

void ExpectValid(const ContourMesh& mesh, const PointList& before, const PointList& displacements)
{
  const PointList after = before + displacements;
  EXPECT_EQ(CountSelfIntersections(after, mesh.Triangles), 0);
  EXPECT_EQ(CountFlippedCorners(mesh, before, after), 0);
}

void Halves(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  const std::ptrdiff_t middle = begin + (end - begin) / 3;
  std::thread other([&] { body(begin, middle); });
  body(middle, end);
  other.join();
}

} // namespace

TEST(EmbeddingGuard, LeavesValidMotionsAlone)
{
  std::mt19937 random(1);
  for (int n : { 1, 4, 8 })
  {
    const TestSphere sphere(n);
    const EmbeddingGuard guard(sphere.Mesh);
    const PointList outward = sphere.Points().rowwise() - Eigen::RowVector3d(10, -20, 30);
    const PointList motions[] = { PointList::Zero(sphere.Points().rows(), 3), 3 * outward,
      -0.9 * outward, PointList::Constant(sphere.Points().rows(), 3, 500.0),
      WhiteNoise(sphere.Points().rows(), 0.05 * sphere.EdgeLength, random) };
    for (const PointList& motion : motions)
    {
      PointList displacements = motion;
      const GuardReport report = guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
      EXPECT_EQ(displacements, motion);
      EXPECT_EQ(report.HeldBack, 0);
      EXPECT_EQ(report.Passes, 1);
    }
  }
}

TEST(EmbeddingGuard, RandomMotionsEndEmbedded)
{
  std::mt19937 random(2);
  for (int n : { 4, 8 })
  {
    const TestSphere sphere(n);
    const EmbeddingGuard guard(sphere.Mesh);
    for (double noise : { 0.1, 0.3, 0.5, 1.0, 2.0, 5.0 })
    {
      PointList points = sphere.Points();
      for (int step = 0; step < 10; ++step)
      {
        PointList displacements = WhiteNoise(points.rows(), noise * sphere.EdgeLength, random);
        guard.Limit(points, displacements, SerialFor, NeverStop);
        ExpectValid(sphere.Mesh, points, displacements);
        points += displacements;
      }
    }
  }
}

TEST(EmbeddingGuard, InversionAndCollapseEndEmbedded)
{
  for (int n : { 4, 8 })
  {
    const TestSphere sphere(n);
    const EmbeddingGuard guard(sphere.Mesh);
    const PointList outward = sphere.Points().rowwise() - Eigen::RowVector3d(10, -20, 30);
    const PointList equalTargets = (-sphere.Points()).rowwise() + Eigen::RowVector3d(13, -22, 50);
    for (const PointList& motion : { PointList(-2 * outward), PointList(-outward), equalTargets })
    {
      PointList displacements = motion;
      guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
      EXPECT_FALSE(displacements.isZero(0));
      ExpectValid(sphere.Mesh, sphere.Points(), displacements);
    }
    PointList displacements = equalTargets;
    const GuardReport report = guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
    EXPECT_EQ(report.HeldBack, sphere.Points().rows());
    EXPECT_GT(report.Passes, 1);
  }
}

TEST(EmbeddingGuard, HoldsBackOnlyNearTheTrouble)
{
  const TestSphere sphere(16);
  const EmbeddingGuard guard(sphere.Mesh);
  PointList displacements = PointList::Constant(sphere.Points().rows(), 3, 1.0);
  // One vertex is pushed through the opposite side.
  const Eigen::RowVector3d outward = sphere.Points().row(0) - Eigen::RowVector3d(10, -20, 30);
  displacements.row(0) -= 3 * outward;
  const GuardReport report = guard.Limit(sphere.Points(), displacements, SerialFor, NeverStop);
  EXPECT_GT(report.HeldBack, 0);
  EXPECT_LT(report.HeldBack, sphere.Points().rows() / 4);
  ExpectValid(sphere.Mesh, sphere.Points(), displacements);
}

TEST(EmbeddingGuard, TheNumberOfThreadsDoesNotMatter)
{
  std::mt19937 random(3);
  const TestSphere sphere(8);
  const EmbeddingGuard guard(sphere.Mesh);
  for (double noise : { 0.1, 1.0, 3.0 })
  {
    PointList one = WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
    PointList two = one;
    guard.Limit(sphere.Points(), one, SerialFor, NeverStop);
    guard.Limit(sphere.Points(), two, Halves, NeverStop);
    EXPECT_EQ(one, two);
  }
}

TEST(EmbeddingGuard, StoppedFromOutsideItLeavesNoMotion)
{
  const TestSphere sphere(4);
  std::mt19937 random(4);
  PointList displacements = WhiteNoise(sphere.Points().rows(), 3 * sphere.EdgeLength, random);
  EmbeddingGuard(sphere.Mesh)
    .Limit(sphere.Points(), displacements, SerialFor, [](double) { return false; });
  EXPECT_TRUE(displacements.isZero(0));
}

TEST(EmbeddingGuard, RefusesWhatItCannotGuard)
{
  const TestSphere sphere(4);
  const EmbeddingGuard guard(sphere.Mesh);
  const auto messageOf = [&](const PointList& points, PointList displacements) -> std::string
  {
    try
    {
      guard.Limit(points, displacements, SerialFor, NeverStop);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "accepted";
  };
  const PointList zero = PointList::Zero(sphere.Points().rows(), 3);

  EXPECT_NE(messageOf(sphere.Points(), PointList::Zero(3, 3)).find("3 displacements"),
    std::string::npos);
  for (double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    PointList displacements = zero;
    displacements(17, 1) = bad;
    EXPECT_NE(messageOf(sphere.Points(), displacements).find("vertex 17 is not finite"),
      std::string::npos);
  }

  PointList crossed = sphere.Points();
  crossed.row(5) += 3 * (Eigen::RowVector3d(10, -20, 30) - crossed.row(5));
  EXPECT_NE(messageOf(crossed, zero).find("before it is moved"), std::string::npos);
}

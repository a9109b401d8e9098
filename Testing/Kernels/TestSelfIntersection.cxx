#include "Geometry/SelfIntersection.h"
#include "Geometry/TriangleIntersection.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

using namespace FlipFree;

namespace
{

using PairList = std::vector<std::pair<int, int>>;

PairList BruteForce(const PointList& points, const TriangleList& triangles)
{
  PairList pairs;
  for (int one = 0; one < triangles.rows(); ++one)
  {
    for (int two = one + 1; two < triangles.rows(); ++two)
    {
      if (TrianglesIntersect(points, triangles, one, two))
      {
        pairs.emplace_back(one, two);
      }
    }
  }
  return pairs;
}

bool Intersect(std::initializer_list<std::array<double, 3>> positions,
  const TriangleList& triangles)
{
  PointList points(static_cast<Eigen::Index>(positions.size()), 3);
  Eigen::Index row = 0;
  for (const auto& position : positions)
  {
    points.row(row++) << position[0], position[1], position[2];
  }
  const bool result = TrianglesIntersect(points, triangles, 0, 1);
  EXPECT_EQ(TrianglesIntersect(points, triangles, 1, 0), result);
  return result;
}

TriangleList Pair(std::array<int, 3> one, std::array<int, 3> two)
{
  TriangleList triangles(2, 3);
  triangles << one[0], one[1], one[2], two[0], two[1], two[2];
  return triangles;
}

// Two threads that share the range alternately, in small parts.
void TwoThreads(std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
{
  const auto work = [&](std::ptrdiff_t first)
  {
    for (std::ptrdiff_t i = first; i < end; i += 6)
    {
      body(i, std::min(end, i + 3));
    }
  };
  std::thread other(work, begin + 3);
  work(begin);
  other.join();
}

} // namespace

TEST(TriangleIntersection, WithoutSharedVertices)
{
  const TriangleList separate = Pair({ 0, 1, 2 }, { 3, 4, 5 });
  // Through the interior, touching by a vertex, just apart.
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, -1 }, { 1, 1, 1 }, { 9, 9, 1 } }, separate));
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 9, 9, 1 } }, separate));
  EXPECT_FALSE(
    Intersect({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 1e-300 }, { 1, 1, 1 }, { 9, 9, 1 } },
      separate));
  // Coplanar: overlapping, one inside the other, touching, apart.
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 0 }, { 5, 1, 0 }, { 5, 5, 0 } }, separate));
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 1, 1, 0 }, { 2, 1, 0 }, { 1, 2, 0 } }, separate));
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 2, 0 }, { 5, 2, 0 }, { 5, 5, 0 } }, separate));
  EXPECT_FALSE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 3, 2, 0 }, { 5, 2, 0 }, { 5, 5, 0 } }, separate));
  // In the plane's reach, but beside the triangle.
  EXPECT_FALSE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 3, 3, -1 }, { 3, 3, 1 }, { 9, 9, 1 } }, separate));
}

TEST(TriangleIntersection, WithOneSharedVertex)
{
  const TriangleList fan = Pair({ 0, 1, 2 }, { 0, 3, 4 });
  EXPECT_FALSE(
    Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 1 } }, fan));
  // The opposite edge of one goes through the other.
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 1 }, { 1, 1, -1 } }, fan));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 3, 3, 1 }, { 3, 3, -1 } }, fan));
  // Coplanar: apart, overlapping, along one line.
  EXPECT_FALSE(
    Intersect({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { -4, 0, 0 }, { 0, -4, 0 } }, fan));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 1, 0 }, { 1, 2, 0 } }, fan));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 0, 0 }, { 0, -4, 1 } }, fan));
}

TEST(TriangleIntersection, WithASharedEdge)
{
  const TriangleList hinge = Pair({ 0, 1, 2 }, { 1, 0, 3 });
  EXPECT_FALSE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } }, hinge));
  EXPECT_FALSE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1e-300 } }, hinge));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 3, 0 } }, hinge));
  // Without area.
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 0, 0 } }, hinge));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 3, 0, 0 }, { 5, 2, 1 } }, hinge));
}

TEST(TriangleIntersection, WithoutArea)
{
  const TriangleList separate = Pair({ 0, 1, 2 }, { 3, 4, 5 });
  // A segment through a triangle, a segment beside it, a point in it.
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, -1 }, { 1, 1, 2 }, { 1, 1, 1 } }, separate));
  EXPECT_FALSE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 3, 3, -1 }, { 3, 3, 2 }, { 3, 3, 1 } }, separate));
  EXPECT_TRUE(Intersect(
    { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 0 }, { 1, 1, 0 }, { 1, 1, 0 } }, separate));
}

TEST(SelfIntersection, EmbeddedSurfacesHaveNone)
{
  for (int n : { 1, 2, 3, 8, 32 })
  {
    for (QuadSphereSpacing spacing :
      { QuadSphereSpacing::Equiangular, QuadSphereSpacing::Radial, QuadSphereSpacing::Cube })
    {
      const TestSphere sphere(n, spacing);
      EXPECT_EQ(CountSelfIntersections(sphere.Points(), sphere.Triangles()), 0) << "n " << n;
    }
  }
  EXPECT_EQ(CountSelfIntersections(PointList(0, 3), TriangleList(0, 3)), 0);
}

TEST(SelfIntersection, TreeFindsWhatBruteForceFinds)
{
  std::mt19937 random(4);
  std::size_t total = 0;
  for (int repeat = 0; repeat < 2000; ++repeat)
  {
    const TestSphere sphere(1 + repeat % 4);
    const double noise = 0.3 + 0.2 * (repeat % 7);
    const PointList points =
      sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
    const PairList expected = BruteForce(points, sphere.Triangles());
    ASSERT_EQ(FindSelfIntersections(points, sphere.Triangles()), expected) << "mesh " << repeat;
    total += expected.size();
  }
  EXPECT_GT(total, 10000u);
}

TEST(SelfIntersection, AnyTreeAndAnyNumberOfThreadsGivesTheSame)
{
  std::mt19937 random(5);
  const TestSphere sphere(12);
  const TriangleTree tree(
    TriangleTree::TopologicalLayout(sphere.Mesh.NumberOfPoints(), sphere.Triangles()),
    sphere.Triangles());
  EXPECT_EQ(tree.NumberOfTriangles(), sphere.Triangles().rows());
  for (double noise : { 0.0, 0.6, 2.0 })
  {
    const PointList points =
      sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
    const PairList expected = FindSelfIntersections(points, sphere.Triangles());
    EXPECT_EQ(FindSelfIntersections(tree, points, sphere.Triangles(), SerialFor), expected);
    EXPECT_EQ(FindSelfIntersections(tree, points, sphere.Triangles(), TwoThreads), expected);
  }
}

// A surface collapsed to a point, a line or a plane is not embedded.
TEST(SelfIntersection, CollapsedSurfacesDoNotHide)
{
  const TestSphere sphere(3);
  for (int keptAxes = 0; keptAxes < 3; ++keptAxes)
  {
    PointList points = sphere.Points();
    points.rightCols(3 - keptAxes).setZero();
    const PairList pairs = FindSelfIntersections(points, sphere.Triangles());
    std::set<int> involved;
    for (const auto& pair : pairs)
    {
      involved.insert(pair.first);
      involved.insert(pair.second);
    }
    EXPECT_EQ(static_cast<Eigen::Index>(involved.size()), sphere.Triangles().rows());
  }
}

TEST(TriangleTree, QueryReachesExactlyTheTouchedTriangles)
{
  std::mt19937 random(6);
  const TestSphere sphere(6);
  const TriangleTree tree(sphere.Points(), sphere.Triangles());
  const std::vector<TriangleBox> boxes = tree.RefitBoxes(sphere.Points(), sphere.Triangles());
  for (int repeat = 0; repeat < 100; ++repeat)
  {
    const PointList ends = WhiteNoise(2, 40.0, random).rowwise() + Eigen::RowVector3d(10, -20, 30);
    TriangleBox window;
    window.Add(ends.row(0).data());
    window.Add(ends.row(1).data());
    std::set<int> found;
    tree.Query([&](int node) { return boxes[node].Touches(window); },
      [&](int triangle) { EXPECT_TRUE(found.insert(triangle).second); });
    std::set<int> expected;
    for (int triangle = 0; triangle < sphere.Triangles().rows(); ++triangle)
    {
      TriangleBox box;
      for (int corner = 0; corner < 3; ++corner)
      {
        box.Add(sphere.Points().row(sphere.Triangles()(triangle, corner)).data());
      }
      if (box.Touches(window))
      {
        expected.insert(triangle);
      }
    }
    EXPECT_EQ(found, expected);
  }
}

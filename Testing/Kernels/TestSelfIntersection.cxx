#include "ExampleSurfaces.h"
#include "Geometry/HullIntersection.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/SurfaceTopology.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace FlipFree;

namespace
{

using PairList = std::vector<std::pair<int, int>>;

using Corners = std::vector<int>;

bool Meet(const PointList& points, const Corners& one, const Corners& two)
{
  const auto hullOf = [](const Corners& corners)
  {
    const auto at = [&](std::size_t i) { return corners[std::min(i, corners.size() - 1)]; };
    return Hull{ { at(0), at(1), at(2), at(3) } };
  };
  const bool result = HullsMeet(points, hullOf(one), hullOf(two));
  EXPECT_EQ(HullsMeet(points, hullOf(two), hullOf(one)), result);
  return result;
}

// Whether two triangles have more in common than the hull of their common vertices: then parts of
// them without a common vertex meet.
bool TrianglesIntersect(const PointList& points, const Corners& one, const Corners& two)
{
  Corners common;
  Corners alone;
  for (int vertex : one)
  {
    (std::find(two.begin(), two.end(), vertex) != two.end() ? common : alone).push_back(vertex);
  }
  for (unsigned int subset = 0; subset < 1U << common.size(); ++subset)
  {
    Corners first = alone;
    Corners second = two;
    for (std::size_t i = 0; i < common.size(); ++i)
    {
      if ((subset >> i & 1U) != 0)
      {
        first.push_back(common[i]);
        second.erase(std::find(second.begin(), second.end(), common[i]));
      }
    }
    if (!first.empty() && !second.empty() && Meet(points, first, second))
    {
      return true;
    }
  }
  return false;
}

// The triangles of a quad by either diagonal, or the triangle itself.
std::vector<std::array<Corners, 2>> CutsOf(const FaceList& faces, int face)
{
  const int* const v = faces.Face(face);
  if (faces.FaceSize(face) == 3)
  {
    return { { { { v[0], v[1], v[2] }, { v[0], v[1], v[2] } } } };
  }
  return { { { { v[0], v[1], v[2] }, { v[0], v[2], v[3] } } },
    { { { v[1], v[2], v[3] }, { v[1], v[3], v[0] } } } };
}

// From the definition: all cuts of all pairs of faces.
PairList BruteForce(const PointList& points, const FaceList& faces)
{
  PairList pairs;
  for (int one = 0; one < faces.NumberOfFaces(); ++one)
  {
    for (int two = one; two < faces.NumberOfFaces(); ++two)
    {
      bool intersect = false;
      for (const auto& cut : CutsOf(faces, one))
      {
        if (one == two)
        {
          intersect = intersect || (cut[0] != cut[1] && TrianglesIntersect(points, cut[0], cut[1]));
          continue;
        }
        for (const auto& other : CutsOf(faces, two))
        {
          for (int pair = 0; pair < 4; ++pair)
          {
            intersect = intersect || TrianglesIntersect(points, cut[pair / 2], other[pair % 2]);
          }
        }
      }
      if (intersect)
      {
        pairs.emplace_back(one, two);
      }
    }
  }
  return pairs;
}

using Positions = std::initializer_list<std::array<double, 3>>;

PointList PointsAt(const Positions& positions)
{
  PointList points(static_cast<Eigen::Index>(positions.size()), 3);
  Eigen::Index row = 0;
  for (const auto& position : positions)
  {
    points.row(row++) << position[0], position[1], position[2];
  }
  return points;
}

bool Intersect(const Positions& positions, const TriangleList& triangles)
{
  const PointList points = PointsAt(positions);
  const FaceList faces = FacesOf(triangles);
  const bool result = CountSelfIntersections(points, faces) > 0;
  EXPECT_EQ(!BruteForce(points, faces).empty(), result);
  return result;
}

TriangleList Pair(std::array<int, 3> one, std::array<int, 3> two)
{
  TriangleList triangles(2, 3);
  triangles << one[0], one[1], one[2], two[0], two[1], two[2];
  return triangles;
}

} // namespace

TEST(HullIntersection, WithoutSharedVertices)
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

TEST(HullIntersection, WithOneSharedVertex)
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

TEST(HullIntersection, WithASharedEdge)
{
  const TriangleList hinge = Pair({ 0, 1, 2 }, { 1, 0, 3 });
  EXPECT_FALSE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } }, hinge));
  EXPECT_FALSE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1e-300 } }, hinge));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 3, 0 } }, hinge));
  // Without area.
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 0, 0 } }, hinge));
  EXPECT_TRUE(Intersect({ { 0, 0, 0 }, { 1, 0, 0 }, { 3, 0, 0 }, { 5, 2, 1 } }, hinge));
}

TEST(HullIntersection, WithoutArea)
{
  const auto meet = [](const Positions& positions) {
    return Meet(PointsAt(positions), { 0, 1, 2 }, { 3, 4, 5 });
  };
  // A segment through a triangle, a segment beside it, a point in it.
  EXPECT_TRUE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, -1 }, { 1, 1, 2 }, { 1, 1, 1 } }));
  EXPECT_FALSE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 3, 3, -1 }, { 3, 3, 2 }, { 3, 3, 1 } }));
  EXPECT_TRUE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 0 }, { 1, 1, 0 }, { 1, 1, 0 } }));
  // Two segments: crossing, skew, in one plane but beside each other, on one line.
  EXPECT_TRUE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 0, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { 1, 1, 0 } }));
  EXPECT_FALSE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 0, 0 }, { 1, -1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }));
  EXPECT_FALSE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 0, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 1, 2, 0 } }));
  EXPECT_TRUE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 0, 0 }, { 3, 0, 0 }, { 5, 0, 0 }, { 6, 0, 0 } }));
  EXPECT_FALSE(
    meet({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 0, 0 }, { 5, 0, 0 }, { 6, 0, 0 }, { 7, 0, 0 } }));
}

// The triangle by itself is enough to tell.
TEST(SelfIntersection, ATriangleWithoutAreaIsNamed)
{
  const PairList itself{ { 0, 0 } };
  TriangleList triangle(1, 3);
  triangle << 0, 1, 2;
  EXPECT_EQ(
    FindSelfIntersections(PointsAt({ { 0, 0, 0 }, { 3, 3, 3 }, { 1, 1, 1 } }), FacesOf(triangle)),
    itself);
}

TEST(SelfIntersection, EmbeddedSurfacesHaveNone)
{
  for (int n : { 1, 2, 3, 8, 32 })
  {
    for (QuadSphereSpacing spacing :
      { QuadSphereSpacing::Equiangular, QuadSphereSpacing::Radial, QuadSphereSpacing::Cube })
    {
      const TestSphere sphere(n, spacing);
      EXPECT_EQ(CountSelfIntersections(sphere.Points(), sphere.Faces()), 0) << "n " << n;
    }
  }
  EXPECT_EQ(CountSelfIntersections(PointList(0, 3), FaceList()), 0);
}

TEST(SelfIntersection, TreeFindsWhatBruteForceFinds)
{
  std::mt19937 random(4);
  std::size_t total = 0;
  for (int repeat = 0; repeat < 300; ++repeat)
  {
    const TestSphere sphere(1 + repeat % 4);
    const double noise = 0.3 + 0.2 * (repeat % 7);
    const PointList points =
      sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
    const PairList expected = BruteForce(points, sphere.Faces());
    ASSERT_EQ(FindSelfIntersections(points, sphere.Faces()), expected) << "mesh " << repeat;
    total += expected.size();
  }
  EXPECT_GT(total, 10000u);
}

TEST(SelfIntersection, AnyTreeAndAnyNumberOfThreadsGivesTheSame)
{
  std::mt19937 random(5);
  const TestSphere sphere(12);
  const FaceHulls hulls(
    TriangleTree::TopologicalLayout(sphere.Mesh.NumberOfPoints(), sphere.Faces()), sphere.Faces());
  EXPECT_EQ(hulls.Tree().NumberOfElements(), sphere.Faces().NumberOfFaces());
  for (double noise : { 0.0, 0.6, 2.0 })
  {
    const PointList points =
      sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
    const PairList expected = FindSelfIntersections(points, sphere.Faces());
    EXPECT_EQ(FindSelfIntersections(points, hulls), expected);
    EXPECT_EQ(FindSelfIntersections(points, hulls, ScatteredFor), expected);
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
    const PairList pairs = FindSelfIntersections(points, sphere.Faces());
    std::set<int> involved;
    for (const auto& pair : pairs)
    {
      involved.insert(pair.first);
      involved.insert(pair.second);
    }
    EXPECT_EQ(static_cast<int>(involved.size()), sphere.Faces().NumberOfFaces());
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

// Nothing meets that should not, but an edge would belong to four triangles.
TEST(SelfIntersection, FindsFacesThatShareADiagonal)
{
  const PolygonMesh neck = NeckOfTwoFaces();
  const PairList expected{ { 0, 1 }, { 2, 3 }, { 10, 11 } };
  EXPECT_EQ(FindSelfIntersections(neck.Points, neck.Faces), expected);
  const SurfaceTopology whole = MeasureTopology(neck.Faces, CollectEdges(16, neck.Faces));
  EXPECT_EQ(whole.BoundaryEdges + whole.NonManifoldEdges + whole.MisorientedEdges, 0);
  const FaceList cut = FacesOf(Triangulate(neck.Faces));
  EXPECT_EQ(MeasureTopology(cut, CollectEdges(16, cut)).NonManifoldEdges, 1);
}

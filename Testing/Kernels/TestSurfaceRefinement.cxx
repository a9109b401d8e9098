// From a coarse surface that the guard has just been able to keep embedded to a finer one.
#include "AdverseMotions.h"
#include "ExampleSurfaces.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/SurfaceGap.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/SurfaceRefinement.h"
#include "Mesh/EdgeLength.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

using namespace FlipFree;

namespace
{

// A sphere after some adverse motions, as far as the guard lets them go.
PointList Crumpled(const TestSphere& sphere, int kind, int steps, std::mt19937& random)
{
  EmbeddingGuard guard(sphere.Mesh);
  PointList points = sphere.Points();
  for (int step = 0; step < steps; ++step)
  {
    PointList motion = AdverseMotion(kind, sphere.EdgeLength, points, random);
    guard.Limit(points, motion, SerialFor, NeverStop);
    points += motion;
  }
  return points;
}

} // namespace

TEST(SurfaceRefinement, CrumpledSurfacesStayEmbeddedAndKeepAGap)
{
  std::mt19937 random(9);
  const TestSphere sphere(6);
  int uncheckedIntersect = 0;
  int embedded = 0;
  const int kinds[] = { 0, 1, 3, 5, 7, 8, 9, 13 };
  for (int kind : kinds)
  {
    const PointList points = Crumpled(sphere, kind, 8, random);
    const RefinedSurface unchecked =
      RefineSurface(sphere.Mesh, points, false, SerialFor, NeverStop);
    uncheckedIntersect +=
      CountSelfIntersections(unchecked.Points, unchecked.Mesh.Faces) > 0 ? 1 : 0;

    const RefinedSurface refined = RefineSurface(sphere.Mesh, points, true, SerialFor, NeverStop);
    if (!refined.Embedded)
    {
      continue;
    }
    ++embedded;
    EXPECT_EQ(refined.Mesh.NumberOfPoints(), 4 * sphere.Mesh.NumberOfPoints());
    EXPECT_EQ(CountSelfIntersections(refined.Points, refined.Mesh.Faces), 0)
      << AdverseMotionNames[kind];
    EXPECT_GE(MeasureMinimumGap(refined.Points, FaceHulls(refined.Points, refined.Mesh.Faces)),
      0.999e-4 * TypicalEdgeLength(sphere.Mesh.Neighbors, points))
      << AdverseMotionNames[kind];
  }
  EXPECT_GE(uncheckedIntersect, 1);
  EXPECT_GE(embedded, 6);
}

// What it remembers of the search before must be what a search of everything finds.
TEST(SurfaceRefinement, NearPairsAreFoundAgainAfterAPartHasMoved)
{
  std::mt19937 random(4);
  const TestSphere sphere(6);
  PointList points = Crumpled(sphere, 0, 6, random);
  const FaceHulls hulls(points, sphere.Mesh.Faces);
  const std::vector<HullPair> adjacent = AdjacentPairsOf(hulls);
  const double gap = 0.2 * sphere.EdgeLength;
  const auto sorted = [](const std::vector<HullPair>& pairs)
  {
    std::vector<std::pair<Hull, Hull>> hullsOfPairs;
    for (const HullPair& pair : pairs)
    {
      hullsOfPairs.emplace_back(pair.One, pair.Two);
    }
    std::sort(hullsOfPairs.begin(), hullsOfPairs.end());
    return hullsOfPairs;
  };
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  NearPairSearch search(gap, hulls, adjacent);
  std::set<std::size_t> counts;
  for (int round = 0; round < 12; ++round)
  {
    const auto found = sorted(search.Find(points, SerialFor));
    EXPECT_EQ(found, sorted(FindPairsNearerThan(gap, points, hulls, adjacent, SerialFor))) << round;
    EXPECT_GT(found.size(), 0U);
    counts.insert(found.size());
    // Some vertices, in the last rounds all of them, and at times none.
    const int step = round > 9 ? 1 : 23;
    for (Eigen::Index vertex = round % 23; round % 4 != 3 && vertex < points.rows(); vertex += step)
    {
      points.row(vertex) +=
        Eigen::RowVector3d(shift(random), shift(random), shift(random)) * sphere.EdgeLength;
    }
  }
  EXPECT_GT(counts.size(), 5U); // the search had something to find
}

TEST(SurfaceRefinement, SmoothSurfacesNeedNothing)
{
  const TestSphere sphere(6);
  const RefinedSurface unchecked =
    RefineSurface(sphere.Mesh, sphere.Points(), false, SerialFor, NeverStop);
  const RefinedSurface refined =
    RefineSurface(sphere.Mesh, sphere.Points(), true, SerialFor, NeverStop);
  EXPECT_TRUE(refined.Embedded);
  EXPECT_EQ(refined.Relaxations, 0);
  EXPECT_LT((refined.Points - unchecked.Points).cwiseAbs().maxCoeff(), 1e-5); // but for rounding
}

// Distances cannot be told there: a millimeter is what rounding leaves of them.
TEST(SurfaceRefinement, ClaimsNothingTooFarFromTheOrigin)
{
  const TestSphere sphere(4);
  const auto isEmbedded = [&](double far)
  {
    const PointList points = sphere.Points().array() + far;
    return RefineSurface(sphere.Mesh, points, true, SerialFor, NeverStop).Embedded;
  };
  EXPECT_TRUE(isEmbedded(1e6));
  EXPECT_FALSE(isEmbedded(1e14));
}

TEST(SurfaceRefinement, StopsWheneverItIsAsked)
{
  std::mt19937 random(9);
  const TestSphere sphere(6);
  // One that does not succeed at once.
  PointList points;
  int questions = 0;
  for (int kind = 0; kind < NumberOfAdverseMotions && questions < 4; ++kind)
  {
    points = Crumpled(sphere, kind, 8, random);
    questions = 0;
    RefineSurface(sphere.Mesh, points, true, SerialFor,
      [&questions](double) { return ++questions > 0; });
  }
  ASSERT_GE(questions, 4);
  for (int last = 0; last < std::min(questions, 12); ++last)
  {
    int asked = 0;
    const RefinedSurface refined = RefineSurface(sphere.Mesh, points, true, SerialFor,
      [&asked, last](double) { return asked++ < last; });
    EXPECT_FALSE(refined.Embedded);
  }
}

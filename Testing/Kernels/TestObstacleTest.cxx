// Fixed points that the guard keeps on their side.
#include "AdverseMotions.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/ObstacleTest.h"
#include "Guard/SurfaceRefinement.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// Points just inside and outside, at random.
PointList PointsNear(const TestSphere& sphere, int count, std::mt19937& random,
  std::vector<int>& sides)
{
  std::normal_distribution<double> normal;
  PointList obstacles(count, 3);
  for (int index = 0; index < count; ++index)
  {
    const Eigen::RowVector3d direction =
      Eigen::RowVector3d(normal(random), normal(random), normal(random)).normalized();
    obstacles.row(index) =
      Eigen::RowVector3d(10, -20, 30) + (index % 2 == 0 ? 22.0 : 26.0) * direction;
    sides.push_back(
      WindingNumber(sphere.Points(), sphere.Triangles(), obstacles.row(index).transpose()));
  }
  return obstacles;
}

int CountPassed(const PointList& points, const TriangleList& triangles, const PointList& obstacles,
  const std::vector<int>& sides)
{
  int count = 0;
  for (Eigen::Index index = 0; index < obstacles.rows(); ++index)
  {
    count +=
      WindingNumber(points, triangles, obstacles.row(index).transpose()) == sides[index] ? 0 : 1;
  }
  return count;
}

} // namespace

TEST(ObstacleTest, ObstaclesStayOnTheirSideInEveryMotion)
{
  std::mt19937 random(3);
  const TestSphere sphere(6);
  int passedWithout = 0;
  for (int kind = 0; kind < 14; ++kind)
  {
    std::vector<int> sides;
    const PointList obstacles = PointsNear(sphere, 10, random, sides);
    EmbeddingGuard guard(sphere.Mesh);
    PointList free = sphere.Points();
    PointList points = sphere.Points();
    for (int step = 0; step < 5; ++step)
    {
      PointList motion = AdverseMotion(kind, sphere.EdgeLength, points, random);
      PointList same = motion;
      guard.SetObstacles(PointList(0, 3));
      free = guard.Limit(free, same, SerialFor, NeverStop).Positions;
      guard.SetObstacles(obstacles);
      points = guard.Limit(points, motion, SerialFor, NeverStop).Positions;
      EXPECT_EQ(CountPassed(points, sphere.Triangles(), obstacles, sides), 0)
        << AdverseMotionNames[kind];
      for (const Eigen::RowVector3d obstacle : obstacles.rowwise())
      {
        EXPECT_TRUE(HullsNearerThan(1e-5, points, guard.Hulls(), obstacle.transpose()).empty())
          << AdverseMotionNames[kind];
      }
      EXPECT_EQ(CountSelfIntersections(points, sphere.Faces()), 0) << AdverseMotionNames[kind];
    }
    passedWithout += CountPassed(free, sphere.Triangles(), obstacles, sides);
  }
  EXPECT_GT(passedWithout, 20);
}

// A face that sweeps over a point and back within one straight motion of its vertices cannot be
// told from its ends.
TEST(ObstacleTest, TheWholeMotionCounts)
{
  PointList from(4, 3);
  from << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  PointList to = from;
  to.col(0).array() += 10; // past the point, which is again outside the face at the end
  const MinimumDistance distance{ 1e-3, 1e-9 };
  const Hull hull{ { 0, 1, 2, 3 } };
  EXPECT_LT(TimeToObstacle({ from, to }, hull, Eigen::Vector3d(4, 0, 0), distance), 0.31);
  EXPECT_GT(TimeToObstacle({ from, to }, hull, Eigen::Vector3d(4, 0, 0), distance), 0.2);
  EXPECT_EQ(TimeToObstacle({ from, to }, hull, Eigen::Vector3d(4, 0, 0.1), distance), 1);
  EXPECT_EQ(TimeToObstacle({ from, from }, hull, Eigen::Vector3d(0, 0, 0), distance), 1);
  EXPECT_LT(TimeToObstacle({ from, to }, hull, Eigen::Vector3d(0, 0, 0), distance), 0);
}

TEST(ObstacleTest, RefinementPassesNone)
{
  const TestSphere sphere(4);
  // Just below the vertices, where a refined sphere is flatter.
  PointList obstacles(sphere.Points().rows(), 3);
  const Eigen::RowVector3d center(10, -20, 30);
  obstacles = (0.995 * (sphere.Points().rowwise() - center)).rowwise() + center;
  const std::vector<int> sides(obstacles.rows(), 1);
  ASSERT_EQ(CountPassed(sphere.Points(), sphere.Triangles(), obstacles, sides), 0);
  const RefinedSurface free =
    RefineSurface(sphere.Mesh, sphere.Points(), true, SerialFor, NeverStop);
  EXPECT_GT(CountPassed(free.Points, free.Mesh.Triangles, obstacles, sides), 50);
  const RefinedSurface held =
    RefineSurface(sphere.Mesh, sphere.Points(), { obstacles }, true, SerialFor, NeverStop);
  ASSERT_TRUE(held.Embedded);
  EXPECT_EQ(CountPassed(held.Points, held.Mesh.Triangles, obstacles, sides), 0);
}

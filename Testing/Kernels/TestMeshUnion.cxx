// Several surfaces as one: their union, its guard, and its refinement beside surfaces at rest.
#include "ExampleSurfaces.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/SurfaceRefinement.h"
#include "Mesh/MeshUnion.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

struct Ball
{
  ContourMesh Mesh;
  PointList Points;

  Ball(int n, const Eigen::Vector3d& center, double radius)
  {
    const QuadSphere sphere = MakeQuadSphere(n, center, radius, QuadSphereSpacing::Equiangular);
    this->Points = sphere.Points;
    this->Mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  }
};

Ball Both(const Ball& one, const Ball& two)
{
  Ball both = one;
  AppendMesh(two.Mesh, both.Mesh);
  AppendPoints(two.Points, both.Points);
  return both;
}

} // namespace

TEST(MeshUnion, IsWhatTheFacesTogetherGive)
{
  const Ball both = Both(Ball(3, { 0, 0, 0 }, 10), Ball(5, { 30, 0, 0 }, 8));
  const ContourMesh built = BuildContourMesh(both.Mesh.NumberOfPoints(), both.Mesh.Faces);
  EXPECT_EQ(both.Mesh.NumberOfPoints(), 6 * 9 + 6 * 25);
  EXPECT_EQ(built.Neighbors, both.Mesh.Neighbors);
  EXPECT_EQ(built.Contours, both.Mesh.Contours);
  EXPECT_EQ(built.Triangles, both.Mesh.Triangles);
  EXPECT_EQ(both.Mesh.EulerNumber(), 4);
}

// Two balls that are driven through each other.
TEST(MeshUnion, IsGuardedAsOneSurface)
{
  const Ball one(6, { 0, 0, 0 }, 10);
  const Ball both = Both(one, Ball(6, { 25, 0, 0 }, 10));
  EmbeddingGuard guard(both.Mesh);
  PointList points = both.Points;
  for (int step = 0; step < 10; ++step)
  {
    PointList motion = PointList::Zero(points.rows(), 3);
    motion.topRows(one.Points.rows()).col(0).setConstant(2);
    motion.bottomRows(one.Points.rows()).col(0).setConstant(-2);
    const GuardReport report = guard.Limit(points, motion, SerialFor, NeverStop);
    EXPECT_EQ(std::count(report.IsGuarded.begin(), report.IsGuarded.end(), 1), report.Guarded);
    points = report.Positions;
    ASSERT_EQ(CountSelfIntersections(points, both.Mesh.Faces), 0) << step;
  }
  // They have met, and yielded.
  EXPECT_GT(points.topRows(one.Points.rows()).col(0).maxCoeff(), 11);
  EXPECT_LT(points.topRows(one.Points.rows()).col(0).maxCoeff(), 29); // freely, 30
}

// A point that one surface must not pass is nothing to the other.
TEST(MeshUnion, HasObstaclesOfEachSurface)
{
  const Ball one(6, { 0, 0, 0 }, 10);
  const Ball two(6, { 0, 0, 40 }, 10);
  const Ball both = Both(one, two);
  const int count = one.Mesh.NumberOfPoints();
  EmbeddingGuard guard(both.Mesh);
  PointList obstacles(2, 3);
  obstacles << 0, 0, 12, 0, 0, 28;
  for (const bool own : { true, false })
  {
    const VertexRange first{ 0, count };
    const VertexRange second{ count, 2 * count };
    guard.SetObstacles(obstacles,
      own ? std::vector<VertexRange>{ first, second } : std::vector<VertexRange>{ second, first });
    PointList motion = both.Points;
    motion.bottomRows(count).col(2).array() -= 40;
    motion *= 0.4; // both grow to a radius of 14
    const GuardReport report = guard.Limit(both.Points, motion, SerialFor, NeverStop);
    const double highest = report.Positions.topRows(count).col(2).maxCoeff();
    const double lowest = report.Positions.bottomRows(count).col(2).minCoeff();
    EXPECT_EQ(highest < 12, own);
    EXPECT_EQ(lowest > 28, own);
  }
}

// Of two surfaces, refinement keeps only the one to which it belongs off a point.
TEST(SurfaceRefinement, HasObstaclesOfEachSurface)
{
  const Ball one(4, { 0, 0, 0 }, 10);
  const Ball two(4, { 0, 0, 40 }, 10);
  const Ball both = Both(one, two);
  const int count = one.Mesh.NumberOfPoints();
  RefinementSurroundings surroundings;
  // Just below the vertices of the second one, where a refined sphere is flatter.
  surroundings.Obstacles =
    (0.995 * (two.Points.rowwise() - Eigen::RowVector3d(0, 0, 40))).rowwise() +
    Eigen::RowVector3d(0, 0, 40);
  const auto refine = [&](const VertexRange& range)
  {
    surroundings.Ranges.assign(surroundings.Obstacles.rows(), range);
    return RefineSurface(both.Mesh, both.Points, surroundings, true, SerialFor, NeverStop);
  };
  const RefinedSurface free = RefineSurface(both.Mesh, both.Points, true, SerialFor, NeverStop);
  const RefinedSurface ofOne = refine({ 0, count });
  EXPECT_TRUE(ofOne.Embedded);
  EXPECT_EQ(ofOne.Points, free.Points);
  const RefinedSurface ofTwo = refine({ count, 2 * count });
  EXPECT_TRUE(ofTwo.Embedded);
  EXPECT_EQ(ofTwo.Points.topRows(4 * count), free.Points.topRows(4 * count));
  for (const Eigen::RowVector3d obstacle : surroundings.Obstacles.rowwise())
  {
    EXPECT_EQ(WindingNumber(ofTwo.Points, ofTwo.Mesh.Triangles, obstacle.transpose()), 1);
  }
}

TEST(SurfaceRefinement, KeepsOffASurfaceAtRest)
{
  const Ball ball(3, { 0, 0, 0 }, 10);
  // In a dent: the coarse surface is a hair's breadth away from it.
  double highest = 0;
  for (const auto& point : ball.Points.rowwise())
  {
    highest = std::max(highest, point[2]);
  }
  const Ball near(8, { 0, 0, highest + 3.0001 }, 3);
  const RefinedSurface free = RefineSurface(ball.Mesh, ball.Points, true, SerialFor, NeverStop);
  const RefinedSurface refined = RefineSurface(ball.Mesh, ball.Points,
    { PointList(0, 3), near.Mesh, near.Points }, true, SerialFor, NeverStop);
  ASSERT_TRUE(refined.Embedded);
  EXPECT_EQ(refined.Mesh.NumberOfPoints(), free.Mesh.NumberOfPoints());
  ContourMesh mesh = refined.Mesh;
  PointList points = refined.Points;
  AppendMesh(near.Mesh, mesh);
  AppendPoints(near.Points, points);
  EXPECT_EQ(CountSelfIntersections(points, mesh.Faces), 0);
  // Far away, nothing is in the way.
  const Ball far(8, { 0, 0, 50 }, 3);
  EXPECT_EQ(RefineSurface(ball.Mesh, ball.Points, { PointList(0, 3), far.Mesh, far.Points }, true,
              SerialFor, NeverStop)
              .Points,
    free.Points);
}

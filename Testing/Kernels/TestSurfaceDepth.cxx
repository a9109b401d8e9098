// Depths inside balls and a body of two unlike ones.
#include "Evidence/SurfaceDepth.h"
#include "Mesh/QuadSphere.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

struct Body
{
  PointList Points;
  TriangleList Triangles;
};

Body BallBody(const Eigen::Vector3d& center, double radius)
{
  const QuadSphere sphere = MakeQuadSphere(16, center, radius, QuadSphereSpacing::Equiangular);
  const ContourMesh mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
  return { sphere.Points, mesh.Triangles };
}

SurfaceDepths DepthsOf(const Body& body, const Eigen::Vector3d& point, double step)
{
  return FindDepths(body.Points, body.Triangles, point, step, SerialFor);
}

} // namespace

TEST(SurfaceDepth, OfABallIsTheDistanceFromItsSurface)
{
  const Eigen::Vector3d center(31, -7, 250);
  const Body ball = BallBody(center, 20);
  const SurfaceDepths inMiddle = DepthsOf(ball, center, 1);
  EXPECT_NEAR(inMiddle.OfPoint, 20, 0.7);
  EXPECT_NEAR(inMiddle.Greatest, 20, 0.7);
  const SurfaceDepths aside = DepthsOf(ball, center + Eigen::Vector3d(0, 12, 0), 1);
  EXPECT_NEAR(aside.OfPoint, 8, 0.9);
  EXPECT_EQ(aside.Greatest, inMiddle.Greatest);
}

TEST(SurfaceDepth, OfAPointOutsideIsZero)
{
  const Body ball = BallBody({ 0, 0, 0 }, 20);
  EXPECT_EQ(DepthsOf(ball, { 0, 0, 21.5 }, 1).OfPoint, 0);
  EXPECT_EQ(DepthsOf(ball, { 500, 0, 0 }, 1).OfPoint, 0);
}

TEST(SurfaceDepth, SeesADeeperPartElsewhere)
{
  Body body = BallBody({ 0, 0, 0 }, 10);
  const Body other = BallBody({ 60, 0, 0 }, 25);
  const auto first = static_cast<int>(body.Points.rows());
  PointList points(2 * first, 3);
  points << body.Points, other.Points;
  TriangleList triangles(2 * body.Triangles.rows(), 3);
  triangles << body.Triangles, (other.Triangles.array() + first).matrix();
  const SurfaceDepths depths = DepthsOf({ points, triangles }, { 0, 0, 0 }, 1);
  EXPECT_NEAR(depths.OfPoint, 10, 0.7);
  EXPECT_NEAR(depths.Greatest, 25, 0.7);
}

TEST(SurfaceDepth, TakesLargerCubesForALongSurface)
{
  Body body = BallBody({ 0, 0, 0 }, 10);
  body.Points.col(2) *= 12;
  const SurfaceDepths depths = DepthsOf(body, { 0, 0, 0 }, 0.01);
  EXPECT_NEAR(depths.OfPoint, 10, 2); // a cube
  EXPECT_NEAR(depths.Greatest, 10, 2);
}

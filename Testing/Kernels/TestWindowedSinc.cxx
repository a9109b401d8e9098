// Smoothing keeps what is large and removes what is small.
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Measures/MaskSurface.h"
#include "Mesh/SurfaceTopology.h"
#include "Mesh/WindowedSinc.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

constexpr double Radius = 15.3;
const Eigen::Vector3d Center(20, 20, 20);

MaskSurface VoxelBall()
{
  const ImageGeometry geometry = Grid({ { 41, 41, 41 } }, { 1, 1, 1 });
  BitMask mask(geometry);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      if ((Eigen::Vector3d(i, j, k) - Center).norm() < Radius)
      {
        mask.Insert(i, j, k);
      }
    });
  return SurfaceOf(mask);
}

// The root mean square of the distance from the sphere.
double Roughness(const PointList& points)
{
  const Eigen::VectorXd radii = (points.rowwise() - Center.transpose()).rowwise().norm();
  return std::sqrt((radii.array() - Radius).square().mean());
}

} // namespace

TEST(WindowedSinc, RemovesTheStepsOfABallAndKeepsItsVolume)
{
  MaskSurface ball = VoxelBall();
  const double volume = EnclosedVolume({ ball.Points, ball.Triangles });
  const double roughness = Roughness(ball.Points);
  SmoothByWindowedSinc(ball.Triangles, 20, 0.1, ball.Points);
  EXPECT_NEAR(EnclosedVolume({ ball.Points, ball.Triangles }) / volume, 1, 0.01);
  EXPECT_LT(Roughness(ball.Points), 0.5 * roughness);
}

TEST(WindowedSinc, IsLinearAndMovesWithTheSurface)
{
  const MaskSurface ball = VoxelBall();
  PointList once = ball.Points;
  SmoothByWindowedSinc(ball.Triangles, 7, 0.1, once);
  PointList moved = (3 * ball.Points).rowwise() + Eigen::RowVector3d(5, -6, 7);
  SmoothByWindowedSinc(ball.Triangles, 7, 0.1, moved);
  // Only as far as the filter's coefficients sum up to one.
  EXPECT_LT((moved - ((3 * once).rowwise() + Eigen::RowVector3d(5, -6, 7))).cwiseAbs().maxCoeff(),
    0.1);
}

TEST(MaskSurface, IsClosedForAnyMask)
{
  std::mt19937 random(5);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    for (const double part : { 0.1, 0.5, 0.9 })
    {
      const BitMask mask = BitsOf(RandomMask(geometry, part, random), geometry);
      const MaskSurface surface = SurfaceOf(mask);
      if (mask.Bounds().IsEmpty())
      {
        EXPECT_EQ(surface.Points.rows(), 0);
        continue;
      }
      EXPECT_NO_THROW(
        RequireClosed(static_cast<int>(surface.Points.rows()), surface.Triangles, "it"));
      EXPECT_GT(EnclosedVolume({ surface.Points, surface.Triangles }), 0);
    }
  }
}

// Confidence on phantoms whose boundary is known.
#include "Evidence/SurfaceConfidence.h"
#include "Image/SeedRegion.h"
#include "Mesh/QuadSphere.h"
#include "Phantom/VoxelNoise.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

constexpr int Resolution = 16;

// A ball of radius 22 mm around the origin: 100 inside, 60 outside, noise of 10.
struct BallInNoise
{
  FloatImage Image;
  ContourMesh Mesh;
  PointList Points;

  BallInNoise()
  {
    ImageGeometry& geometry = this->Image.Geometry;
    geometry.Dimensions = { { 84, 84, 84 } };
    geometry.Origin.setConstant(-41.5);
    this->Image.Voxels.resize(geometry.NumberOfVoxels());
    for (int k = 0; k < 84; ++k)
    {
      for (int j = 0; j < 84; ++j)
      {
        for (int i = 0; i < 84; ++i)
        {
          const bool inside = geometry.ToPhysical({ i + 0.0, j + 0.0, k + 0.0 }).norm() < 22;
          this->Image.Voxels[geometry.Offset(i, j, k)] = inside ? 100 : 60;
        }
      }
    }
    AddNoise(7, 10, 0, { 0, 0, 0 }, { 84, 84, 84 }, this->Image.Voxels.data());
    const QuadSphere sphere =
      MakeQuadSphere(Resolution, { 0, 0, 0 }, 22, QuadSphereSpacing::Equiangular);
    this->Mesh = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
    this->Points = sphere.Points;
  }

  // With the points at x > `begin` moved outward, as by a leak.
  PointList Leaking(double begin, double millimeters) const
  {
    PointList points = this->Points;
    for (Eigen::Index vertex = 0; vertex < points.rows(); ++vertex)
    {
      if (points(vertex, 0) > begin)
      {
        points.row(vertex) *= 1 + millimeters / 22;
      }
    }
    return points;
  }

  SurfaceConfidence Judge(const PointList& points, const Eigen::VectorXd& shifts = {},
    double unanimity = 1) const
  {
    return JudgeSurface(ReaderOf(this->Image.View()), this->Image.Geometry, this->Mesh, points,
      SeedSphere{ Eigen::Vector3d::Zero(), 10 }, shifts, unanimity, SerialFor);
  }
};

// The mean over the vertices whose x times `side` is well above zero.
double MeanOf(const BallInNoise& ball, const SurfaceConfidence& confidence, double side)
{
  double sum = 0;
  int count = 0;
  for (Eigen::Index vertex = 0; vertex < ball.Points.rows(); ++vertex)
  {
    if (side * ball.Points(vertex, 0) > 10)
    {
      sum += confidence.OfVertices[vertex];
      ++count;
    }
  }
  return sum / count;
}

} // namespace

TEST(SurfaceConfidence, IsHighOnTheBoundaryAndLowBesideIt)
{
  const BallInNoise ball;
  const SurfaceConfidence right = ball.Judge(ball.Points);
  EXPECT_EQ(right.OfVertices.size(), static_cast<std::size_t>(ball.Points.rows()));
  EXPECT_GT(right.OfSurface, 0.9);
  EXPECT_LE(right.OfSurface, 1);
  EXPECT_GT(MeanOf(ball, right, 1), 0.4);
  const SurfaceConfidence half = ball.Judge(ball.Leaking(0, 8));
  EXPECT_LT(half.OfSurface, DoubtfulConfidence);
  EXPECT_GT(MeanOf(ball, half, -1), 0.25); // what has leaked blurs the inside
  EXPECT_LT(MeanOf(ball, half, 1), 0.1);
  const SurfaceConfidence quarter = ball.Judge(ball.Leaking(11, 8));
  EXPECT_LT(quarter.OfSurface, right.OfSurface);
  EXPECT_GT(MeanOf(ball, quarter, -1), 0.4);
  EXPECT_LT(MeanOf(ball, quarter, 1), 0.25);
}

TEST(SurfaceConfidence, OfVerticesFallsWhereTheRunsDisagree)
{
  const BallInNoise ball;
  Eigen::VectorXd shifts = Eigen::VectorXd::Zero(ball.Points.rows());
  const SurfaceConfidence none = ball.Judge(ball.Points);
  const SurfaceConfidence agreeing = ball.Judge(ball.Points, shifts);
  EXPECT_EQ(none.OfSurface, agreeing.OfSurface);
  EXPECT_EQ(none.OfVertices, agreeing.OfVertices);
  for (Eigen::Index vertex = 0; vertex < shifts.size(); ++vertex)
  {
    shifts[vertex] = ball.Points(vertex, 0) > 0 ? 10 : 0;
  }
  const SurfaceConfidence moved = ball.Judge(ball.Points, shifts);
  EXPECT_NEAR(MeanOf(ball, moved, -1), MeanOf(ball, agreeing, -1), 1e-12);
  EXPECT_LT(MeanOf(ball, moved, 1), 0.1);
}

TEST(SurfaceConfidence, OfTheSurfaceFallsWhereOpinionsDiffer)
{
  const BallInNoise ball;
  const SurfaceConfidence unanimous = ball.Judge(ball.Points);
  const SurfaceConfidence divided = ball.Judge(ball.Points, {}, 0.7);
  const SurfaceConfidence without = ball.Judge(ball.Points, {}, 0.5);
  EXPECT_LT(divided.OfSurface, unanimous.OfSurface - 0.01);
  EXPECT_LT(without.OfSurface, divided.OfSurface);
  EXPECT_EQ(unanimous.OfVertices, divided.OfVertices);
}

TEST(SurfaceConfidence, FallsWhereTheSurroundingsAreBrighterHereAndDarkerThere)
{
  BallInNoise ball;
  const SurfaceConfidence darker = ball.Judge(ball.Points);
  const ImageGeometry& geometry = ball.Image.Geometry;
  for (int k = 0; k < 84; ++k)
  {
    for (int j = 0; j < 84; ++j)
    {
      for (int i = 42; i < 84; ++i)
      {
        if (geometry.ToPhysical({ i + 0.0, j + 0.0, k + 0.0 }).norm() >= 22)
        {
          ball.Image.Voxels[geometry.Offset(i, j, k)] += 80;
        }
      }
    }
  }
  const SurfaceConfidence mixed = ball.Judge(ball.Points);
  EXPECT_LT(mixed.OfSurface, darker.OfSurface - 0.1);
  // The image shows the boundary on both sides as well as before.
  EXPECT_NEAR(MeanOf(ball, mixed, -1), MeanOf(ball, darker, -1), 0.05);
  EXPECT_NEAR(MeanOf(ball, mixed, 1), MeanOf(ball, darker, 1), 0.05);
}

TEST(SurfaceConfidence, FallsWithADeeperPlaceElsewhereAndWithASmallSeed)
{
  const BallInNoise ball;
  const auto judgeFrom = [&](double x, double radius)
  {
    return JudgeSurface(ReaderOf(ball.Image.View()), ball.Image.Geometry, ball.Mesh, ball.Points,
      SeedSphere{ { x, 0, 0 }, radius }, {}, 1, SerialFor)
      .OfSurface;
  };
  EXPECT_LT(judgeFrom(15, 5), judgeFrom(0, 5) - 0.01);
  EXPECT_LT(judgeFrom(0, 2), judgeFrom(0, 5) - 0.01);
}

TEST(SurfaceConfidence, KnowsNoUnitOfGrayValues)
{
  BallInNoise ball;
  const SurfaceConfidence before = ball.Judge(ball.Points);
  for (float& voxel : ball.Image.Voxels)
  {
    voxel = 300 - 0.25F * voxel; // the ball is darker now
  }
  const SurfaceConfidence after = ball.Judge(ball.Points);
  EXPECT_NEAR(after.OfSurface, before.OfSurface, 1e-5);
  for (std::size_t vertex = 0; vertex < before.OfVertices.size(); ++vertex)
  {
    EXPECT_NEAR(after.OfVertices[vertex], before.OfVertices[vertex], 1e-4);
  }
}

TEST(SurfaceConfidence, IsZeroWithoutContrast)
{
  BallInNoise ball;
  std::fill(ball.Image.Voxels.begin(), ball.Image.Voxels.end(), 7.0F);
  const SurfaceConfidence confidence = ball.Judge(ball.Points);
  EXPECT_EQ(*std::max_element(confidence.OfVertices.begin(), confidence.OfVertices.end()), 0);
  EXPECT_LT(confidence.OfSurface, DoubtfulConfidence);
}

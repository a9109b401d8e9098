#include "Mesh/SurfaceNormals.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

// Greatest angle between a normal and the radius, in degrees.
double RadialError(const TestSphere& sphere, int smoothing)
{
  const PointList normals = VertexNormals(sphere.Mesh, sphere.Points(), smoothing);
  double error = 0;
  for (Eigen::Index vertex = 0; vertex < normals.rows(); ++vertex)
  {
    const Eigen::RowVector3d radius =
      (sphere.Points().row(vertex) - Eigen::RowVector3d(10, -20, 30)).normalized();
    EXPECT_NEAR(normals.row(vertex).norm(), 1, 1e-12);
    error = std::max(error, std::acos(std::min(1.0, radius.dot(normals.row(vertex)))));
  }
  return error * 180 / EIGEN_PI;
}

} // namespace

TEST(SurfaceNormals, OfASphereAreRadial)
{
  for (int smoothing : { 0, 1, 3 })
  {
    EXPECT_LT(RadialError(TestSphere(8), smoothing), 6.0);
    EXPECT_LT(RadialError(TestSphere(32), smoothing), 1.5);
  }
}

TEST(SurfaceNormals, SmoothingCalmsThem)
{
  std::mt19937 random(4);
  const TestSphere sphere(16);
  const PointList noisy =
    sphere.Points() + WhiteNoise(sphere.Points().rows(), 0.3 * sphere.EdgeLength, random);
  const PointList radial =
    (sphere.Points().rowwise() - Eigen::RowVector3d(10, -20, 30)).rowwise().normalized();
  double before = 1e9;
  for (int smoothing = 0; smoothing < 4; ++smoothing)
  {
    const double error = (VertexNormals(sphere.Mesh, noisy, smoothing) - radial).norm();
    EXPECT_LT(error, before);
    before = error;
  }
}

TEST(SurfaceNormals, WithoutAreaTakeTheNeighborsOrZ)
{
  const TestSphere sphere(6);
  // One vertex and its surroundings in one point.
  const int vertex = 40;
  PointList points = sphere.Points();
  for (Eigen::Index triangle = 0; triangle < sphere.Triangles().rows(); ++triangle)
  {
    const auto corners = sphere.Triangles().row(triangle);
    if ((corners.array() == vertex).any())
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        points.row(corners[corner]) = sphere.Points().row(vertex);
      }
    }
  }
  const PointList normals = VertexNormals(sphere.Mesh, points, 0);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  const Eigen::RowVector3d radius =
    (sphere.Points().row(vertex) - Eigen::RowVector3d(10, -20, 30)).normalized();
  EXPECT_GT(normals.row(vertex).dot(radius), 0.8);

  points.rowwise() = Eigen::RowVector3d(1, 2, 3);
  for (int smoothing : { 0, 2 })
  {
    const PointList collapsed = VertexNormals(sphere.Mesh, points, smoothing);
    EXPECT_TRUE((collapsed.rowwise() - Eigen::RowVector3d(0, 0, 1)).isZero(0));
  }
}

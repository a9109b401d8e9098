#include "FindWithCGAL.h"
#include "Geometry/SelfIntersection.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

TEST(SelfIntersectionAgainstCGAL, NoisySpheres)
{
  std::mt19937 random(1);
  std::size_t total = 0;
  for (int n : { 2, 4, 8, 16 })
  {
    const TestSphere sphere(n);
    for (double noise : { 0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0 })
    {
      for (int repeat = 0; repeat < 32 / n; ++repeat)
      {
        const PointList points =
          sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
        const PairList expected = FindWithCGAL(points, sphere.Triangles());
        EXPECT_EQ(FindSelfIntersections(points, sphere.Triangles()), expected)
          << "n " << n << ", noise " << noise;
        total += expected.size();
      }
    }
  }
  EXPECT_GT(total, 10000u);
}

// Small integers make coplanar, collinear and touching pairs the rule. Triangles without area are
// outside CGAL's precondition, so such meshes are left out.
TEST(SelfIntersectionAgainstCGAL, DegenerateArrangements)
{
  std::mt19937 random(2);
  const TestSphere sphere(2);
  int compared = 0;
  std::size_t total = 0;
  for (int repeat = 0; repeat < 8000; ++repeat)
  {
    const int extent = 3 + repeat % 6;
    std::uniform_int_distribution<int> coordinate(-extent, extent);
    PointList points(sphere.Points().rows(), 3);
    for (Eigen::Index i = 0; i < points.size(); ++i)
    {
      points.data()[i] = coordinate(random);
    }
    bool degenerate = false;
    for (Eigen::Index row = 0; row < sphere.Triangles().rows() && !degenerate; ++row)
    {
      const Eigen::RowVector3d a = points.row(sphere.Triangles()(row, 0));
      const Eigen::RowVector3d b = points.row(sphere.Triangles()(row, 1));
      const Eigen::RowVector3d c = points.row(sphere.Triangles()(row, 2));
      degenerate = (b - a).cross(c - a).isZero(0);
    }
    if (degenerate)
    {
      continue;
    }
    const PairList expected = FindWithCGAL(points, sphere.Triangles());
    ASSERT_EQ(FindSelfIntersections(points, sphere.Triangles()), expected) << "mesh " << repeat;
    total += expected.size();
    ++compared;
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(total, 10000u);
}

// The same, off the grid: a rotation and a shift leave nearly coplanar pairs, whose sign only the
// exact arithmetic gets right.
TEST(SelfIntersectionAgainstCGAL, NearlyCoplanarCubes)
{
  std::mt19937 random(3);
  for (int n : { 2, 3, 5, 8 })
  {
    const TestSphere cube(n, QuadSphereSpacing::Cube);
    for (int repeat = 0; repeat < 20; ++repeat)
    {
      const Eigen::RowVector4d q = WhiteNoise(2, 1.0, random).reshaped<Eigen::RowMajor>().head<4>();
      const Eigen::Matrix3d rotation =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      const double noise = repeat % 2 == 0 ? 0.0 : 1e-14;
      const PointList points =
        cube.Points() * rotation.transpose() + WhiteNoise(cube.Points().rows(), noise, random);
      EXPECT_EQ(FindSelfIntersections(points, cube.Triangles()),
        FindWithCGAL(points, cube.Triangles()))
        << "n " << n << ", repeat " << repeat;
    }
  }
}

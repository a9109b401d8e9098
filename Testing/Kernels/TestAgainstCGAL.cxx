#include "ExampleSurfaces.h"
#include "FindWithCGAL.h"
#include "Geometry/SelfIntersection.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

// For some cut.
bool HaveDegenerateTriangle(const PointList& points, const FaceList& faces)
{
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int size = faces.FaceSize(face);
    for (int corner = 0; corner < size; ++corner)
    {
      const auto at = [&](int which) -> Eigen::RowVector3d
      { return points.row(faces.Face(face)[(corner + which) % size]); };
      if ((at(1) - at(0)).cross(at(2) - at(0)).isZero(0))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

TEST(SelfIntersectionAgainstCGAL, NoisySpheres)
{
  std::mt19937 random(1);
  std::size_t total = 0;
  for (int n : { 2, 4, 8 })
  {
    const TestSphere sphere(n);
    for (double noise : { 0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0 })
    {
      for (int repeat = 0; repeat < 32 / n; ++repeat)
      {
        const PointList points =
          sphere.Points() + WhiteNoise(sphere.Points().rows(), noise * sphere.EdgeLength, random);
        const PairList expected = FindWithCGAL(points, sphere.Faces());
        EXPECT_EQ(FindSelfIntersections(points, sphere.Faces()), expected)
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
  for (int repeat = 0; repeat < 3000; ++repeat)
  {
    const int extent = 3 + repeat % 6;
    std::uniform_int_distribution<int> coordinate(-extent, extent);
    PointList points(sphere.Points().rows(), 3);
    for (Eigen::Index i = 0; i < points.size(); ++i)
    {
      points.data()[i] = coordinate(random);
    }
    if (HaveDegenerateTriangle(points, sphere.Faces()))
    {
      continue;
    }
    const PairList expected = FindWithCGAL(points, sphere.Faces());
    ASSERT_EQ(FindSelfIntersections(points, sphere.Faces()), expected) << "mesh " << repeat;
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
      EXPECT_EQ(FindSelfIntersections(points, cube.Faces()), FindWithCGAL(points, cube.Faces()))
        << "n " << n << ", repeat " << repeat;
    }
  }
}

// CGAL takes no mesh with an edge of four triangles. Cut along other diagonals, it is valid.
TEST(SelfIntersectionAgainstCGAL, FacesThatShareADiagonal)
{
  const PolygonMesh neck = NeckOfTwoFaces();
  FaceList faces = CutLargeFaces(neck.Faces);
  EXPECT_THROW(FindWithCGAL(neck.Points, faces), std::invalid_argument);
  std::rotate(faces.Connectivity.begin(), faces.Connectivity.begin() + 1,
    faces.Connectivity.begin() + 4);
  PairList pairs;
  AppendWithCGAL(
    neck.Points, faces, [](int) { return false; }, pairs);
  EXPECT_EQ(pairs, PairList());
}

#include "ExampleMasks.h"
#include "Geometry/FaceHulls.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/MeshRefinement.h"
#include "Mesh/QuadSphere.h"
#include "Mesh/SurfaceTopology.h"
#include "Mesh/SurfaceVoxelization.h"
#include "Vessel/CellSurface.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace FlipFree;

namespace
{

std::vector<float> NoDepth(const BitMask& cells)
{
  return std::vector<float>(cells.GetGeometry().NumberOfVoxels(), 1.0F);
}

std::size_t FirstOf(const BitMask& cells)
{
  std::size_t first = cells.GetGeometry().NumberOfVoxels();
  cells.ForEach([&](std::size_t cell) { first = std::min(first, cell); });
  return first;
}

// What every surface of a ball of cells has to be.
void ExpectSphere(const BitMask& ball)
{
  const CellSurface surface = MakeCellSurface(ball);
  const ContourMesh mesh = BuildContourMesh(static_cast<int>(surface.Points.rows()), surface.Faces);
  EXPECT_EQ(mesh.EulerNumber(), 2);
  EXPECT_EQ(CountSelfIntersections(surface.Points, surface.Faces), 0);
  const FaceList refined = RefineFaces(mesh).Faces;
  EXPECT_TRUE(FaceHulls(PointList::Zero(4 * surface.Points.rows(), 3), refined)
                .FindOverlappingFaces()
                .empty());
  // The cells are inside and all others outside.
  EXPECT_EQ(CountVoxels(VoxelizeSurface(surface.Points, mesh.Triangles, ball.GetGeometry())),
    ball.Count());
}

} // namespace

TEST(CellSurface, OfACubeIsThePapersCube)
{
  const int n = 4;
  const ImageGeometry grid = Grid({ { n, n, n } }, { 1, 1, 1 });
  BitMask cells(grid);
  cells.Complement();
  const BitMask ball = GrowBall(cells, NoDepth(cells), 0);
  EXPECT_EQ(ball, cells);
  const CellSurface surface = MakeCellSurface(ball);
  const QuadSphere cube = MakeQuadSphere(n, grid.ToPhysical(Eigen::Vector3d::Constant(1.5)),
    n / 2.0, QuadSphereSpacing::Cube);
  ASSERT_EQ(surface.Points.rows(), cube.Points.rows());
  EXPECT_EQ(surface.Faces.NumberOfFaces(), cube.Faces.NumberOfFaces());
  const auto sorted = [](const PointList& points)
  {
    std::set<std::array<long, 3>> places;
    for (Eigen::Index point = 0; point < points.rows(); ++point)
    {
      places.insert({ { std::lround(1000 * points(point, 0)), std::lround(1000 * points(point, 1)),
        std::lround(1000 * points(point, 2)) } });
    }
    return places;
  };
  EXPECT_EQ(sorted(surface.Points), sorted(cube.Points));
  ExpectSphere(ball);
}

TEST(CellSurface, OfRandomCellsIsAnEmbeddedSphere)
{
  std::mt19937 random(5);
  for (const double part : { 0.3, 0.5, 0.7, 0.9 })
  {
    for (int repetition = 0; repetition < 5; ++repetition)
    {
      const ImageGeometry grid = Grid({ { 9, 8, 7 } }, { 1, 1.3, 0.8 });
      const std::vector<unsigned char> mask = RandomMask(grid, part, random);
      BitMask cells(grid);
      std::vector<float> depth;
      ForEachVoxel(grid,
        [&](int i, int j, int k)
        {
          depth.push_back(static_cast<float>(random() % 5));
          if (mask[grid.Offset(i, j, k)])
          {
            cells.Insert(i, j, k);
          }
        });
      const BitMask ball = GrowBall(cells, depth, FirstOf(cells));
      BitMask outside = ball;
      outside.Remove(cells);
      EXPECT_EQ(outside.Count(), 0U);
      ExpectSphere(ball);
    }
  }
}

TEST(CellSurface, ARingIsCutAndItsSurfaceIsASphere)
{
  const ImageGeometry grid = Grid({ { 12, 12, 3 } }, { 1, 1, 1 });
  BitMask ring(grid);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (std::max(std::abs(i - 5), std::abs(j - 5)) >= 3)
      {
        ring.Insert(i, j, k);
      }
    });
  const BitMask ball = GrowBall(ring, NoDepth(ring), 0);
  EXPECT_LT(ball.Count(), ring.Count());
  EXPECT_GT(ball.Count(), ring.Count() * 3 / 4);
  ExpectSphere(ball);
}

TEST(CellSurface, IsOutwardUnderALeftHandedGrid)
{
  ImageGeometry grid = Grid({ { 5, 4, 3 } }, { 1, 2, 1.5 });
  grid.Direction.col(1) *= -1;
  BitMask cells(grid);
  cells.Complement();
  const CellSurface surface = MakeCellSurface(cells);
  EXPECT_NO_THROW(RequireOutward(surface.Points, Triangulate(surface.Faces), "the surface"));
  ExpectSphere(cells);
}

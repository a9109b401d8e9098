#include "Mesh/SurfaceVoxelization.h"

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <limits>

using namespace FlipFree;

namespace
{

const double NotANumber = std::numeric_limits<double>::quiet_NaN();

ImageGeometry GridOf(std::array<int, 3> dimensions, const Eigen::Vector3d& spacing,
  const Eigen::Matrix3d& direction, const Eigen::Vector3d& center)
{
  ImageGeometry grid;
  grid.Dimensions = dimensions;
  grid.Spacing = spacing;
  grid.Direction = direction;
  grid.Origin = center -
    grid.ToPhysical(0.5 * Eigen::Vector3d(dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1));
  return grid;
}

std::vector<unsigned char> Voxelize(const Surface& surface, const ImageGeometry& grid)
{
  std::vector<unsigned char> voxels(grid.NumberOfVoxels(), 0);
  FillRuns<unsigned char>(VoxelizeSurface(surface.Points, surface.Triangles, grid), 1, grid,
    voxels.data());
  return voxels;
}

} // namespace

TEST(SurfaceVoxelization, IsTheWindingNumberUnderAnyDirectionAndSpacing)
{
  const Eigen::Vector3d center(12.3, -45.6, 7.8);
  const Surface potato = Potato(4, center, 10);
  for (const auto& [name, direction] : ExampleDirections())
  {
    const ImageGeometry grid = GridOf({ 26, 23, 11 }, { 1.1, 1.31, 2.7 }, direction,
      center + Eigen::Vector3d(0.4, 0.3, 0.2));
    const auto voxels = Voxelize(potato, grid);
    int inside = 0;
    ForEachVoxel(grid,
      [&, &name = name](int i, int j, int k)
      {
        const bool expected =
          WindingNumber(potato, grid.ToPhysical(Eigen::Vector3d(i, j, k))) > 0.5;
        ASSERT_EQ(voxels[grid.Offset(i, j, k)] != 0, expected)
          << name << " voxel " << i << " " << j << " " << k;
        inside += expected;
      });
    EXPECT_GT(inside, 500) << name;
  }
}

TEST(SurfaceVoxelization, OrgansThatShareWallsShareNoVoxel)
{
  // Walls exactly on voxel centers, in the orders of vertices that two separate meshes have.
  ImageGeometry grid;
  grid.Dimensions = { { 10, 9, 8 } };
  std::vector<int> count(grid.NumberOfVoxels(), 0);
  for (int part = 0; part < 8; ++part)
  {
    const Eigen::Vector3d low(part & 1 ? 4 : 1, part & 2 ? 5 : 1, part & 4 ? 3 : 1);
    const Eigen::Vector3d high(part & 1 ? 8 : 4, part & 2 ? 7 : 5, part & 4 ? 6 : 3);
    const Surface box = Box(low, high);
    const auto runs = VoxelizeSurface(box.Points, box.Triangles, grid);
    EXPECT_EQ(CountVoxels(runs), (high - low).prod());
    for (const VoxelRun& run : runs)
    {
      for (int i = run.Begin; i < run.End; ++i)
      {
        ++count[grid.Offset(i, run.J, run.K)];
      }
    }
  }
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const bool covered = i >= 1 && i < 8 && j >= 1 && j < 7 && k >= 1 && k < 6;
      ASSERT_EQ(count[grid.Offset(i, j, k)], covered) << i << " " << j << " " << k;
    });
}

TEST(SurfaceVoxelization, EveryVertexOnAVoxelCenterLeavesNoHole)
{
  // An octahedron whose vertices and edges run through voxel centers.
  Surface octahedron;
  octahedron.Points.resize(6, 3);
  octahedron.Points << 9, 5, 5, 1, 5, 5, 5, 9, 5, 5, 1, 5, 5, 5, 9, 5, 5, 1;
  octahedron.Triangles.resize(8, 3);
  octahedron.Triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  ImageGeometry grid;
  grid.Dimensions = { { 11, 11, 11 } };
  const auto voxels = Voxelize(octahedron, grid);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const int distance = std::abs(i - 5) + std::abs(j - 5) + std::abs(k - 5);
      ASSERT_TRUE(distance == 4 || voxels[grid.Offset(i, j, k)] == (distance < 4))
        << i << " " << j << " " << k;
    });
}

TEST(SurfaceVoxelization, AnImageCutsOffWhatLiesBeyondIt)
{
  const Surface sphere = Sphere(8, { 0, 0, 0 }, 10);
  const ImageGeometry whole =
    GridOf({ 30, 31, 32 }, { 0.8, 0.9, 0.7 }, ObliqueRotation(), { 0.01, 0.02, 0.03 });
  const auto voxels = Voxelize(sphere, whole);
  ImageGeometry part = whole;
  part.Dimensions = { { 9, 10, 11 } };
  part.Origin = whole.ToPhysical({ 12, 13, 14 });
  const auto cut = Voxelize(sphere, part);
  ForEachVoxel(part,
    [&](int i, int j, int k)
    { ASSERT_EQ(cut[part.Offset(i, j, k)], voxels[whole.Offset(i + 12, j + 13, k + 14)]); });
  part.Origin = Eigen::Vector3d(100, 0, 0);
  EXPECT_TRUE(VoxelizeSurface(sphere.Points, sphere.Triangles, part).empty());
}

TEST(SurfaceVoxelization, OrientationAndOverlapDoNotMatter)
{
  const ImageGeometry grid = GridOf({ 25, 25, 25 }, { 1, 1, 1 }, ObliqueRotation(), { 3, 0, 0 });
  Surface sphere = Sphere(6, { 0, 0, 0 }, 7);
  const Surface other = Sphere(6, { 6, 0, 0 }, 5);
  const auto voxels = Voxelize(sphere, grid);
  const auto otherVoxels = Voxelize(other, grid);
  sphere.Triangles.col(0).swap(sphere.Triangles.col(1));
  EXPECT_EQ(Voxelize(sphere, grid), voxels);
  sphere.Triangles.col(0).swap(sphere.Triangles.col(1));

  auto expected = voxels;
  for (std::size_t voxel = 0; voxel < expected.size(); ++voxel)
  {
    expected[voxel] |= otherVoxels[voxel];
  }
  EXPECT_EQ(Voxelize(Joined(sphere, other), grid), expected);
}

TEST(SurfaceVoxelization, ThreadsAndTheMonitor)
{
  const Surface potato = Potato(8, { 0, 0, 0 }, 10);
  const ImageGeometry grid =
    GridOf({ 40, 41, 42 }, { 0.7, 0.8, 0.9 }, ObliqueRotation(), { 0, 0, 0 });
  const auto serial = VoxelizeSurface(potato.Points, potato.Triangles, grid);
  const auto scattered = VoxelizeSurface(potato.Points, potato.Triangles, grid, ScatteredFor);
  ASSERT_EQ(serial.size(), scattered.size());
  for (std::size_t run = 0; run < serial.size(); ++run)
  {
    EXPECT_EQ(serial[run].Begin, scattered[run].Begin);
    EXPECT_EQ(serial[run].End, scattered[run].End);
  }
  std::vector<VoxelRun> untouched(1);
  EXPECT_FALSE(VoxelizeSurface(
    potato.Points, potato.Triangles, grid, SerialFor, [](double) { return false; }, untouched));
  EXPECT_EQ(untouched.size(), 1U);
}

// Finite, but in the image's frame not, or so far that differences overflow.
TEST(SurfaceVoxelization, RefusesPointsBeyondAnyImage)
{
  ImageGeometry grid;
  grid.Dimensions = { { 5, 5, 5 } };
  grid.Direction = Eigen::AngleAxisd(std::atan(1.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (const double far : { 1.6e308, -1.6e308, 1e200, 1e16 })
  {
    Surface box = Box({ 1, 1, 1 }, { 3, 3, 3 });
    box.Points.row(6) << 0, far, far;
    const std::string error = ErrorOf([&] { VoxelizeSurface(box.Points, box.Triangles, grid); });
    EXPECT_EQ(error.find("point 6 of the surface, at (0, "), 0U) << error;
    // It does not matter where no triangle uses it.
    Surface whole = Box({ 1, 1, 1 }, { 3, 3, 3 });
    whole.Points.conservativeResize(9, 3);
    whole.Points.row(8) = box.Points.row(6);
    EXPECT_FALSE(VoxelizeSurface(whole.Points, whole.Triangles, grid).empty());
  }
}

TEST(SurfaceVoxelization, RefusesBadInput)
{
  const Surface box = Box({ 1, 1, 1 }, { 3, 3, 3 });
  ImageGeometry grid;
  grid.Dimensions = { { 5, 5, 5 } };
  const auto errorOf = [](const Surface& surface, const ImageGeometry& geometry)
  { return ErrorOf([&] { VoxelizeSurface(surface.Points, surface.Triangles, geometry); }); };
  using testing::PrintToString;
  EXPECT_EQ(errorOf(box, grid), "");

  Surface open = box;
  open.Triangles.conservativeResize(11, 3);
  EXPECT_NE(errorOf(open, grid).find("not closed"), std::string::npos) << errorOf(open, grid);

  Surface twisted = box;
  twisted.Triangles.row(3).reverseInPlace();
  EXPECT_NE(errorOf(twisted, grid).find("oriented"), std::string::npos);

  Surface undefined = box;
  undefined.Points(5, 1) = NotANumber;
  EXPECT_NE(errorOf(undefined, grid).find("point 5 of the surface"), std::string::npos);

  Surface astray = box;
  astray.Triangles(0, 0) = 8;
  EXPECT_NE(errorOf(astray, grid).find("refers to point 8"), std::string::npos);

  EXPECT_NE(errorOf(Surface(), grid).find("no polygons"), std::string::npos);

  ImageGeometry flat = grid;
  flat.Spacing.z() = 0;
  EXPECT_NE(errorOf(box, flat).find("singular"), std::string::npos);
}

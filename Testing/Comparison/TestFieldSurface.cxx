// The surface of a field: that of a ball whose distance the field is, in any frame, and closed
// where the grid ends.
#include "FieldSurface.h"

#include "../Kernels/ExampleMasks.h"
#include "../Kernels/ExampleSurfaces.h"
#include "Image/SeedRegion.h"
#include "Mesh/SurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace FlipFree;

namespace
{

FloatImage BallField(const Eigen::Vector3d& center, double radius)
{
  FloatImage field;
  field.Geometry.Dimensions = { { 30, 26, 14 } };
  field.Geometry.Spacing = Eigen::Vector3d(1, 1.2, 2.5);
  field.Geometry.Origin = Eigen::Vector3d(-40, 7, 100);
  field.Geometry.Direction << 0, -0.8, 0.6, 1, 0, 0, 0, -0.6, -0.8; // left-handed
  ForEachVoxel(field.Geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d point = field.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      field.Voxels.push_back(static_cast<float>(radius - (point - center).norm()));
    });
  return field;
}

} // namespace

TEST(FieldSurface, OfADistanceIsTheBall)
{
  FloatImage field = BallField(Eigen::Vector3d::Zero(), 1);
  const Eigen::Vector3d center = field.Geometry.ToPhysical(Eigen::Vector3d(15, 13, 7));
  field = BallField(center, 10);
  const FieldSurface surface = SurfaceOfField(field.View());
  ASSERT_GT(surface.Points.rows(), 100);
  for (Eigen::Index i = 0; i < surface.Points.rows(); ++i)
  {
    EXPECT_NEAR((surface.Points.row(i).transpose() - center).norm(), 10, 0.1);
  }
  EXPECT_NO_THROW(
    RequireClosed(static_cast<int>(surface.Points.rows()), surface.Triangles, "the surface"));
  EXPECT_NEAR(EnclosedVolume({ surface.Points, surface.Triangles }), 4 * std::acos(-1) / 3 * 1000,
    90); // outward, so positive; facets cut corners
}

TEST(FieldSurface, IsClosedWhereTheGridEnds)
{
  const FloatImage field = BallField(Eigen::Vector3d(-40, 7, 100), 12); // a corner
  const FieldSurface surface = SurfaceOfField(field.View());
  ASSERT_GT(surface.Points.rows(), 50);
  EXPECT_NO_THROW(
    RequireClosed(static_cast<int>(surface.Points.rows()), surface.Triangles, "the surface"));
  EXPECT_GT(EnclosedVolume({ surface.Points, surface.Triangles }), 0);
}

TEST(FieldSurface, OfNothingIsEmpty)
{
  const FloatImage field = BallField(Eigen::Vector3d(1000, 0, 0), 1);
  EXPECT_EQ(SurfaceOfField(field.View()).Points.rows(), 0);
  EXPECT_TRUE(RunsOfField(field.View(), { { 0, 0, 0 } }).empty());
}

TEST(FieldSurface, RunsAreThePositiveVoxelsInTheWholeImage)
{
  FloatImage field = BallField(Eigen::Vector3d(-40, 7, 100), 5);
  const std::vector<VoxelRun> runs = RunsOfField(field.View(), { { 100, 200, 300 } });
  std::size_t expected = 0;
  for (const float value : field.Voxels)
  {
    expected += value > 0;
  }
  EXPECT_EQ(CountVoxels(runs), expected);
  EXPECT_EQ(runs.front().Begin, 100);
  EXPECT_EQ(runs.front().J, 200);
  EXPECT_EQ(runs.front().K, 300);
}

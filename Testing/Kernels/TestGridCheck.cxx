// Grids that are proper, and the same.
#include "Image/GridCheck.h"

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <limits>

using namespace FlipFree;

namespace
{

ImageGeometry CheckedGrid()
{
  ImageGeometry geometry = Grid({ { 20, 30, 40 } }, { 1, 2, 3 });
  geometry.Origin = { -5, 6, 7 };
  geometry.Direction << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  return geometry;
}

std::string RefusalOf(const ImageGeometry& geometry)
{
  return ErrorOf([&geometry] { RequireVoxels(geometry, "it"); });
}

std::string DifferenceOf(const ImageGeometry& geometry)
{
  return ErrorOf([&geometry] { RequireSameGeometry(geometry, CheckedGrid(), "it", "the other"); });
}

} // namespace

TEST(GridCheck, OfVoxelsOnThreeAxes)
{
  ImageGeometry geometry = CheckedGrid();
  EXPECT_EQ(RefusalOf(geometry), "");
  geometry.Spacing[2] = 0;
  EXPECT_EQ(RefusalOf(geometry).find("it has a spacing of (1, 2, 0) mm"), 0U);
  geometry.Spacing[2] = 1.9e-9; // within 5 mm, more voxels than an int counts
  EXPECT_EQ(RefusalOf(geometry).find("it has a spacing of (1, 2, 1.9e-09) mm"), 0U);
  geometry.Spacing[2] = LeastSpacing;
  EXPECT_EQ(RefusalOf(geometry), "");
  geometry = CheckedGrid();
  geometry.Origin[0] = std::numeric_limits<double>::infinity();
  EXPECT_NE(RefusalOf(geometry).find("an origin that is not finite"), std::string::npos);
  geometry = CheckedGrid();
  geometry.Direction.col(0) = geometry.Direction.col(1);
  EXPECT_NE(RefusalOf(geometry).find("cannot be inverted"), std::string::npos);
  geometry.Direction.col(0) += 0.005 * Eigen::Vector3d::UnitY(); // nearly so
  EXPECT_NE(RefusalOf(geometry).find("cannot be inverted"), std::string::npos);
  geometry.Direction.col(0) += 0.5 * Eigen::Vector3d::UnitY();
  EXPECT_EQ(RefusalOf(geometry), "");
  geometry.Dimensions[1] = 0;
  EXPECT_EQ(RefusalOf(geometry), "it has no voxels; give one that has");
}

TEST(GridCheck, SaysWhatDiffers)
{
  EXPECT_EQ(DifferenceOf(CheckedGrid()), "");
  ImageGeometry geometry = CheckedGrid();
  geometry.Origin[1] += 0.009; // a hundredth of the least spacing
  EXPECT_EQ(DifferenceOf(geometry), "");
  geometry.Origin[1] += 0.009;
  EXPECT_EQ(DifferenceOf(geometry).find("the origins of it (-5, 6.018, 7) and of the other"), 0U);
  geometry = CheckedGrid();
  geometry.Spacing[0] = 1.001;
  EXPECT_EQ(DifferenceOf(geometry).find("the spacings of it"), 0U);
  geometry = CheckedGrid();
  geometry.Direction.col(2) *= -1;
  EXPECT_EQ(DifferenceOf(geometry).find("the direction matrices of it"), 0U);
  geometry = CheckedGrid();
  geometry.Dimensions[2] = 39;
  EXPECT_EQ(DifferenceOf(geometry).find("the dimensions of it (20, 30, 39)"), 0U);
}

#include "Error.h"
#include "ExampleSurfaces.h"
#include "Image/PointCheck.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace FlipFree;

namespace
{

// 20 x 10 x 5 voxels, the first of which is centered at the origin.
ImageGeometry ExampleGrid(const Eigen::Matrix3d& direction)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 20, 10, 5 } };
  geometry.Spacing = { 1, 2, 4 };
  geometry.Direction = direction;
  return geometry;
}

std::string MessageFor(const ImageGeometry& geometry, const Eigen::Vector3d& point)
{
  try
  {
    RequirePoint(geometry, point, "the point", "the image");
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.GetCode(),
      point.allFinite() ? ErrorCode::OutOfRange : ErrorCode::NonFiniteValue);
    return error.what();
  }
  return "";
}

} // namespace

TEST(PointCheck, VoxelsAreTakenUpToTheirFaces)
{
  for (const auto& [name, direction] : ExampleDirections())
  {
    SCOPED_TRACE(name);
    const ImageGeometry geometry = ExampleGrid(direction);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double index : { -0.49, geometry.Dimensions[axis] - 0.51 })
      {
        const double beyond = index < 0 ? -0.51 : geometry.Dimensions[axis] - 0.49;
        Eigen::Vector3d place(2, 3, 1);
        place[axis] = index;
        EXPECT_EQ(MessageFor(geometry, geometry.ToPhysical(place)), "");
        place[axis] = beyond;
        EXPECT_NE(MessageFor(geometry, geometry.ToPhysical(place)), "");
      }
    }
  }
}

TEST(PointCheck, TellsWhatTheImageSpans)
{
  EXPECT_EQ(MessageFor(ExampleGrid(Eigen::Matrix3d::Identity()), { 100, 0, 0 }),
    "the point lies outside the image, which spans (-0.5, -1, -2) to (19.5, 19, 18) mm; correct "
    "its physical coordinates (LPS)");
  // The corners of an oblique image are at other ends of it.
  const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(EIGEN_PI / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_EQ(MessageFor(ExampleGrid(turned), { 100, 0, 0 }),
    "the point lies outside the image, which spans (-13.8, -1.1, -2) to (14.5, 27.2, 18) mm; "
    "correct its physical coordinates (LPS)");
}

TEST(PointCheck, RecognizesMirroredAxes)
{
  ImageGeometry geometry = ExampleGrid(Eigen::Matrix3d::Identity());
  geometry.Origin = { 50, -80, 10 };
  EXPECT_EQ(MessageFor(geometry, { 55, -75, 20 }), "");
  EXPECT_NE(MessageFor(geometry, { -55, 75, 20 })
              .find("; with x and y negated it would lie inside: check whether it is LPS or RAS"),
    std::string::npos);
  EXPECT_NE(MessageFor(geometry, { -55, -75, 20 }).find("; correct its"), std::string::npos);
}

TEST(PointCheck, APlaceHasThreeFiniteNumbers)
{
  for (const double wrong : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    EXPECT_EQ(MessageFor(ExampleGrid(Eigen::Matrix3d::Identity()), { 1, wrong, 1 }),
      "the point is not a place; give three finite numbers");
  }
}

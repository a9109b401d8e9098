#include "Geometry/WindingNumber.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <limits>

using namespace FlipFree;

TEST(WindingNumber, IsThatOfTheSide)
{
  const TestSphere sphere(8);
  const Eigen::Vector3d center(10, -20, 30);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  TriangleList inverted = sphere.Triangles();
  inverted.col(1).swap(inverted.col(2));
  for (int repeat = 0; repeat < 200; ++repeat)
  {
    const Eigen::Vector3d direction =
      Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    // The facets lie within the sphere by less than 1 mm.
    const double radius = repeat % 2 == 0 ? 24 * (repeat + 1) / 200.0 : 25.1 + repeat;
    const Eigen::Vector3d point = center + radius * direction;
    const int expected = repeat % 2 == 0 ? 1 : 0;
    EXPECT_EQ(WindingNumber(sphere.Points(), sphere.Triangles(), point), expected);
    EXPECT_EQ(WindingNumber(sphere.Points(), inverted, point), -expected);
  }
}

TEST(WindingNumber, IsZeroInTheHoleOfATorus)
{
  const TestTorus torus(24, 12);
  const auto numberAt = [&](double x)
  { return WindingNumber(torus.Points, torus.Mesh.Triangles, Eigen::Vector3d(x, 0.1, 0.2)); };
  EXPECT_EQ(numberAt(0), 0);
  EXPECT_EQ(numberAt(30), 1);
  EXPECT_EQ(numberAt(-30), 1);
  EXPECT_EQ(numberAt(45), 0);
}

// On the surface up to 1e-9 mm on either side.
TEST(WindingNumber, IsExactNearTheSurface)
{
  const TestSphere sphere(4);
  for (Eigen::Index triangle = 0; triangle < sphere.Triangles().rows(); ++triangle)
  {
    const auto corner = [&](int index) -> Eigen::Vector3d
    { return sphere.Points().row(sphere.Triangles()(triangle, index)).transpose(); };
    const Eigen::Vector3d normal =
      (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const Eigen::Vector3d middle = (corner(0) + corner(1) + corner(2)) / 3;
    EXPECT_EQ(WindingNumber(sphere.Points(), sphere.Triangles(), middle - 1e-9 * normal), 1);
    EXPECT_EQ(WindingNumber(sphere.Points(), sphere.Triangles(), middle + 1e-9 * normal), 0);
  }
}

TEST(ClosestPlace, IsNearerThanAnySample)
{
  const TestSphere sphere(3);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  for (int repeat = 0; repeat < 50; ++repeat)
  {
    const Eigen::Vector3d point = Eigen::Vector3d(10, -20, 30) +
      80 *
        (Eigen::Vector3d(part(random), part(random), part(random)) -
          Eigen::Vector3d::Constant(0.5));
    const SurfacePlace place = ClosestPlace(sphere.Points(), sphere.Triangles(), point);
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index triangle = 0; triangle < sphere.Triangles().rows(); ++triangle)
    {
      const auto corner = [&](int index) -> Eigen::Vector3d
      { return sphere.Points().row(sphere.Triangles()(triangle, index)).transpose(); };
      constexpr int steps = 12;
      for (int i = 0; i <= steps; ++i)
      {
        for (int j = 0; i + j <= steps; ++j)
        {
          const Eigen::Vector3d sample =
            corner(0) + (corner(1) - corner(0)) * i / steps + (corner(2) - corner(0)) * j / steps;
          least = std::min(least, (sample - point).norm());
        }
      }
    }
    const double distance = (place.Point - point).norm();
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 1.5); // a third of the samples' distance
    ASSERT_GE(place.Triangle, 0);
  }
}

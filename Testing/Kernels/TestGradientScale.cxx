// The root mean square of gradients: of ramps, and against brute force.
#include "Image/GradientScale.h"

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

constexpr double Everywhere = std::numeric_limits<double>::infinity();

FloatImage ScaledRamp(const ImageGeometry& geometry, const Eigen::Vector3d& slopes)
{
  FloatImage image{ geometry, {} };
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d along = geometry.Spacing.cwiseProduct(Eigen::Vector3d(i, j, k));
      image.Voxels.push_back(static_cast<float>(slopes.dot(along)));
    });
  return image;
}

double ScaleOf(const FloatImage& image, const VoxelBox& box, const SeedSphere& sphere,
  const ParallelFor& parallelFor = SerialFor)
{
  double scale = -1;
  EXPECT_TRUE(MeasureGradientScale(ReaderOf(image.View()), image.Geometry, box, sphere,
    { parallelFor, 2 }, NeverStop, scale));
  return scale;
}

} // namespace

TEST(GradientScale, OfARampIsItsSlopeAwayFromTheBorder)
{
  const FloatImage image = ScaledRamp(Grid({ { 20, 20, 20 } }, { 0.5, 1, 2 }), { 3, 0, 4 });
  const VoxelBox whole = WholeBox(image.Geometry);
  const VoxelBox inner{ { { 1, 1, 1 } }, { { 19, 19, 19 } } };
  EXPECT_NEAR(ScaleOf(image, inner, { { 0, 0, 0 }, Everywhere }), 5, 1e-5);
  EXPECT_LT(ScaleOf(image, whole, { { 0, 0, 0 }, Everywhere }), 4.99); // half of it at the border
  EXPECT_NEAR(ScaleOf(image, whole, { { 5, 10, 20 }, 3.5 }), 5, 1e-5);
  EXPECT_EQ(ScaleOf(image, whole, { { 5.25, 10.5, 21 }, 0.1 }), 0); // between voxels
}

TEST(GradientScale, IsThatOfBruteForceInAnyNumberOfThreads)
{
  FloatImage image{ Grid({ { 9, 7, 11 } }, { 1, 1.5, 2 }), {} };
  std::mt19937 random(3);
  std::normal_distribution<float> normal(0, 10);
  ForEachVoxel(image.Geometry, [&](int, int, int) { image.Voxels.push_back(normal(random)); });
  const SeedSphere sphere{ { 3, 5, 10 }, 5 };
  const VoxelBox box{ { { 0, 1, 2 } }, { { 8, 7, 11 } } };
  double sum = 0;
  int count = 0;
  ForEachVoxel(box,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d place = image.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      if ((place - sphere.Center).norm() > sphere.Radius)
      {
        return;
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        std::array<int, 3> before{ { i, j, k } };
        std::array<int, 3> after = before;
        before[axis] = std::max(0, before[axis] - 1);
        after[axis] = std::min(image.Geometry.Dimensions[axis] - 1, after[axis] + 1);
        const double difference = static_cast<double>(image.View()(after[0], after[1], after[2])) -
          image.View()(before[0], before[1], before[2]);
        sum += std::pow(difference / (2 * image.Geometry.Spacing[axis]), 2);
      }
      ++count;
    });
  ASSERT_GT(count, 50);
  const double scale = ScaleOf(image, box, sphere);
  EXPECT_NEAR(scale, std::sqrt(sum / count), 1e-9);
  EXPECT_EQ(ScaleOf(image, box, sphere, ScatteredFor), scale);
}

TEST(GradientScale, StopsWhenTold)
{
  const FloatImage image = ScaledRamp(Grid({ { 5, 5, 5 } }, { 1, 1, 1 }), { 1, 1, 1 });
  double scale = -1;
  EXPECT_FALSE(MeasureGradientScale(
    ReaderOf(image.View()), image.Geometry, WholeBox(image.Geometry), { { 0, 0, 0 }, Everywhere },
    {}, [](double) { return false; }, scale));
  EXPECT_EQ(scale, -1);
}

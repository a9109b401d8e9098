#include "ExampleMasks.h"
#include "Image/ImageInterpolation.h"

#include <gtest/gtest.h>

#include <random>

using namespace FlipFree;

namespace
{

double Trilinear(const Eigen::Vector3d& x)
{
  return 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2] + 0.25 * x[0] * x[1] * x[2] - x[1] * x[2];
}

struct SampledImage
{
  explicit SampledImage(std::array<int, 3> dimensions)
  {
    this->View.Geometry.Dimensions = dimensions;
    ForEachVoxel(this->View.Geometry,
      [&](int i, int j, int k) {
        this->Voxels.push_back(static_cast<float>(Trilinear({ i + 0.0, j + 0.0, k + 0.0 })));
      });
    this->View.Data = this->Voxels.data();
  }
  std::vector<float> Voxels;
  ImageView<float> View;
};

} // namespace

// A function that is linear along each axis is reproduced, and continued at the border by its value
// there; images one voxel thick included.
TEST(ImageInterpolation, ReproducesTrilinearFunctionsAndClamps)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-3, 9);
  for (const std::array<int, 3>& dimensions : { std::array<int, 3>{ { 5, 7, 6 } },
         std::array<int, 3>{ { 5, 1, 6 } }, std::array<int, 3>{ { 1, 1, 1 } } })
  {
    const SampledImage image(dimensions);
    for (int repeat = 0; repeat < 1000; ++repeat)
    {
      const Eigen::Vector3d index(uniform(random), uniform(random), uniform(random));
      Eigen::Vector3d clamped;
      for (int axis = 0; axis < 3; ++axis)
      {
        clamped[axis] = std::min(dimensions[axis] - 1.0, std::max(0.0, index[axis]));
      }
      ASSERT_NEAR(InterpolateClamped(image.View, index), Trilinear(clamped), 1e-4)
        << index.transpose();
    }
    EXPECT_EQ(InterpolateClamped(image.View, Eigen::Vector3d::Zero()), 1);
  }
}

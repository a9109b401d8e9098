#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/GaussianSmoothing.h"

#include <gtest/gtest.h>

using namespace FlipFree;

TEST(GaussianSmoothing, OfAnImpulseIsTheKernel)
{
  const ImageGeometry geometry = Grid({ { 41, 33, 15 } }, { 0.8, 1, 2.5 });
  const double deviation = 3;
  std::vector<float> voxels(geometry.NumberOfVoxels(), 0.0F);
  voxels[geometry.Offset(20, 16, 7)] = 1;
  SmoothGaussian(voxels, geometry, deviation, SerialFor);
  double sum = 0;
  const float center = voxels[geometry.Offset(20, 16, 7)];
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d offset =
        geometry.Spacing.cwiseProduct(Eigen::Vector3d(i - 20, j - 16, k - 7));
      const float value = voxels[geometry.Offset(i, j, k)];
      sum += value;
      if (offset.cwiseAbs().maxCoeff() < 2.9 * deviation)
      {
        const double expected = std::exp(-0.5 * offset.squaredNorm() / (deviation * deviation));
        EXPECT_NEAR(value / center, expected, 1e-5);
      }
    });
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(GaussianSmoothing, SameBitsHoweverCut)
{
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0, 1);
  for (const ImageGeometry& geometry : ExampleGrids())
  {
    std::vector<float> voxels(geometry.NumberOfVoxels());
    for (float& voxel : voxels)
    {
      voxel = normal(random);
    }
    std::vector<float> copy = voxels;
    SmoothGaussian(voxels, geometry, 1.5, SerialFor);
    SmoothGaussian(copy, geometry, 1.5, ScatteredFor);
    EXPECT_EQ(voxels, copy);
  }
}

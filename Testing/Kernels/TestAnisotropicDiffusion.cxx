#include "AnisotropicDiffusion.h"
#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace FlipFree;

namespace
{

ImageGeometry Grid(std::array<int, 3> dimensions, const Eigen::Vector3d& spacing)
{
  ImageGeometry geometry;
  geometry.Dimensions = dimensions;
  geometry.Spacing = spacing;
  return geometry;
}

// A step of 100 in the middle of x, with noise.
std::vector<float> NoisyStep(const ImageGeometry& geometry, double noise)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<float> voxels(geometry.NumberOfVoxels());
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    const int i = static_cast<int>(voxel % geometry.Dimensions[0]);
    const double level = 2 * i < geometry.Dimensions[0] ? 0 : 100;
    voxels[voxel] = static_cast<float>(level + noise * normal(random));
  }
  return voxels;
}

std::vector<float> Diffused(std::vector<float> voxels, const ImageGeometry& geometry,
  int iterations, double contrast, const ParallelFor& parallelFor = SerialFor)
{
  EXPECT_TRUE(
    DiffuseAnisotropically(voxels, geometry, { iterations, contrast }, parallelFor, NeverStop));
  return voxels;
}

double Mean(const std::vector<float>& voxels)
{
  return std::accumulate(voxels.begin(), voxels.end(), 0.0) / static_cast<double>(voxels.size());
}

double Deviation(const std::vector<float>& voxels)
{
  const double mean = Mean(voxels);
  double sum = 0;
  for (float voxel : voxels)
  {
    sum += (voxel - mean) * (voxel - mean);
  }
  return std::sqrt(sum / static_cast<double>(voxels.size()));
}

const std::vector<ImageGeometry> ExampleGrids{ Grid({ { 24, 18, 11 } }, { 1, 1, 1 }),
  Grid({ { 24, 18, 11 } }, { 0.7, 0.7, 5 }), Grid({ { 24, 18, 11 } }, { 4, 0.1, 1 }),
  Grid({ { 24, 1, 11 } }, { 1, 1, 1 }), Grid({ { 1, 1, 1 } }, { 1, 2, 3 }) };

} // namespace

TEST(AnisotropicDiffusion, LeavesAConstantImage)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    const std::vector<float> constant(geometry.NumberOfVoxels(), -1024.25F);
    EXPECT_EQ(Diffused(constant, geometry, 10, 20), constant);
  }
}

TEST(AnisotropicDiffusion, KeepsTheMeanAndTheRange)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    for (double contrast : { 1.0, 20.0, 1e4 })
    {
      const std::vector<float> voxels = NoisyStep(geometry, 15);
      const std::vector<float> smooth = Diffused(voxels, geometry, 50, contrast);
      EXPECT_NEAR(Mean(smooth), Mean(voxels), 1e-3);
      const auto before = std::minmax_element(voxels.begin(), voxels.end());
      const auto after = std::minmax_element(smooth.begin(), smooth.end());
      EXPECT_GE(*after.first, *before.first - 1e-3F);
      EXPECT_LE(*after.second, *before.second + 1e-3F);
    }
  }
}

// The noise goes from the two halves, the step between them stays.
TEST(AnisotropicDiffusion, SmoothsNoiseAndKeepsEdges)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  const std::vector<float> smooth = Diffused(NoisyStep(geometry, 5), geometry, 10, 15);
  std::vector<float> left;
  std::vector<float> right;
  for (std::size_t voxel = 0; voxel < smooth.size(); ++voxel)
  {
    (voxel % 24 < 12 ? left : right).push_back(smooth[voxel]);
  }
  EXPECT_LT(Deviation(left), 2.5);
  EXPECT_LT(Deviation(right), 2.5);
  EXPECT_GT(Mean(right) - Mean(left), 95);

  // With a contrast above the step it goes, too.
  const std::vector<float> flat = Diffused(NoisyStep(geometry, 5), geometry, 2000, 1e4);
  EXPECT_LT(Deviation(flat), 2);
}

// Small differences diffuse linearly: along x alone, by the known factor of a cosine per step,
// which follows from spacing.
TEST(AnisotropicDiffusion, DiffusesByTheSpacing)
{
  for (const Eigen::Vector3d& spacing :
    { Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 3), Eigen::Vector3d(2, 1, 0.5) })
  {
    const ImageGeometry geometry = Grid({ { 16, 4, 4 } }, spacing);
    std::vector<float> wave(geometry.NumberOfVoxels());
    const auto cosine = [](std::size_t voxel)
    { return std::cos(EIGEN_PI * (static_cast<double>(voxel % 16) + 0.5) / 16); };
    for (std::size_t voxel = 0; voxel < wave.size(); ++voxel)
    {
      wave[voxel] = static_cast<float>(cosine(voxel));
    }
    const int iterations = 40;
    const Eigen::Array3d rates = spacing.array().square().inverse();
    const double factor = 1 - (1 - std::cos(EIGEN_PI / 16)) * rates[0] / rates.sum();
    const std::vector<float> smooth = Diffused(wave, geometry, iterations, 1e6);
    for (std::size_t voxel = 0; voxel < wave.size(); ++voxel)
    {
      ASSERT_NEAR(smooth[voxel], std::pow(factor, iterations) * cosine(voxel), 1e-4);
    }
  }
}

TEST(AnisotropicDiffusion, AnyNumberOfThreadsGivesTheSameBits)
{
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    const std::vector<float> voxels = NoisyStep(geometry, 15);
    EXPECT_EQ(Diffused(voxels, geometry, 7, 20, ScatteredFor), Diffused(voxels, geometry, 7, 20));
  }
}

TEST(AnisotropicDiffusion, WithoutContrastEverythingIsAnEdge)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  for (double contrast : { 0.0, 1e-30 })
  {
    const std::vector<float> voxels = NoisyStep(geometry, 5);
    EXPECT_EQ(Diffused(voxels, geometry, 3, contrast), voxels);
    const std::vector<float> noiseless = NoisyStep(geometry, 0);
    EXPECT_EQ(Diffused(noiseless, geometry, 3, contrast), noiseless);
  }
}

TEST(AnisotropicDiffusion, StopsWhenTold)
{
  const ImageGeometry geometry = Grid({ { 24, 18, 11 } }, { 1, 1, 1 });
  const std::vector<float> before = NoisyStep(geometry, 5);
  std::vector<float> voxels = before;
  std::vector<double> fractions;
  const auto monitor = [&](double fraction)
  {
    fractions.push_back(fraction);
    return fractions.size() < 4;
  };
  EXPECT_FALSE(DiffuseAnisotropically(voxels, geometry, { 100, 15 }, SerialFor, monitor));
  EXPECT_EQ(fractions.size(), 4u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(voxels, Diffused(before, geometry, 3, 15));
  voxels = before;
  EXPECT_FALSE(
    DiffuseAnisotropically(voxels, geometry, { 5, 15 }, SerialFor, [](double) { return false; }));
  EXPECT_EQ(voxels, before);
}

TEST(AnisotropicDiffusion, ContrastLiesAboveTheNoise)
{
  EXPECT_GT(ContrastOfNoise(0), 0);
  EXPECT_NEAR(ContrastOfNoise(10), 2 * std::sqrt(2.0) * 10, 1e-9);
}

// Local means on blocks, against sums over all voxels.
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/LocalMeans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace FlipFree;

namespace
{

// A mask and gray values on a grid, in which blocks are not cubes.
struct MaskedImage
{
  ImageGeometry Geometry = Grid({ { 70, 13, 9 } }, { 1, 1.5, 4 });
  BitMask Mask;
  std::vector<float> Voxels;

  explicit MaskedImage(double part)
  {
    std::mt19937 random(4);
    this->Mask = BitsOf(RandomMask(this->Geometry, part, random), this->Geometry);
    std::normal_distribution<float> gray(100, 20);
    this->Voxels.resize(this->Geometry.NumberOfVoxels());
    std::generate(this->Voxels.begin(), this->Voxels.end(), [&] { return gray(random); });
  }

  ImagePart Part() const { return { { this->Voxels.data(), this->Geometry }, {} }; }
};

} // namespace

TEST(LocalMeans, SumTheVoxelsOfTheMaskInEachBlock)
{
  const MaskedImage image(0.4);
  const BlockGrid grid(image.Geometry, 4);
  const BlockSums sums = SumInBlocks(image.Part(), image.Mask, grid, ScatteredFor);
  std::vector<double> expected(grid.Blocks.NumberOfVoxels(), 0);
  std::vector<float> counts(expected.size(), 0);
  image.Mask.ForEach(
    [&](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
      const std::size_t block = grid.Blocks.Offset(index[0] / grid.Factor[0],
        index[1] / grid.Factor[1], index[2] / grid.Factor[2]);
      expected[block] += image.Voxels[voxel];
      counts[block] += 1;
    });
  EXPECT_EQ(sums.Weights, counts);
  for (std::size_t block = 0; block < expected.size(); ++block)
  {
    EXPECT_NEAR(sums.Values[block], expected[block], 1e-3);
  }
  const double whole = std::accumulate(expected.begin(), expected.end(), 0.0);
  EXPECT_NEAR(sums.Mean(), whole / static_cast<double>(image.Mask.Count()), 1e-3);
  EXPECT_EQ(BlockSums().Mean(), 0);
}

// The mean of equal values is that value, however few voxels there are; far away there is none.
TEST(LocalMeans, AreNormalizedByTheWeights)
{
  MaskedImage image(0.1);
  std::fill(image.Voxels.begin(), image.Voxels.end(), 42.0F);
  for (int k = 0; k < 9; ++k)
  {
    for (int j = 0; j < 13; ++j)
    {
      image.Mask.RemoveRun(10, 70, j, k);
    }
  }
  const BlockGrid grid(image.Geometry, 4);
  const std::vector<float> means =
    LocalMeans(SumInBlocks(image.Part(), image.Mask, grid, SerialFor), grid.Blocks, 4, 1e-9F, -1,
      ScatteredFor);
  EXPECT_NEAR(means[grid.BlockAt({ 2, 8, 16 })], 42, 1e-3);
  EXPECT_NEAR(means[grid.BlockAt({ 16, 8, 16 })], 42, 1e-3);
  EXPECT_EQ(means[grid.BlockAt({ 60, 8, 16 })], -1);
}

TEST(LocalMeans, DifferencesAreThoseOfTheMasksVoxelsInOrder)
{
  const MaskedImage image(0.3);
  const BlockGrid grid(image.Geometry, 4);
  const std::vector<float> means(grid.Blocks.NumberOfVoxels(), 90.0F);
  const std::vector<float> differences = DifferencesFrom(means, grid, image.Part(), image.Mask);
  std::vector<float> expected;
  image.Mask.ForEach([&](std::size_t voxel) { expected.push_back(image.Voxels[voxel] - 90.0F); });
  ASSERT_EQ(differences.size(), expected.size());
  for (std::size_t voxel = 0; voxel < expected.size(); ++voxel)
  {
    EXPECT_NEAR(differences[voxel], expected[voxel], 1e-4);
  }
}

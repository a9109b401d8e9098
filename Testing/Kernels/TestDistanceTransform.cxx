#include "BallMorphology.h"
#include "DistanceTransform.h"
#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

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

std::vector<unsigned char> RandomMask(const ImageGeometry& geometry, double part,
  std::mt19937& random)
{
  std::vector<unsigned char> mask(geometry.NumberOfVoxels());
  std::bernoulli_distribution coin(part);
  for (unsigned char& voxel : mask)
  {
    voxel = coin(random);
  }
  return mask;
}

double BruteForce(const std::vector<unsigned char>& mask, const ImageGeometry& geometry,
  unsigned char target, const Eigen::Vector3d& index)
{
  double least = 1e20;
  for (int k = 0; k < geometry.Dimensions[2]; ++k)
  {
    for (int j = 0; j < geometry.Dimensions[1]; ++j)
    {
      for (int i = 0; i < geometry.Dimensions[0]; ++i)
      {
        if (mask[geometry.Offset(i, j, k)] == target)
        {
          const Eigen::Vector3d offset(i - index[0], j - index[1], k - index[2]);
          least = std::min(least, geometry.Spacing.cwiseProduct(offset).squaredNorm());
        }
      }
    }
  }
  return least;
}

const std::vector<ImageGeometry> ExampleGrids{ Grid({ { 13, 11, 9 } }, { 1, 1, 1 }),
  Grid({ { 14, 9, 7 } }, { 0.7, 1.3, 3.1 }), Grid({ { 9, 12, 5 } }, { 5, 0.4, 1 }),
  Grid({ { 1, 20, 1 } }, { 1, 2, 3 }), Grid({ { 20, 1, 6 } }, { 2, 1, 0.5 }) };

} // namespace

TEST(DistanceTransform, IsTheBruteForceDistance)
{
  std::mt19937 random(1);
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    for (double part : { 0.005, 0.05, 0.5, 0.97 })
    {
      const std::vector<unsigned char> mask = RandomMask(geometry, part, random);
      for (unsigned char target : { 0, 1 })
      {
        const std::vector<float> distance =
          SquaredDistance(mask, geometry, target, SerialFor, NeverStop);
        ASSERT_EQ(distance.size(), mask.size());
        for (int k = 0; k < geometry.Dimensions[2]; ++k)
        {
          for (int j = 0; j < geometry.Dimensions[1]; ++j)
          {
            for (int i = 0; i < geometry.Dimensions[0]; ++i)
            {
              const double expected =
                BruteForce(mask, geometry, target, { i + 0.0, j + 0.0, k + 0.0 });
              ASSERT_NEAR(distance[geometry.Offset(i, j, k)], expected, 1e-5 * expected);
            }
          }
        }
        EXPECT_EQ(SquaredDistance(mask, geometry, target, ScatteredFor, NeverStop), distance);
      }
    }
  }
}

TEST(BallMorphology, GrowsAndShrinksByABallInMillimetres)
{
  std::mt19937 random(2);
  for (const ImageGeometry& geometry : ExampleGrids)
  {
    for (double radius : { 0.0, 0.65, 1.0, 2.0, 3.3, 30.0 })
    {
      for (unsigned char value : { 0, 1 })
      {
        const std::vector<unsigned char> mask = RandomMask(geometry, value ? 0.03 : 0.97, random);
        std::vector<unsigned char> grown = mask;
        GrowValue(grown, geometry, radius, value, SerialFor, NeverStop);
        std::vector<unsigned char> threaded = mask;
        GrowValue(threaded, geometry, radius, value, ScatteredFor, NeverStop);
        ASSERT_EQ(threaded, grown);
        for (int k = 0; k < geometry.Dimensions[2]; ++k)
        {
          for (int j = 0; j < geometry.Dimensions[1]; ++j)
          {
            for (int i = 0; i < geometry.Dimensions[0]; ++i)
            {
              // A ball that ends exactly at a voxel's centre holds it.
              const double square =
                BruteForce(mask, geometry, value, { i + 0.0, j + 0.0, k + 0.0 });
              const std::size_t voxel = geometry.Offset(i, j, k);
              const bool within = std::sqrt(square) <= radius + 1e-6;
              ASSERT_EQ(grown[voxel] == value, within || mask[voxel] == value);
            }
          }
        }
      }
    }
  }
}

TEST(DistanceTransform, EmptyAndFullMasks)
{
  const ImageGeometry geometry = Grid({ { 6, 5, 4 } }, { 1, 2, 3 });
  for (unsigned char value : { 0, 1 })
  {
    const std::vector<unsigned char> uniform(geometry.NumberOfVoxels(), value);
    for (float distance : SquaredDistance(uniform, geometry, value, SerialFor, NeverStop))
    {
      EXPECT_EQ(distance, 0);
    }
    const unsigned char other = 1 - value;
    for (float distance : SquaredDistance(uniform, geometry, other, SerialFor, NeverStop))
    {
      EXPECT_GT(distance, 1e18f);
    }
    std::vector<unsigned char> grown = uniform;
    GrowValue(grown, geometry, 100, other, SerialFor, NeverStop);
    EXPECT_EQ(grown, uniform);
  }
}

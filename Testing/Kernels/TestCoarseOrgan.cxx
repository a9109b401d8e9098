// Second looks at an organ on blocks, on a bright ball in dark surroundings with a brighter rim.
#include "Evidence/CoarseOrgan.h"
#include "ExampleMasks.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/ModelFit.h"

#include <gtest/gtest.h>

#include <random>

using namespace FlipFree;

namespace
{

const ParallelFor OneThread = SerialFor; // which an organ refers to

struct BallWithRim
{
  ImageGeometry Geometry = Grid({ { 80, 80, 40 } }, { 1, 1, 2 });
  SeedSphere Seed{ { 40, 40, 40 }, 10 };
  OrganFeatureSettings Settings;
  FloatImage Image{ Geometry, {} };
  IntensityModel OfSeed;

  BallWithRim()
  {
    this->Settings.Modality = Modality::MR;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 4);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const double away =
          (this->Geometry.ToPhysical({ 1.0 * i, 1.0 * j, 1.0 * k }) - this->Seed.Center).norm();
        const double value = away < 20 ? 100 : away < 30 ? 130 : 0;
        this->Image.Voxels.push_back(static_cast<float>(value + noise(random)));
      });
    this->OfSeed = FitToSeed(this->Image.View(), this->Seed, 4, this->Settings.Intensity);
  }

  BitMask Ball(double radius) const
  {
    BitMask ball(this->Geometry);
    for (const std::size_t voxel : VoxelsInSphere(this->Geometry, { this->Seed.Center, radius }))
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      ball.Insert(index[0], index[1], index[2]);
    }
    return ball;
  }

  CoarseOrgan Organ() const
  {
    return { { this->Image.View(), {} }, this->Geometry, this->Ball(20), this->Seed, 4,
      this->Settings, this->OfSeed, OneThread };
  }
};

} // namespace

TEST(CoarseOrgan, IsOnBlocksOfWhichAMaskHoldsHalf)
{
  const BallWithRim image;
  const CoarseOrgan organ = image.Organ();
  const BlockGrid& grid = organ.GetGrid();
  EXPECT_GT(grid.VoxelsPerBlock(), 8U);
  const BitMask blocks = organ.BlocksOf(image.Ball(20));
  EXPECT_GT(Dice(grid.VoxelsOf(blocks, SerialFor), image.Ball(20)), 0.93);
}

TEST(CoarseOrgan, SupportsTheMaskThatEndsAtTheStrongestEdge)
{
  const BallWithRim image;
  const CoarseOrgan organ = image.Organ();
  const double atEdge = organ.SupportOf(organ.BlocksOf(image.Ball(30)));
  EXPECT_GT(atEdge, 2 * organ.SupportOf(organ.BlocksOf(image.Ball(20))));
  EXPECT_GT(atEdge, 2 * organ.SupportOf(organ.BlocksOf(image.Ball(25))));
}

TEST(CoarseOrgan, GrowsLessByANarrowerInterval)
{
  const BallWithRim image;
  const CoarseOrgan organ = image.Organ();
  BitMask wide;
  BitMask narrow;
  ASSERT_TRUE(organ.Grow(0.99999, NeverStop, wide));
  ASSERT_TRUE(organ.Grow(0.8, NeverStop, narrow));
  EXPECT_GT(Dice(narrow, organ.BlocksOf(image.Ball(20))), 0.85);
  EXPECT_LE(narrow.Count(), wide.Count());
  EXPECT_GE(NarrowedTo(0.8, image.OfSeed).Threshold, image.OfSeed.Threshold);
  EXPECT_FALSE(organ.Grow(
    0.8, [](double) { return false; }, narrow));
}

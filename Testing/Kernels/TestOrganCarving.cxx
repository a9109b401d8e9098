// Carving on phantoms whose necks and boundaries are known.
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BallInside.h"
#include "Image/GaussianSmoothing.h"
#include "Intensity/HalfContrastRim.h"
#include "Intensity/NeckCarving.h"
#include "Intensity/OrganCarving.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

using Shape = std::function<bool(const Eigen::Vector3d&)>;

Shape Ball(const Eigen::Vector3d& center, double radius)
{
  return [=](const Eigen::Vector3d& point) { return (point - center).norm() < radius; };
}

BitMask MaskOf(const ImageGeometry& geometry, const Shape& shape)
{
  BitMask mask(geometry);
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      if (shape(geometry.ToPhysical(Eigen::Vector3d(i, j, k))))
      {
        mask.Insert(i, j, k);
      }
    });
  return mask;
}

// `inside` in the shape, `outside` around it, blurred by a Gaussian.
FloatImage ImageOf(const ImageGeometry& geometry, const Shape& shape, float inside, float outside,
  double blur, double noise)
{
  FloatImage image{ geometry, {} };
  ForEachVoxel(geometry,
    [&](int i, int j, int k)
    {
      const bool is = shape(geometry.ToPhysical(Eigen::Vector3d(i, j, k)));
      image.Voxels.push_back(is ? inside - outside : 0);
    });
  if (blur > 0)
  {
    SmoothGaussian(image.Voxels, geometry, blur, SerialFor);
  }
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  for (float& voxel : image.Voxels)
  {
    voxel += outside + static_cast<float>(normal(random));
  }
  return image;
}

// Of the ball of the same volume.
double RadiusOf(const BitMask& mask)
{
  return RadiusOf(mask, SeedSphere{});
}

// Two balls that a neck joins. The one behind the neck is brighter.
struct Leak
{
  ImageGeometry Geometry = Grid({ { 120, 60, 40 } }, { 1, 1, 1.5 });
  SeedSphere Seed{ { 30, 30, 30 }, 14 };
  Shape Organ = Ball({ 30, 30, 30 }, 20);
  Shape Both = [organ = this->Organ](const Eigen::Vector3d& point)
  {
    const bool neck =
      point.x() > 30 && point.x() < 85 && std::hypot(point.y() - 30, point.z() - 30) < 6;
    return organ(point) || neck || (point - Eigen::Vector3d(85, 30, 30)).norm() < 22;
  };
};

} // namespace

TEST(OrganCarving, CutsOffWhatLiesBehindANeck)
{
  const Leak leak;
  const BitMask organ = MaskOf(leak.Geometry, leak.Organ);
  for (const float scale : { 1.0F, 0.1F, 37.0F })
  {
    for (const Modality modality : { Modality::CT, Modality::MR })
    {
      if (modality == Modality::CT && scale != 1)
      {
        continue;
      }
      FloatImage image = ImageOf(leak.Geometry, leak.Both, 100 * scale, 20 * scale, 0, 4 * scale);
      const BitMask behind = MaskOf(leak.Geometry, Ball({ 85, 30, 30 }, 22));
      behind.ForEach([&](std::size_t voxel) { image.Voxels[voxel] += 100 * scale; });
      const ImagePart part{ image.View() };
      BitMask mask = MaskOf(leak.Geometry, leak.Both);
      EXPECT_LT(Dice(mask, organ), 0.62);
      ASSERT_TRUE(CarveNecks(part, leak.Seed, 4.0 * scale, modality, SerialFor, NeverStop, mask));
      // Some of the neck, which is like the organ, may stay.
      EXPECT_GT(Dice(mask, organ), 0.9);
      BitMask left = mask;
      left.Intersect(behind);
      EXPECT_LT(left.Count(), behind.Count() / 20);
      BitMask other = MaskOf(leak.Geometry, leak.Both);
      ASSERT_TRUE(
        CarveNecks(part, leak.Seed, 4.0 * scale, modality, ScatteredFor, NeverStop, other));
      EXPECT_EQ(mask, other);
    }
  }
}

// A seed that is small in its organ carves like one that fills it.
TEST(OrganCarving, DoesNotDependOnTheSeedsSize)
{
  const Leak leak;
  const BitMask organ = MaskOf(leak.Geometry, leak.Organ);
  const FloatImage image = ImageOf(leak.Geometry, leak.Organ, 100, 20, 1, 4);
  BitMask first;
  for (const double radius : { 19.0, 6.0, 3.0 })
  {
    SCOPED_TRACE(radius);
    BitMask mask = organ;
    const SeedSphere seed{ leak.Seed.Center, radius };
    ASSERT_TRUE(CarveNecks({ image.View() }, seed, 4, Modality::CT, SerialFor, NeverStop, mask));
    EXPECT_GT(Dice(mask, organ), 0.98);
    first = radius == 19 ? mask : first;
    EXPECT_EQ(mask, first);
  }
}

TEST(OrganCarving, RadiusIsThatOfABallOrTheSeeds)
{
  const ImageGeometry geometry = Grid({ { 60, 60, 40 } }, { 1, 1, 1.5 });
  const BitMask ball = MaskOf(geometry, Ball({ 30, 30, 30 }, 20));
  EXPECT_NEAR(RadiusOf(ball, { { 30, 30, 30 }, 5 }), 20, 0.1);
  EXPECT_EQ(RadiusOf(ball, { { 30, 30, 30 }, 25 }), 25);
  EXPECT_EQ(RadiusOf(BitMask(geometry), { { 30, 30, 30 }, 5 }), 5);
}

TEST(OrganCarving, BallInsideEndsAtTheMask)
{
  const ImageGeometry geometry = Grid({ { 60, 60, 40 } }, { 1, 1, 1.5 });
  BitMask mask = MaskOf(geometry, Ball({ 30, 30, 30 }, 20));
  const SeedSphere seed{ { 30, 30, 30 }, 5 };
  EXPECT_NEAR(BallInside(mask, seed).Radius, 20, 0.01);
  EXPECT_NEAR(BallInside(mask, { { 36, 30, 30 }, 5 }).Radius, 14, 0.5);
  EXPECT_EQ(BallInside(mask, { { 55, 30, 30 }, 5 }).Radius, 5); // outside
  EXPECT_EQ(BallInside(BitMask(geometry), seed).Radius, 5);
  mask.Complement();
  EXPECT_EQ(BallInside(mask, seed).Radius, 5);
  mask.Unite(MaskOf(geometry, Ball({ 30, 30, 30 }, 21)));
  EXPECT_EQ(BallInside(mask, seed).Radius, 5); // the whole grid
}

TEST(OrganCarving, LeavesAnOrganWithoutNecksAlone)
{
  const Leak leak;
  const BitMask organ = MaskOf(leak.Geometry, leak.Organ);
  const FloatImage image = ImageOf(leak.Geometry, leak.Organ, 100, 20, 0, 4);
  BitMask mask = organ;
  ASSERT_TRUE(CarveNecks({ image.View() }, leak.Seed, 4, Modality::CT, SerialFor, NeverStop, mask));
  EXPECT_GT(Dice(mask, organ), 0.99);
}

TEST(OrganCarving, KeepsTheSeedWithoutAnyMask)
{
  const Leak leak;
  const FloatImage image = ImageOf(leak.Geometry, leak.Organ, 100, 20, 0, 4);
  BitMask mask(leak.Geometry);
  ASSERT_TRUE(CarveNecks({ image.View() }, leak.Seed, 4, Modality::CT, SerialFor, NeverStop, mask));
  BitMask source = MaskOf(leak.Geometry, Ball(leak.Seed.Center, 0.55 * leak.Seed.Radius));
  source.Remove(mask);
  EXPECT_EQ(source.Count(), 0);
}

// However far within the blur the mask ends.
TEST(HalfContrastRim, FindsTheBoundaryOfABlurredBall)
{
  const ImageGeometry geometry = Grid({ { 80, 80, 80 } }, { 1, 1, 1 });
  const Shape ball = Ball({ 40, 40, 40 }, 20);
  const double expected = RadiusOf(MaskOf(geometry, ball));
  for (const Modality modality : { Modality::CT, Modality::MR })
  {
    const FloatImage image = ImageOf(geometry, ball, 120, 20, 2, 4);
    for (const double radius : { 17.5, 18.5, 19.5 })
    {
      BitMask mask = MaskOf(geometry, Ball({ 40, 40, 40 }, radius));
      ASSERT_TRUE(GrowRim({ image.View() }, 8, modality, SerialFor, NeverStop, mask));
      EXPECT_NEAR(RadiusOf(mask), expected, 0.7) << radius;
      BitMask other = MaskOf(geometry, Ball({ 40, 40, 40 }, radius));
      ASSERT_TRUE(GrowRim({ image.View() }, 8, modality, ScatteredFor, NeverStop, other));
      EXPECT_EQ(mask, other);
    }
  }
}

TEST(HalfContrastRim, LeavesAMaskWithoutACoreAlone)
{
  const ImageGeometry geometry = Grid({ { 20, 20, 20 } }, { 1, 1, 1 });
  const FloatImage image = ImageOf(geometry, Ball({ 10, 10, 10 }, 6), 100, 0, 0, 1);
  const BitMask thin = MaskOf(geometry, Ball({ 10, 10, 10 }, 1.5));
  BitMask mask = thin;
  ASSERT_TRUE(GrowRim({ image.View() }, 1, Modality::CT, SerialFor, NeverStop, mask));
  EXPECT_EQ(mask, thin);
}

TEST(OrganCarving, Stops)
{
  const Leak leak;
  const FloatImage image = ImageOf(leak.Geometry, leak.Both, 100, 20, 0, 4);
  for (int allowed = 0; allowed < 12; ++allowed)
  {
    int asked = 0;
    BitMask foreground;
    EXPECT_FALSE(CarveOrgan(
      image.View(), {}, leak.Seed, 4, Modality::CT, SerialFor,
      [&](double) { return asked++ < allowed; }, foreground));
    EXPECT_EQ(asked, allowed + 1);
  }
}

TEST(OrganCarving, ReadsItsBoxOnly)
{
  const Leak leak;
  FloatImage image = ImageOf(leak.Geometry, leak.Both, 100, 20, 0, 4);
  const std::vector<VoxelRun> inside{ { 30, 20, 25, 40 } };
  BitMask expected;
  ASSERT_TRUE(
    CarveOrgan(image.View(), inside, leak.Seed, 4, Modality::MR, SerialFor, NeverStop, expected));
  const VoxelBox box = CarvingBox(leak.Geometry, inside, leak.Seed);
  ForEachVoxel(leak.Geometry,
    [&](int i, int j, int k)
    {
      const VoxelBox voxel{ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } };
      if (!box.Holds(voxel))
      {
        image.Voxels[leak.Geometry.Offset(i, j, k)] = 1e9F;
      }
    });
  BitMask found;
  ASSERT_TRUE(
    CarveOrgan(image.View(), inside, leak.Seed, 4, Modality::MR, SerialFor, NeverStop, found));
  EXPECT_EQ(found, expected);
}

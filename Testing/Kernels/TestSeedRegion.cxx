#include "Error.h"
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/SeedRegion.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using namespace FlipFree;

namespace
{

// The frames of ExampleDirections, and grids whose axes are not at right angles: gantries tilted
// either way, and one with all angles different.
std::vector<std::pair<std::string, Eigen::Matrix3d>> FramesAndShears()
{
  auto frames = ExampleDirections();
  for (const double degrees : { 30.0, -50.0 })
  {
    const double tilt = degrees * std::atan(1.0) / 45;
    Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
    sheared.col(2) << 0, std::sin(tilt), std::cos(tilt);
    frames.emplace_back("tilted by " + std::to_string(degrees), sheared);
    frames.emplace_back("tilted and oblique", ObliqueRotation() * sheared);
  }
  Eigen::Matrix3d skew;
  skew << 1, 0.6, -0.2, 0, 0.8, 0.5, 0, 0, 0.842615;
  frames.emplace_back("skew", skew);
  return frames;
}

ImageGeometry GridAround(const Eigen::Vector3d& center, const Eigen::Matrix3d& direction)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 34, 30, 21 } };
  geometry.Spacing = { 0.7, 1, 1.9 };
  geometry.Direction = direction;
  geometry.Origin = center - geometry.ToPhysical({ 16.3, 14.1, 10.4 });
  return geometry;
}

const Eigen::Vector3d Center(-30, 20, 150);

// A bright ball of 10 mm with noise, in the middle of 40 mm.
FloatImage NoisyBall(double noise, double unit = 1, double origin = 0)
{
  FloatImage image;
  image.Geometry.Dimensions = { { 40, 40, 40 } };
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  for (std::size_t voxel = 0; voxel < image.Geometry.NumberOfVoxels(); ++voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
    const Eigen::Vector3d place(index[0], index[1], index[2]);
    const double tissue = (place - Eigen::Vector3d::Constant(20)).norm() < 10 ? 100 : 0;
    image.Voxels.push_back(static_cast<float>(origin + unit * (tissue + noise * normal(random))));
  }
  return image;
}

double RadiusUsed(const FloatImage& image, double radius)
{
  const SeedSphere seed{ Eigen::Vector3d::Constant(20), radius };
  const SeedSphere used = UniformSphere(image.View(), seed);
  EXPECT_EQ(used.Center, seed.Center);
  return used.Radius;
}

} // namespace

TEST(SeedRegion, SeedsOutsideOrBelowAVoxelAreRefused)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto isAccepted = [](const ImageGeometry& geometry, const SeedSphere& seed)
  {
    try
    {
      RequireSeed(geometry, seed, "the image");
      return true;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.GetCode(),
        seed.Center.allFinite() ? ErrorCode::OutOfRange : ErrorCode::NonFiniteValue);
      EXPECT_NE(std::string(error.what()).find(seed.Center.allFinite() ? "the image" : "finite"),
        std::string::npos);
      return false;
    }
  };
  for (const auto& [name, direction] : FramesAndShears())
  {
    const ImageGeometry geometry = GridAround(Center, direction);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const bool isHigh : { false, true })
      {
        Eigen::Vector3d index(7, 8, 9);
        const double outside = isHigh ? 1 : -1;
        index[axis] = isHigh ? geometry.Dimensions[axis] - 0.5 : -0.5;
        index[axis] -= 0.01 * outside;
        EXPECT_TRUE(isAccepted(geometry, { geometry.ToPhysical(index), 5 })) << name;
        index[axis] += 0.02 * outside;
        EXPECT_FALSE(isAccepted(geometry, { geometry.ToPhysical(index), 5 })) << name;
        index[axis] = nan;
        EXPECT_FALSE(isAccepted(geometry, { geometry.ToPhysical(index), 5 })) << name;
      }
    }
    EXPECT_TRUE(isAccepted(geometry, { Center, 0.7 })) << name;
    EXPECT_FALSE(isAccepted(geometry, { Center, 0.69 })) << name;
    EXPECT_FALSE(isAccepted(geometry, { Center, nan })) << name;
  }
}

TEST(SeedRegion, ASphereIsNoWiderThanTheLongestSide)
{
  const ImageGeometry geometry = GridAround(Center, Eigen::Matrix3d::Identity());
  const double longest = 21 * 1.9;
  EXPECT_NO_THROW(RequireSeed(geometry, { Center, 0.5 * longest }, "the image"));
  EXPECT_THROW(RequireSeed(geometry, { Center, 0.5 * longest + 1e-6 }, "the image"), Error);
}

TEST(SeedRegion, PartsAsFloatsAreInTheirPlaces)
{
  const ImageGeometry geometry = GridAround(Center, ObliqueRotation());
  std::vector<short> voxels(geometry.NumberOfVoxels());
  std::mt19937 random(9);
  std::generate(voxels.begin(), voxels.end(), [&] { return static_cast<short>(random()); });
  const ImageView<short> image{ voxels.data(), geometry };
  FloatImage region; // used again, larger and smaller
  for (const VoxelBox& box : { VoxelBox{ { { 3, 4, 0 } }, { { 10, 5, 21 } } }, WholeBox(geometry),
         VoxelBox{ { { 33, 2, 7 } }, { { 34, 30, 9 } } } })
  {
    CropToFloat(image, box, ScatteredFor, region);
    ASSERT_EQ(region.Voxels.size(), region.Geometry.NumberOfVoxels());
    ForEachVoxel(box,
      [&](int i, int j, int k)
      {
        const auto [a, b, c] = std::array{ i - box.Begin[0], j - box.Begin[1], k - box.Begin[2] };
        ASSERT_EQ(region.View()(a, b, c), image(i, j, k));
        ASSERT_NEAR((region.Geometry.ToPhysical(Eigen::Vector3d(a, b, c)) -
                      geometry.ToPhysical(Eigen::Vector3d(i, j, k)))
                      .norm(),
          0, 1e-9);
      });
  }
}

TEST(SeedRegion, SphereHoldsTheVoxelsThatBruteForceFinds)
{
  for (const auto& [name, direction] : FramesAndShears())
  {
    const ImageGeometry geometry = GridAround(Center, direction);
    for (const double radius : { 0.3, 2.0, 5.0, 8.5, 30.0 })
    {
      std::vector<std::size_t> expected;
      ForEachVoxel(geometry,
        [&](int i, int j, int k)
        {
          if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - Center).norm() <= radius)
          {
            expected.push_back(geometry.Offset(i, j, k));
          }
        });
      EXPECT_EQ(VoxelsInSphere(geometry, { Center, radius }), expected) << name << " " << radius;
    }
  }
}

TEST(SeedRegion, ThereIsAlwaysAVoxelAround)
{
  const ImageGeometry geometry = GridAround(Center, Eigen::Matrix3d::Identity());
  EXPECT_EQ(VoxelsAround(geometry, { Center, 7 }), VoxelsInSphere(geometry, { Center, 7 }));
  const Eigen::Vector3d voxel = geometry.ToPhysical(Eigen::Vector3d(2, 3, 4));
  const Eigen::Vector3d beside = voxel + 0.3 * geometry.Spacing;
  ASSERT_TRUE(VoxelsInSphere(geometry, { beside, 1e-3 }).empty());
  EXPECT_EQ(VoxelsAround(geometry, { beside, 1e-3 }),
    (std::vector<std::size_t>{ geometry.Offset(2, 3, 4) }));
}

TEST(SeedRegion, ReachInIndicesIsThatOfTheFurthestPointsOfABall)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const auto& [name, direction] : FramesAndShears())
  {
    const ImageGeometry geometry = GridAround(Center, direction);
    const Eigen::Vector3d reach = geometry.IndexReach(7);
    Eigen::Vector3d furthest = Eigen::Vector3d::Zero();
    for (int i = 0; i < 20000; ++i)
    {
      const Eigen::Vector3d offset(normal(random), normal(random), normal(random));
      furthest = furthest.cwiseMax(
        (geometry.ToIndex(Center + 7 * offset.normalized()) - geometry.ToIndex(Center)).cwiseAbs());
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(furthest[axis], reach[axis] * (1 + 1e-9)) << name;
      EXPECT_GT(furthest[axis], 0.99 * reach[axis]) << name;
    }
    const VoxelBox box = BoxAround(geometry, Center, 7);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double middle = geometry.ToIndex(Center)[axis];
      const double last = geometry.Dimensions[axis] - 1;
      EXPECT_EQ(box.Begin[axis], std::max(0.0, std::floor(middle - reach[axis]))) << name;
      EXPECT_EQ(box.End[axis] - 1, std::min(last, std::ceil(middle + reach[axis]))) << name;
    }
  }
}

// All voxels that near, and no more than asked for, in any frame.
TEST(SeedRegion, WidenedBoxesHoldAllVoxelsNearThem)
{
  for (const auto& frame : FramesAndShears())
  {
    SCOPED_TRACE(frame.first);
    const ImageGeometry geometry = GridAround(Center, frame.second);
    const std::array<int, 3> voxel = NearestVoxel(geometry, Center);
    const VoxelBox one{ voxel, { { voxel[0] + 1, voxel[1] + 1, voxel[2] + 1 } } };
    const Eigen::Vector3d from = geometry.ToPhysical(Eigen::Vector3d(voxel[0], voxel[1], voxel[2]));
    constexpr double length = 5;
    const VoxelBox box = WidenedBy(one, length, 1, geometry);
    const VoxelBox least = WidenedBy(one, length, 0, geometry);
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - from).norm() <= length)
        {
          ASSERT_TRUE(box.Holds({ { { i, j, k } }, { { i + 1, j + 1, k + 1 } } }));
        }
      });
    EXPECT_EQ(least.Widened({ { 1, 1, 1 } }, WholeBox(geometry)), box);
    EXPECT_EQ(WidenedBy(one, 1e4, 0, geometry), WholeBox(geometry));
  }
}

TEST(SeedRegion, SphereIsContainedUpToTheOuterFacesOfTheVoxels)
{
  for (const auto& [name, direction] : FramesAndShears())
  {
    const ImageGeometry geometry = GridAround(Center, direction);
    const Eigen::Vector3d middle = geometry.ToIndex(Center);
    const Eigen::Vector3d reach = geometry.IndexReach(1);
    double greatest = 1e9;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double room =
        std::min(middle[axis] + 0.5, geometry.Dimensions[axis] - 0.5 - middle[axis]);
      greatest = std::min(greatest, room / reach[axis]);
    }
    EXPECT_TRUE(ContainsSphere(geometry, { Center, greatest * (1 - 1e-6) })) << name;
    EXPECT_FALSE(ContainsSphere(geometry, { Center, greatest * (1 + 1e-6) })) << name;
  }
}

TEST(SeedRegion, VoxelVolumeIsThatOfTheParallelepiped)
{
  for (const auto& [name, direction] : FramesAndShears())
  {
    const ImageGeometry geometry = GridAround(Center, direction);
    const Eigen::Vector3d origin = geometry.ToPhysical({ 0, 0, 0 });
    const Eigen::Vector3d x = geometry.ToPhysical({ 1, 0, 0 }) - origin;
    const Eigen::Vector3d y = geometry.ToPhysical({ 0, 1, 0 }) - origin;
    const Eigen::Vector3d z = geometry.ToPhysical({ 0, 0, 1 }) - origin;
    EXPECT_NEAR(geometry.VoxelVolume(), std::abs(x.dot(y.cross(z))), 1e-9) << name;
    EXPECT_NEAR(geometry.Milliliters(500), geometry.VoxelVolume() / 2, 1e-9) << name;
  }
}

TEST(SeedRegion, ASphereWithinOneTissueIsUniform)
{
  for (const double noise : { 0.0, 3.0, 6.0 })
  {
    const FloatImage image = NoisyBall(noise);
    for (const double radius : { 6.0, 8.0, 9.0, 10.0 })
    {
      SCOPED_TRACE(testing::Message() << noise << " " << radius);
      EXPECT_EQ(RadiusUsed(image, radius), radius);
      EXPECT_LT(ScatterOverInnerHalf(image.View(), { Eigen::Vector3d::Constant(20), radius }), 1.3);
    }
  }
}

// A tenth of the voxels may be of other tissue: those of a sphere of 10.36 mm.
TEST(SeedRegion, OfASphereThatReachesOutOfItsTissueTheInnerPartIsUniform)
{
  for (const double noise : { 0.0, 3.0, 6.0 })
  {
    const FloatImage image = NoisyBall(noise);
    for (const double radius : { 11.0, 13.0, 15.0, 17.0, 19.0 })
    {
      SCOPED_TRACE(testing::Message() << noise << " " << radius);
      const double used = RadiusUsed(image, radius);
      EXPECT_LT(used, 10.4);
      EXPECT_GT(used, 0.5 * radius);
      // Gray values of another unit and origin say the same.
      EXPECT_EQ(RadiusUsed(NoisyBall(noise, 0.125, -1024), radius), used);
    }
  }
}

TEST(SeedRegion, OfAFewVoxelsTheScatterIsChance)
{
  FloatImage image = NoisyBall(0);
  image.Geometry.Spacing = { 4, 4, 4 };
  const SeedSphere rim{ { 4 * 20, 4 * 20, 4 * 29.5 }, 11 };
  EXPECT_EQ(ScatterOverInnerHalf(image.View(), rim), 0);
  EXPECT_EQ(UniformSphere(image.View(), rim).Radius, 11);
}

// A step more or less is no other tissue.
TEST(SeedRegion, RoundedGrayValuesOfOneTissueAreUniform)
{
  for (const double noise : { 0.2, 0.4, 0.6, 1.0 })
  {
    FloatImage image = NoisyBall(noise);
    for (float& value : image.Voxels)
    {
      value = std::round(value);
    }
    SCOPED_TRACE(noise);
    EXPECT_EQ(RadiusUsed(image, 9), 9);
    EXPECT_LT(RadiusUsed(image, 15), 10.4);
  }
}

TEST(SeedRegion, OfOneGrayValueTheScatterIsThatOfTheInnerHalf)
{
  FloatImage image = NoisyBall(0);
  std::fill(image.Voxels.begin(), image.Voxels.end(), 7.0F);
  EXPECT_EQ(ScatterOverInnerHalf(image.View(), { Eigen::Vector3d::Constant(20), 15 }), 1);
}

#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/SmoothRegion.h"
#include "Intensity/ModelFit.h"
#include "Intensity/OrganFeature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace FlipFree;

namespace
{

ImageGeometry ThinGrid()
{
  return Grid({ { 150, 41, 37 } }, { 0.8, 0.9, 2.5 });
}

std::vector<float> Noise(const ImageGeometry& geometry)
{
  std::mt19937 random(1);
  std::normal_distribution<float> normal(100, 20);
  std::vector<float> voxels(geometry.NumberOfVoxels());
  std::generate(voxels.begin(), voxels.end(), [&] { return normal(random); });
  return voxels;
}

} // namespace

TEST(SmoothRegion, HasTheBitsOfTheWhole)
{
  const ImageGeometry geometry = ThinGrid();
  const std::vector<float> voxels = Noise(geometry);
  const VoxelReader read = ReaderOf(ImageView<float>{ voxels.data(), geometry });
  std::mt19937 random(2);
  for (const int iterations : { 0, 5, DiffusionIterationsAtOnce, 13 })
  {
    const AnisotropicDiffusionSettings settings{ iterations, 20 };
    std::vector<float> whole(voxels.size());
    ASSERT_TRUE(
      DiffuseAnisotropically(read, geometry, settings, SerialFor, NeverStop, whole.data()));
    for (int repetition = 0; repetition < 6; ++repetition)
    {
      SmoothRegion region(read, geometry, settings, ScatteredFor);
      EXPECT_TRUE(region.GetMade().IsEmpty());
      VoxelBox least;
      for (int growth = 0; growth < 4; ++growth)
      {
        const VoxelBox wanted = RandomBox(geometry, random);
        ASSERT_TRUE(region.Make(wanted, NeverStop));
        least = least.Joined(wanted);
        ASSERT_EQ(region.GetMade(),
          iterations > DiffusionIterationsAtOnce ? WholeBox(geometry) : least);
        ForEachVoxel(region.GetMade(),
          [&](int i, int j, int k)
          { ASSERT_EQ(region.View()(i, j, k), whole[geometry.Offset(i, j, k)]); });
      }
    }
  }
}

TEST(SmoothRegion, StopsWhenTold)
{
  const ImageGeometry geometry = ThinGrid();
  const std::vector<float> voxels = Noise(geometry);
  SmoothRegion region(ReaderOf(ImageView<float>{ voxels.data(), geometry }), geometry, { 5, 20 },
    SerialFor);
  const VoxelBox middle{ { { 64, 10, 10 } }, { { 80, 30, 20 } } };
  EXPECT_TRUE(region.Make(middle, NeverStop));
  EXPECT_TRUE(region.Make(middle, [](double) { return false; })); // nothing is missing
  EXPECT_FALSE(
    region.Make({ { { 0, 10, 10 } }, { { 80, 30, 25 } } }, [](double) { return false; }));
}

TEST(SmoothRegion, ForegroundIsNotSoughtInBoxesThatCannotHoldIt)
{
  const ImageGeometry geometry = ThinGrid();
  const std::vector<float> voxels = Noise(geometry);
  const ImageView<float> image{ voxels.data(), geometry };
  const SeedSphere seed{ geometry.ToPhysical(Eigen::Vector3d(75, 20, 18)), 5 };
  const IntensityModel model = FitToSeed(image, seed, 20, {});
  const std::string beyond = "a box in which foreground is sought must lie in the image; crop it";
  const std::string outside =
    "a box in which foreground is sought must hold the seed sphere; widen it";
  const struct
  {
    VoxelBox Box;
    std::string Error;
  } cases[] = {
    { { { { 64, 10, 10 } }, { { 100, 35, 30 } } }, "" },
    { { { { 64, 10, 10 } }, { { 100, 42, 30 } } }, beyond },
    { { { { 64, 10, -1 } }, { { 100, 35, 30 } } }, beyond },
    { { { { 128, 10, 10 } }, { { 150, 35, 30 } } }, outside },
    { { { { 64, 10, 10 } }, { { 80, 35, 30 } } }, outside },
    { { { { 64, 16, 10 } }, { { 100, 35, 30 } } }, outside },
    { { { { 64, 10, 10 } }, { { 100, 35, 19 } } }, outside },
  };
  for (const auto& example : cases)
  {
    BitMask found;
    EXPECT_EQ(ErrorOf(
                [&] {
                  FindForegroundInBox(image, example.Box, model, seed, { 1, 1 }, SerialFor,
                    NeverStop, found);
                }),
      example.Error);
  }
}

// Blobs of gray values about the seed's, with bridges between them: what a box says of the
// foreground holds as far as its margin promises.
TEST(SmoothRegion, ForegroundOfABoxIsThatOfTheWhole)
{
  const ImageGeometry geometry = ThinGrid();
  const SeedSphere seed{ geometry.ToPhysical(Eigen::Vector3d(75, 20, 18)), 5 };
  OrganFeatureSettings settings;
  settings.Leaks = { 0.9, 0.52 };
  const LeakControlRadii radii = RadiiOf(settings.Leaks, seed.Radius, geometry);
  ASSERT_NEAR(radii.Opening, 2.6, 1e-9);
  const std::array<int, 3> margin = ForegroundMargin(geometry, radii);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  int held = 0;
  int reached = 0;
  for (int repetition = 0; repetition < 40; ++repetition)
  {
    std::vector<float> voxels(geometry.NumberOfVoxels(), 0.0F);
    std::normal_distribution<float> normal(100, 3);
    for (int blob = 0; blob < 14; ++blob)
    {
      const Eigen::Vector3d center = blob == 0
        ? seed.Center
        : geometry.ToPhysical(
            Eigen::Vector3d(150 * uniform(random), 41 * uniform(random), 37 * uniform(random)));
      const double radius = blob == 0 ? 8 : 4 + 6 * uniform(random);
      ForEachVoxel(geometry,
        [&](int i, int j, int k)
        {
          if ((geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - center).norm() < radius)
          {
            voxels[geometry.Offset(i, j, k)] = normal(random);
          }
        });
    }
    const ImageView<float> image{ voxels.data(), geometry };
    const IntensityModel model = FitToSeed(image, seed, 3, settings.Intensity);
    BitMask whole;
    ASSERT_TRUE(FindForeground(image, model, seed, settings, SerialFor, NeverStop, whole));
    const VoxelBox bounds = whole.Bounds();
    for (const int begin : { 0, 37, 61, 64 })
    {
      for (const int more : { 0, 3, 20 })
      {
        VoxelBox box{ { { begin - more / 2, 20 - 7 - more, 18 - 5 - more } },
          { { std::min(150, 90 + 3 * more), 20 + 8 + more, 18 + 6 + more } } };
        bool holds = true;
        box = box.Cropped(WholeBox(geometry));
        std::vector<float> known(voxels.size(), std::nanf("")); // what is outside is not looked at
        ForEachVoxel(box,
          [&](int i, int j, int k)
          { known[geometry.Offset(i, j, k)] = voxels[geometry.Offset(i, j, k)]; });
        BitMask found;
        ASSERT_TRUE(FindForegroundInBox({ known.data(), geometry }, box, model, seed, radii,
          SerialFor, NeverStop, found));
        const VoxelBox inside = found.Bounds();
        for (int axis = 0; axis < 3; ++axis)
        {
          holds = holds &&
            (box.Begin[axis] == 0 || inside.Begin[axis] - margin[axis] >= box.Begin[axis]) &&
            (box.End[axis] == geometry.Dimensions[axis] ||
              inside.End[axis] + margin[axis] <= box.End[axis]);
        }
        if (holds)
        {
          ASSERT_EQ(found, whole);
          ++held;
        }
        reached += !box.Holds(bounds);
      }
    }
  }
  EXPECT_GT(held, 10);
  EXPECT_GT(reached, 10);
}

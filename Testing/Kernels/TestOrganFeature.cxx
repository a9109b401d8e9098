// The feature image and its parts: what they do when they are stopped.
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/BallMorphology.h"
#include "Image/DistanceTransform.h"
#include "Intensity/ModelFit.h"
#include "Intensity/OrganFeature.h"
#include "Mesh/SurfaceVoxelization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

/// Stops at its n-th question, counted from 0, but not if it is asked once more.
class Stop
{
public:
  explicit Stop(int at)
    : At(at)
  {
  }
  Monitor AsMonitor()
  {
    return [this](double fraction)
    {
      EXPECT_GE(fraction, this->Last);
      EXPECT_LE(fraction, 1);
      this->Last = fraction;
      return this->Asked++ != this->At;
    };
  }

  int Asked = 0;

private:
  int At;
  double Last = 0;
};

/// `work` is given a monitor and says whether it came to its end. It must do so if it is not
/// stopped, and not ask again once it is. Returns how often it asks.
template <typename Work>
int ExpectStopsWheneverAsked(Work&& work)
{
  Stop never(std::numeric_limits<int>::max());
  EXPECT_TRUE(work(never.AsMonitor()));
  for (int question = 0; question < never.Asked; ++question)
  {
    Stop stop(question);
    EXPECT_FALSE(work(stop.AsMonitor())) << "question " << question;
    EXPECT_EQ(stop.Asked, question + 1);
  }
  return never.Asked;
}

/// The feature of many gray values.
std::vector<float> TableOf(const IntensityModel& model)
{
  std::vector<float> table;
  for (int z = -50; z <= 200; ++z)
  {
    table.push_back(model(static_cast<float>(z)));
  }
  return table;
}

/// A bright ball of 9 mm on noise, and a seed in it.
class OrganFeatureStops : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Image.Geometry.Dimensions = { { 30, 26, 20 } };
    this->Image.Geometry.Spacing = { 1, 1.2, 1.5 };
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0, 6);
    ForEachVoxel(this->Image.Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d point = this->Image.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        const bool inside = (point - this->Seed.Center).norm() < 9;
        this->Image.Voxels.push_back((inside ? 100.0F : 0.0F) + noise(random));
        this->Mask.push_back(inside);
      });
  }

  FloatImage Image;
  std::vector<unsigned char> Mask;
  SeedSphere Seed{ { 15, 15, 14 }, 5 };
};

} // namespace

TEST_F(OrganFeatureStops, DistanceTransform)
{
  const int asked = ExpectStopsWheneverAsked([this](const Monitor& monitor)
    { return !SquaredDistance(this->Mask, this->Image.Geometry, 1, SerialFor, monitor).empty(); });
  EXPECT_EQ(asked, 2);
}

TEST_F(OrganFeatureStops, Morphology)
{
  for (const double radius : { 2.5, 400.0 }) // by rows, and by distance
  {
    const int asked = ExpectStopsWheneverAsked(
      [this, radius](const Monitor& monitor)
      {
        BitMask mask = BitsOf(this->Mask, this->Image.Geometry);
        return Dilate(mask, radius, SerialFor, monitor);
      });
    EXPECT_GE(asked, 3);
  }
}

TEST_F(OrganFeatureStops, LeakControl)
{
  const int asked = ExpectStopsWheneverAsked(
    [this](const Monitor& monitor)
    {
      BitMask mask = BitsOf(this->Mask, this->Image.Geometry);
      return ControlLeaks(mask, this->Seed, { 1.5, 4 }, SerialFor, monitor);
    });
  EXPECT_GE(asked, 4 * 3 + 2);
}

TEST_F(OrganFeatureStops, RefitAndLeavesTheModel)
{
  const Surface surface = Sphere(6, this->Seed.Center, 8);
  const IntensitySettings settings;
  const IntensityModel start = FitToSeed(this->Image.View(), this->Seed, 6, settings);
  const int asked = ExpectStopsWheneverAsked(
    [&](const Monitor& monitor)
    {
      IntensityModel model = start;
      const Refit refit = RefitToSurface(this->Image.View(), surface.Points, surface.Triangles, 6,
        settings, SerialFor, monitor, model);
      EXPECT_EQ(refit, TableOf(model) == TableOf(start) ? Refit::Stopped : Refit::Done);
      return refit == Refit::Done;
    });
  EXPECT_GE(asked, 3 * 3 + 2);
}

// Beyond the image, between four voxels, and with few voxels that are far enough from the surface:
// the model stays. The innermost voxels of a sphere lie as far inside it as its radius less
// InnerMargin.
TEST_F(OrganFeatureStops, RefitSaysWhatItDidNotDo)
{
  const IntensitySettings settings;
  const IntensityModel start = FitToSeed(this->Image.View(), this->Seed, 6, settings);
  const auto refit = [&](const Eigen::Vector3d& center, double radius, const Monitor& monitor)
  {
    const Surface surface = Sphere(6, center, radius);
    IntensityModel model = start;
    const Refit result = RefitToSurface(this->Image.View(), surface.Points, surface.Triangles, 6,
      settings, SerialFor, monitor, model);
    EXPECT_EQ(TableOf(model) == TableOf(start), result != Refit::Done);
    EXPECT_EQ(model.Threshold == start.Threshold, result != Refit::Done);
    return result;
  };
  EXPECT_EQ(refit({ 1015, 15, 14 }, 8, NeverStop), Refit::NothingInside);
  EXPECT_EQ(refit({ 15.5, 15.6, 14.25 }, 0.3, NeverStop), Refit::NothingInside);
  EXPECT_EQ(refit({ 1015, 15, 14 }, 8, [](double) { return false; }), Refit::Stopped);
  // Of 1.8 mm^3 each: some 80 voxels, and some 500.
  EXPECT_EQ(refit(this->Seed.Center, 5.3, NeverStop), Refit::TooFewInside);
  EXPECT_EQ(refit(this->Seed.Center, 1.9, NeverStop), Refit::TooFewInside); // none at all
  EXPECT_EQ(refit(this->Seed.Center, 8, NeverStop), Refit::Done);
}

// The masks of the whole image in place of those of a box around the surface.
TEST_F(OrganFeatureStops, RefitIsThatOfTheWholeImage)
{
  for (const double reach : { 0.5, 3.0, 12.0, 100.0 })
  {
    IntensitySettings settings;
    settings.ShellBegin = 0.4 * reach;
    settings.ShellEnd = reach;
    const Surface surface = Sphere(6, this->Seed.Center + Eigen::Vector3d(1, 2, -1), 7);
    const IntensityModel start = FitToSeed(this->Image.View(), this->Seed, 6, settings);
    IntensityModel model = start;
    ASSERT_EQ(RefitToSurface(this->Image.View(), surface.Points, surface.Triangles, 6, settings,
                ScatteredFor, NeverStop, model),
      Refit::Done);
    BitMask inside(this->Image.Geometry);
    inside.InsertRuns(VoxelizeSurface(surface.Points, surface.Triangles, this->Image.Geometry));
    BitMask shell;
    ASSERT_TRUE(MakeInsideAndShell(settings, SerialFor, NeverStop, inside, shell));
    IntensityModel expected = start;
    expected.Reestimate(this->Image.View(), { { 0, 0, 0 } }, inside, shell, 6, settings, SerialFor);
    EXPECT_EQ(model.Threshold, expected.Threshold);
    int differing = 0;
    for (int step = -1000; step <= 4000; ++step)
    {
      const float z = 0.05F * static_cast<float>(step);
      ASSERT_EQ(model(z), expected(z)) << z;
      differing += model(z) != start(z);
    }
    EXPECT_GT(differing, 100);
  }
}

TEST_F(OrganFeatureStops, Foreground)
{
  OrganFeatureSettings settings;
  const IntensityModel model = FitToSeed(this->Image.View(), this->Seed, 6, settings.Intensity);
  for (const bool controlLeaks : { false, true })
  {
    settings.ControlLeaks = controlLeaks;
    const int asked = ExpectStopsWheneverAsked(
      [&](const Monitor& monitor)
      {
        BitMask foreground;
        return FindForeground(this->Image.View(), model, this->Seed, settings, SerialFor, monitor,
          foreground);
      });
    EXPECT_GE(asked, controlLeaks ? 15 : 1);
  }
}

TEST_F(OrganFeatureStops, FeatureIsAboveItsThresholdInTheForegroundAlone)
{
  const IntensityModel model = FitToSeed(this->Image.View(), this->Seed, 6, {});
  std::mt19937 random(3);
  // Any foreground, to have voxels that were taken away and that were filled in.
  const BitMask foreground =
    BitsOf(RandomMask(this->Image.Geometry, 0.5, random), this->Image.Geometry);
  const std::vector<float> feature = MakeFeature(this->Image.View(), model, foreground, SerialFor);
  const std::vector<unsigned char> bytes = BytesOf(foreground);
  std::size_t changed = 0;
  for (std::size_t voxel = 0; voxel < feature.size(); ++voxel)
  {
    ASSERT_EQ(feature[voxel] >= model.Threshold, bytes[voxel] != 0);
    const float own = model(this->Image.Voxels[voxel]);
    changed += feature[voxel] != own;
    ASSERT_EQ(feature[voxel] != own, (own >= model.Threshold) != (bytes[voxel] != 0));
  }
  EXPECT_GT(changed, feature.size() / 4);
}

TEST_F(OrganFeatureStops, MedianIsThatOfTheSortedValues)
{
  std::mt19937 random(6);
  for (const double part : { 0.001, 0.01, 0.3, 1.0 })
  {
    std::vector<unsigned char> bytes = RandomMask(this->Image.Geometry, part, random);
    bytes[7] = 1;
    std::vector<float> values;
    for (std::size_t voxel = 0; voxel < bytes.size(); ++voxel)
    {
      if (bytes[voxel])
      {
        values.push_back(this->Image.Voxels[voxel]); // about zero, of both signs
      }
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(MedianOf(this->Image.View(), { { 0, 0, 0 } }, BitsOf(bytes, this->Image.Geometry)),
      values[values.size() / 2]);
  }
}

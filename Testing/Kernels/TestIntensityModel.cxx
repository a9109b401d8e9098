#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Intensity/IntensityModel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

using namespace FlipFree;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

// Special values, floats of any bits, and many in the usual range.
std::vector<float> AnyFloats(std::size_t count, std::mt19937& random)
{
  std::vector<float> values{ 0.0F, -0.0F, Infinity, -Infinity,
    std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max() };
  std::uniform_real_distribution<float> uniform(-100, 300);
  while (values.size() < count)
  {
    const auto bits = static_cast<std::uint32_t>(random());
    float value = uniform(random);
    if (values.size() % 4 == 0)
    {
      std::memcpy(&value, &bits, sizeof value);
    }
    values.push_back(value);
  }
  return values;
}

// In boxes at any place, too. `isMixed` tells whether the whole image's mask holds both values.
void ExpectForegroundIsByThreshold(const IntensityModel& model, bool isMixed, std::mt19937& random)
{
  const ImageGeometry geometry = Grid({ { 150, 31, 23 } }, { 1, 2, 3 });
  const std::vector<float> voxels = AnyFloats(geometry.NumberOfVoxels(), random);
  const ImageView<float> image{ voxels.data(), geometry };
  for (const VoxelBox& box : { WholeBox(geometry), RandomBox(geometry, random),
         VoxelBox{ { { 5, 0, 8 } }, { { 6, 1, 9 } } } })
  {
    const BitMask mask = model.Foreground(image, box, SerialFor);
    EXPECT_EQ(mask, model.Foreground(image, box, ScatteredFor));
    ASSERT_EQ(mask.GetGeometry().Dimensions,
      (std::array<int, 3>{ { box.Size(0), box.Size(1), box.Size(2) } }));
    EXPECT_EQ(mask.GetGeometry().Origin,
      geometry.ToPhysical(Eigen::Vector3d(box.Begin[0], box.Begin[1], box.Begin[2])));
    ForEachVoxel(box,
      [&](int i, int j, int k)
      {
        ASSERT_EQ(mask(i - box.Begin[0], j - box.Begin[1], k - box.Begin[2]),
          model(image(i, j, k)) >= model.Threshold)
          << image(i, j, k);
      });
  }
  const std::size_t inside = model.Foreground(image, WholeBox(geometry), SerialFor).Count();
  EXPECT_EQ(inside > 0 && inside < voxels.size(), isMixed) << model.Threshold;
}

// A mask of an image, its complement, and gray values in and out of it.
struct TwoTissues
{
  explicit TwoTissues(double outside, std::mt19937& random)
    : Inside(BitsOf(RandomMask(Geometry, 0.4, random), Geometry))
    , Outside(Inside)
  {
    this->Outside.Complement();
    std::normal_distribution<double> noise(0, 5);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const double mean = this->Inside(i, j, k) ? 100 : outside;
        this->Voxels.push_back(static_cast<float>(mean + noise(random)));
      });
  }

  IntensityModel Reestimated(double threshold) const
  {
    IntensitySettings settings;
    IntensityModel model = IntensityModel::FromSeed({ 95, 98, 100, 100, 101, 104 }, 5, settings);
    settings.Threshold = threshold;
    model.Reestimate({ this->Voxels.data(), this->Geometry }, { { 0, 0, 0 } }, this->Inside,
      this->Outside, 5, settings, ScatteredFor);
    return model;
  }

  ImageGeometry Geometry = Grid({ { 70, 20, 10 } }, { 1, 1, 1 });
  BitMask Inside;
  BitMask Outside;
  std::vector<float> Voxels;
};

} // namespace

TEST(IntensityModel, ForegroundIsWhatReachesTheThreshold)
{
  std::mt19937 random(2);
  std::normal_distribution<float> liver(100, 6);
  std::normal_distribution<float> vessel(160, 8);
  std::vector<float> values(6000);
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    values[at] = at % 3 == 0 ? vessel(random) : liver(random);
  }
  for (const double threshold : { 0.0, 1e-12, 0.02, 0.3, 0.999, 1.0, 1.5 })
  {
    IntensitySettings settings;
    settings.Threshold = threshold;
    const bool isMixed = threshold < 1;
    ExpectForegroundIsByThreshold(IntensityModel::FromSeed(values, 3, settings), isMixed, random);
  }
  for (const double threshold : { 0.0, 0.2, 0.6, 0.9 })
  {
    ExpectForegroundIsByThreshold(TwoTissues(80, random).Reestimated(threshold), true, random);
  }
}

// A value that is no more likely inside than outside is foreground all the same if it is the median
// inside, whatever float is next to the threshold.
TEST(IntensityModel, ForegroundAfterReestimationHoldsTheMedian)
{
  std::mt19937 random(6);
  const TwoTissues image(100, random);
  const float median =
    MedianOf({ image.Voxels.data(), image.Geometry }, { { 0, 0, 0 } }, image.Inside);
  for (const double threshold : { 0.7, 0.75, 0.8, 0.9, 0.95 })
  {
    const IntensityModel model = image.Reestimated(threshold);
    EXPECT_GE(model(median), model.Threshold) << threshold;
    EXPECT_LT(model(median + 10), model.Threshold) << threshold;
  }
}

TEST(IntensityModel, ThresholdRoundedUpIsTheNextFloat)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  IntensityModel model;
  for (int repetition = 0; repetition < 1000; ++repetition)
  {
    model.Threshold = uniform(random);
    ASSERT_GE(model.ThresholdRoundedUp(), model.Threshold);
    ASSERT_LT(std::nextafter(model.ThresholdRoundedUp(), -Infinity), model.Threshold);
  }
  model.Threshold = 0.5;
  EXPECT_EQ(model.ThresholdRoundedUp(), 0.5F);
}

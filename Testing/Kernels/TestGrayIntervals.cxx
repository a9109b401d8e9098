#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Image/FloatOrder.h"
#include "Image/GrayIntervals.h"
#include "Intensity/IntensityModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

// Floats of any bits: of every magnitude, infinite ones, and what is not a number.
std::vector<float> AnyFloats(std::size_t count, std::mt19937& random)
{
  std::vector<float> values{ 0.0F, -0.0F, Infinity, -Infinity,
    std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max() };
  while (values.size() < count)
  {
    const std::uint32_t bits = static_cast<std::uint32_t>(random());
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    values.push_back(value);
  }
  return values;
}

// At the borders, their neighbors, random floats about them, and any others.
void ExpectForegroundIsByThreshold(const IntensityModel& model, std::mt19937& random)
{
  const GrayIntervals foreground = model.Foreground();
  std::vector<float> values = AnyFloats(20000, random);
  for (const float border : foreground.GetBorders())
  {
    EXPECT_NE(foreground(border), foreground(std::nextafter(border, -Infinity)));
    values.insert(values.end(),
      { border, std::nextafter(border, Infinity), std::nextafter(border, -Infinity) });
  }
  std::uniform_real_distribution<float> uniform(-100, 300);
  std::generate_n(std::back_inserter(values), 100000, [&] { return uniform(random); });
  for (const float z : values)
  {
    ASSERT_EQ(foreground(z), model(z) >= model.Threshold) << z;
  }
}

GrayIntervals SomeIntervals(int borders, std::mt19937& random)
{
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> values(borders);
  std::generate(values.begin(), values.end(), [&] { return uniform(random); });
  std::sort(values.begin(), values.end());
  return { random() % 2 == 0, values };
}

} // namespace

TEST(FloatOrder, AscendsWithTheValue)
{
  std::mt19937 random(1);
  std::vector<float> values = AnyFloats(20000, random);
  values.erase(std::remove_if(values.begin(), values.end(), [](float z) { return std::isnan(z); }),
    values.end());
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    const float a = values[at];
    const float b = values[(at + 1) % values.size()];
    const float back = FloatOf(OrderOf(a));
    ASSERT_EQ(std::memcmp(&back, &a, sizeof a), 0) << a;
    ASSERT_EQ(OrderOf(a) < OrderOf(b), a < b || (a == b && std::signbit(a) && !std::signbit(b)))
      << a << ' ' << b;
  }
  EXPECT_EQ(OrderOf(1.0F) + 1, OrderOf(std::nextafter(1.0F, 2.0F)));
  EXPECT_EQ(OrderOf(-1.0F) + 1, OrderOf(std::nextafter(-1.0F, 2.0F)));
  EXPECT_EQ(OrderOf(-0.0F) + 1, OrderOf(0.0F));
}

TEST(FloatOrder, RoundsUp)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int repetition = 0; repetition < 1000; ++repetition)
  {
    const double number = uniform(random);
    const float up = MinimumFloatFrom(number);
    ASSERT_GE(up, number);
    ASSERT_LT(std::nextafter(up, -Infinity), number);
  }
  EXPECT_GE(MinimumFloatFrom(0.7), 0.7); // which the nearest is below
  EXPECT_EQ(MinimumFloatFrom(0.5), 0.5F);
}

TEST(GrayIntervals, ForegroundOfAModelIsWhatReachesItsThreshold)
{
  std::mt19937 random(2);
  std::normal_distribution<float> liver(100, 6);
  std::normal_distribution<float> vessel(160, 8);
  std::vector<float> values(6000);
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    values[at] = at % 3 == 0 ? vessel(random) : liver(random);
  }
  std::size_t most = 0;
  for (const double threshold : { 0.0, 1e-12, 0.02, 0.3, 0.999, 1.0, 1.5 })
  {
    IntensitySettings settings;
    settings.Threshold = threshold;
    const IntensityModel model = IntensityModel::FromSeed(values, 3, settings);
    ExpectForegroundIsByThreshold(model, random);
    most = std::max(most, model.Foreground().GetBorders().size());
  }
  EXPECT_GE(most, 4U); // two gray values apart
}

TEST(GrayIntervals, ForegroundOfAModelAfterReestimation)
{
  std::mt19937 random(3);
  const ImageGeometry geometry = Grid({ { 70, 20, 10 } }, { 1, 1, 1 });
  std::vector<unsigned char> inside = RandomMask(geometry, 0.4, random);
  std::vector<unsigned char> outside = inside;
  std::vector<float> voxels(inside.size());
  std::normal_distribution<float> noise(0, 5);
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    voxels[voxel] = (inside[voxel] ? 100.0F : 80.0F) + noise(random);
    outside[voxel] = 1 - inside[voxel];
  }
  for (const double threshold : { 0.0, 0.2, 0.6, 0.9 })
  {
    IntensitySettings settings;
    IntensityModel model = IntensityModel::FromSeed({ 95, 98, 100, 100, 101, 104 }, 5, settings);
    settings.Threshold = threshold;
    model.Reestimate({ voxels.data(), geometry }, { { 0, 0, 0 } }, BitsOf(inside, geometry),
      BitsOf(outside, geometry), 5, settings, SerialFor);
    ExpectForegroundIsByThreshold(model, random);
    EXPECT_GE(model.Foreground().GetBorders().size(), 2U);
  }
}

// A value that is no more likely inside than outside is foreground all the same if it is the median
// inside, whatever float is next to the threshold.
TEST(GrayIntervals, ForegroundAfterReestimationHoldsTheMedian)
{
  std::mt19937 random(6);
  const ImageGeometry geometry = Grid({ { 70, 20, 10 } }, { 1, 1, 1 });
  const std::vector<unsigned char> inside = RandomMask(geometry, 0.4, random);
  BitMask outside = BitsOf(inside, geometry);
  outside.Complement();
  std::vector<float> voxels(inside.size());
  std::normal_distribution<float> normal(100, 5);
  std::generate(voxels.begin(), voxels.end(), [&] { return normal(random); });
  const ImageView<float> image{ voxels.data(), geometry };
  const float median = MedianOf(image, { { 0, 0, 0 } }, BitsOf(inside, geometry), SerialFor);
  for (const double threshold : { 0.7, 0.75, 0.8, 0.9, 0.95 })
  {
    IntensitySettings settings;
    IntensityModel model = IntensityModel::FromSeed({ 95, 98, 100, 100, 101, 104 }, 5, settings);
    settings.Threshold = threshold;
    model.Reestimate(image, { { 0, 0, 0 } }, BitsOf(inside, geometry), outside, 5, settings,
      SerialFor);
    EXPECT_TRUE(model.Foreground()(median)) << threshold;
    EXPECT_GE(model(median), threshold);
    EXPECT_FALSE(model.Foreground()(median + 10)) << threshold;
  }
}

TEST(GrayIntervals, EqualBordersChangeNothing)
{
  for (const bool lowest : { false, true })
  {
    const GrayIntervals none(lowest, { 0.5F, 0.5F });
    const GrayIntervals one(lowest, { 0.25F, 0.5F, 0.5F });
    std::vector<float> voxels(130);
    std::vector<BitMask::Word> rows(6, 0);
    for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
    {
      voxels[voxel] = std::array<float, 5>{ { 0, 0.25F, 0.3F, 0.5F, 0.7F } }[voxel % 5];
    }
    none.MarkRow(voxels.data(), 130, rows.data());
    one.MarkRow(voxels.data(), 130, rows.data() + 3);
    for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
    {
      const auto isMarked = [&](std::size_t row)
      { return (rows[row + voxel / 64] >> (voxel % 64) & 1U) != 0; };
      ASSERT_EQ(none(voxels[voxel]), lowest);
      ASSERT_EQ(isMarked(0), lowest);
      ASSERT_EQ(one(voxels[voxel]), lowest != (voxels[voxel] >= 0.25F));
      ASSERT_EQ(isMarked(3), one(voxels[voxel]));
    }
  }
}

TEST(GrayIntervals, MarksWhatIsInThem)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int repetition = 0; repetition < 400; ++repetition)
  {
    const GrayIntervals intervals = SomeIntervals(repetition % 7, random);
    const int size = 1 + static_cast<int>(random() % 200);
    std::vector<float> voxels(size);
    std::generate(voxels.begin(), voxels.end(), [&] { return uniform(random); });
    voxels[random() % size] = std::numeric_limits<float>::quiet_NaN();
    if (!intervals.GetBorders().empty())
    {
      voxels[random() % size] = intervals.GetBorders().front();
    }
    // A word more, which must stay as it is.
    std::vector<BitMask::Word> row((size + 63) / 64 + 1, 0);
    intervals.MarkRow(voxels.data(), size, row.data());
    for (int voxel = 0; voxel < 64 * static_cast<int>(row.size()); ++voxel)
    {
      ASSERT_EQ((row[voxel / 64] >> (voxel % 64) & 1U) != 0,
        voxel < size && intervals(voxels[voxel]));
    }
  }
}

TEST(GrayIntervals, VoxelsOfABox)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  const ImageGeometry geometry = Grid({ { 150, 11, 9 } }, { 1, 2, 3 });
  std::vector<float> voxels(geometry.NumberOfVoxels());
  std::generate(voxels.begin(), voxels.end(), [&] { return uniform(random); });
  const ImageView<float> image{ voxels.data(), geometry };
  for (const VoxelBox& box : { VoxelBox{ { { 0, 0, 0 } }, geometry.Dimensions },
         VoxelBox{ { { 64, 2, 3 } }, { { 141, 10, 9 } } },
         VoxelBox{ { { 5, 0, 8 } }, { { 6, 1, 9 } } } })
  {
    const GrayIntervals intervals = SomeIntervals(3, random);
    const BitMask mask = VoxelsIn(intervals, image, box, SerialFor);
    EXPECT_EQ(mask, VoxelsIn(intervals, image, box, ScatteredFor));
    ASSERT_EQ(mask.GetGeometry().Dimensions,
      (std::array<int, 3>{ { box.Size(0), box.Size(1), box.Size(2) } }));
    EXPECT_EQ(mask.GetGeometry().Origin,
      geometry.ToPhysical(Eigen::Vector3d(box.Begin[0], box.Begin[1], box.Begin[2])));
    for (int k = 0; k < box.Size(2); ++k)
    {
      for (int j = 0; j < box.Size(1); ++j)
      {
        for (int i = 0; i < box.Size(0); ++i)
        {
          ASSERT_EQ(mask(i, j, k),
            intervals(image(box.Begin[0] + i, box.Begin[1] + j, box.Begin[2] + k)));
        }
      }
    }
  }
}

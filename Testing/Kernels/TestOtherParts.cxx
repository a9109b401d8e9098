// The parts about which other opinions disagree.
#include "Evidence/OtherParts.h"
#include "Image/VoxelOffsets.h"
#include "Intensity/ModelFit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace FlipFree;

namespace
{

// A bright ball of 14 mm with the seed in it, and one of 9 mm that overlaps it a little, in dark
// surroundings.
struct TwoBalls
{
  explicit TwoBalls(float ofLobe)
  {
    this->Geometry.Dimensions = { { 80, 56, 56 } };
    this->Geometry.Origin = Eigen::Vector3d(-32, -28, -28);
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), 0.0F);
    this->Lobe().ForEach([&](std::size_t voxel) { this->Voxels[voxel] = ofLobe; });
    this->Body(14).ForEach([&](std::size_t voxel) { this->Voxels[voxel] = 100; });
  }

  BitMask Ball(const Eigen::Vector3d& center, double radius) const
  {
    BitMask ball(this->Geometry);
    for (const std::size_t voxel : VoxelsInSphere(this->Geometry, { center, radius }))
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      ball.Insert(index[0], index[1], index[2]);
    }
    return ball;
  }
  BitMask Body(double radius) const { return this->Ball({ -10, 0, 0 }, radius); }
  BitMask Lobe() const { return this->Ball({ 11, 0, 0 }, 9); }
  BitMask Both() const
  {
    BitMask both = this->Body(14);
    both.Unite(this->Lobe());
    return both;
  }

  bool Find(const BitMask& foreground, const std::vector<BitMask>& opinions, const Monitor& monitor,
    std::vector<OtherPart>& parts) const
  {
    OrganFeatureSettings settings;
    settings.Modality = Modality::MR;
    const ImageView<float> view{ this->Voxels.data(), this->Geometry };
    const SeedSphere seed{ { -10, 0, 0 }, 6 };
    return FindOtherParts(view, seed, 2, settings, FitToSeed(view, seed, 2, settings.Intensity),
      foreground, opinions, SerialFor, monitor, parts);
  }

  std::vector<OtherPart> PartsOf(const BitMask& foreground,
    const std::vector<BitMask>& opinions) const
  {
    std::vector<OtherPart> parts;
    EXPECT_TRUE(this->Find(foreground, opinions, NeverStop, parts));
    return parts;
  }

  ImageGeometry Geometry;
  std::vector<float> Voxels;
};

double OverlapOf(const BitMask& one, const BitMask& other)
{
  BitMask both = one;
  both.Intersect(other);
  return 2 * static_cast<double>(both.Count()) / static_cast<double>(one.Count() + other.Count());
}

} // namespace

TEST(OtherParts, AreWhatAnOpinionHasMore)
{
  const TwoBalls image(100);
  const std::vector<OtherPart> parts = image.PartsOf(image.Body(14), { image.Both() });
  ASSERT_EQ(parts.size(), 1U);
  const DoubtfulPart& doubt = parts.front().Doubt;
  EXPECT_FALSE(doubt.IsIncluded);
  EXPECT_LT((doubt.Place - Eigen::Vector3d(11, 0, 0)).norm(), 3);
  BitMask lobe = image.Lobe();
  lobe.Remove(image.Body(14));
  BitMask part(image.Geometry);
  part.Insert(parts.front().Voxels, parts.front().Box.Begin);
  EXPECT_GT(OverlapOf(part, lobe), 0.85);
  EXPECT_NEAR(doubt.Volume / static_cast<double>(lobe.Count()), 1, 0.2);
}

TEST(OtherParts, AreWhatAnOpinionHasLess)
{
  const TwoBalls image(50);
  const std::vector<OtherPart> parts = image.PartsOf(image.Both(), { image.Body(14) });
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(parts.front().Doubt.IsIncluded);
  EXPECT_LT((parts.front().Doubt.Place - Eigen::Vector3d(11, 0, 0)).norm(), 3);
}

// An organ that is joined, and as bright, is in all opinions.
TEST(OtherParts, AreBehindNecksOfTheForeground)
{
  const TwoBalls image(100);
  const std::vector<OtherPart> parts = image.PartsOf(image.Both(), {});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(parts.front().Doubt.IsIncluded);
  EXPECT_LT((parts.front().Doubt.Place - Eigen::Vector3d(11, 0, 0)).norm(), 3);
  EXPECT_TRUE(parts.front().Holds(NearestVoxel(image.Geometry, { 15, 0, 0 })));
  EXPECT_FALSE(parts.front().Holds(NearestVoxel(image.Geometry, { -10, 0, 0 }))); // the seed
}

// The better the boundary is without the part, the less sure it is.
TEST(OtherParts, AreDoubtfulByWhatTheImageSupports)
{
  const auto marginOf = [](float ofLobe)
  {
    const TwoBalls image(ofLobe);
    const std::vector<OtherPart> parts = image.PartsOf(image.Both(), { image.Body(14) });
    return parts.empty() ? 10.0 : parts.front().Doubt.Margin;
  };
  EXPECT_LE(marginOf(10), marginOf(50));
  EXPECT_LT(marginOf(50), marginOf(90));
  EXPECT_LT(marginOf(10), 1);
}

TEST(OtherParts, AreFoundOnce)
{
  const TwoBalls image(100);
  const BitMask body = image.Body(14);
  EXPECT_EQ(image.PartsOf(body, { image.Both(), image.Both() }).size(), 1U);
}

// Neither what agrees, nor a boundary that is a little elsewhere.
TEST(OtherParts, AreDeep)
{
  const TwoBalls image(0);
  const BitMask body = image.Body(14);
  EXPECT_TRUE(image.PartsOf(body, {}).empty());
  EXPECT_TRUE(image.PartsOf(body, { body, image.Body(15), image.Body(13) }).empty());
}

// Without noise, contrast or a foreground, there is nothing to compare with.
TEST(OtherParts, HaveFiniteMargins)
{
  TwoBalls image(100);
  const auto areFinite = [&](const BitMask& foreground)
  {
    const std::vector<OtherPart> parts = image.PartsOf(foreground, { image.Both(), image.Lobe() });
    return std::all_of(parts.begin(), parts.end(),
      [](const OtherPart& part) { return std::isfinite(part.Doubt.Margin); });
  };
  EXPECT_TRUE(areFinite(image.Body(14)));
  EXPECT_TRUE(areFinite(image.Body(1)));
  image.Voxels.assign(image.Voxels.size(), 100.0F);
  EXPECT_TRUE(areFinite(image.Body(14)));
}

// Thin contact does not connect two parts, nor does one take the other's rim.
TEST(OtherParts, AreApartWhereTheyOnlyTouch)
{
  const TwoBalls image(100);
  BitMask foreground = image.Both();
  BitMask opinion = foreground;
  opinion.Remove(image.Ball({ 11, 5, 0 }, 5));
  opinion.Remove(image.Ball({ 11, -5, 0 }, 5));
  const std::vector<OtherPart> parts = image.PartsOf(foreground, { opinion });
  for (const double y : { -5.0, 5.0 })
  {
    const auto isThere = [y](const OtherPart& part)
    {
      return (part.Doubt.Place - Eigen::Vector3d(11, y, 0)).norm() < 3 &&
        std::abs(part.Doubt.Volume / 523.6 - 1) < 0.35;
    };
    EXPECT_EQ(std::count_if(parts.begin(), parts.end(), isThere), 1) << y;
  }
}

// The same parts wherever the image begins, and however large it is.
TEST(OtherParts, LieInTheForegroundsGrid)
{
  const TwoBalls image(100);
  TwoBalls large(100);
  large.Geometry.Dimensions = { { 200, 180, 190 } };
  large.Geometry.Origin -= Eigen::Vector3d(60, 60, 60);
  large.Voxels.assign(large.Geometry.NumberOfVoxels(), 0.0F);
  large.Both().ForEach([&](std::size_t voxel) { large.Voxels[voxel] = 100; });
  const std::vector<OtherPart> parts = image.PartsOf(image.Body(14), { image.Both() });
  const std::vector<OtherPart> inLarge = large.PartsOf(large.Body(14), { large.Both() });
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(inLarge.size(), 1U);
  EXPECT_LT((parts[0].Doubt.Place - inLarge[0].Doubt.Place).norm(), 3);
  EXPECT_NEAR(inLarge[0].Doubt.Volume / parts[0].Doubt.Volume, 1, 0.1);
  BitMask lobe = large.Lobe();
  BitMask part(large.Geometry);
  part.Insert(inLarge[0].Voxels, inLarge[0].Box.Begin);
  EXPECT_GT(OverlapOf(part, lobe), 0.8);
}

TEST(OtherParts, StopAtOnce)
{
  const TwoBalls image(100);
  int allowed = 0;
  bool isDone = false;
  for (; !isDone && allowed < 1000; allowed += 1 + allowed / 8)
  {
    int asked = 0;
    std::vector<OtherPart> parts;
    isDone = image.Find(
      image.Body(14), { image.Both() }, [&](double) { return ++asked <= allowed; }, parts);
    EXPECT_TRUE(isDone || asked == allowed + 1) << asked << " of " << allowed;
    EXPECT_EQ(parts.empty(), !isDone);
  }
  EXPECT_TRUE(isDone);
  EXPECT_GT(allowed, 10);
}

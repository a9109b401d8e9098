// The parts about which other opinions disagree.
#include "Evidence/OtherParts.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <algorithm>

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
    return FindOtherParts({ this->Voxels.data(), this->Geometry }, { { -10, 0, 0 }, 6 }, 2,
      settings, foreground, opinions, SerialFor, monitor, parts);
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
  EXPECT_GT(OverlapOf(parts.front().Voxels, lobe), 0.85);
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

// The better the boundary is without the part, the less sure it is.
TEST(OtherParts, AreDoubtfulByWhatTheImageSupports)
{
  const auto marginOf = [](float ofLobe)
  {
    const TwoBalls image(ofLobe);
    const std::vector<OtherPart> parts = image.PartsOf(image.Both(), { image.Body(14) });
    return parts.empty() ? 10.0 : parts.front().Doubt.Margin;
  };
  EXPECT_LT(marginOf(10), marginOf(50));
  EXPECT_LT(marginOf(50), marginOf(90));
  EXPECT_LT(marginOf(10), 0);
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

TEST(OtherParts, LieInTheForegroundsGrid)
{
  const TwoBalls image(100);
  const VoxelBox box = OtherPartsBox(image.Body(14), { { -10, 0, 0 }, 6 });
  for (const OtherPart& part : image.PartsOf(image.Body(14), { image.Both() }))
  {
    EXPECT_EQ(part.Voxels.GetGeometry().Dimensions, image.Geometry.Dimensions);
    EXPECT_EQ(part.Voxels.Cropped(box).Count(), part.Voxels.Count());
  }
}

TEST(OtherParts, StopAtOnce)
{
  const TwoBalls image(100);
  for (int allowed = 0; allowed < 12; allowed += 3)
  {
    int asked = 0;
    std::vector<OtherPart> parts;
    EXPECT_FALSE(image.Find(
      image.Body(14), { image.Both() }, [&](double) { return ++asked <= allowed; }, parts));
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_TRUE(parts.empty());
  }
}

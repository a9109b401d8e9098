// An organ of two tissues, in one of which the seed lies: a point deep in the other one brings it.
#include "Evidence/ForegroundCorrection.h"
#include "Evidence/TissueGrowth.h"
#include "ExampleVolumes.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <limits>

using namespace FlipFree;

namespace
{

const ParallelFor Serial = SerialFor; // which growth refers to

Eigen::Vector3d PlaceIn(const ImageGeometry& geometry, std::size_t voxel)
{
  const std::array<int, 3> index = IndexOf(voxel, geometry);
  return geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
}

// A capsule along x; below x = -12 mm, its gray value is 60, above `gray`.
class TwoTissues
{
public:
  explicit TwoTissues(float gray)
  {
    this->Geometry.Dimensions = { { 96, 40, 40 } };
    this->Geometry.Spacing.setConstant(1);
    this->Geometry.Origin = { -48, -20, -20 };
    std::mt19937 random(3);
    this->Voxels.resize(this->Geometry.NumberOfVoxels());
    for (std::size_t voxel = 0; voxel < this->Voxels.size(); ++voxel)
    {
      const double noise = static_cast<double>(random() % 9) - 4.0;
      const bool isLower = this->Part(-48, -12)(PlaceIn(this->Geometry, voxel));
      const bool isUpper = this->Part(-12, 48)(PlaceIn(this->Geometry, voxel));
      this->Voxels[voxel] = static_cast<float>(noise + (isLower ? 60 : isUpper ? gray : 0));
    }
  }

  static Shape Part(double begin, double end)
  {
    return [=](const Eigen::Vector3d& point)
    {
      const Eigen::Vector3d nearest(std::max(-28.0, std::min(28.0, point[0])), 0, 0);
      return (point - nearest).norm() < 12 && begin <= point[0] && point[0] < end;
    };
  }
  BitMask Mask(double begin, double end) const { return MaskOf(this->Geometry, Part(begin, end)); }
  VoxelReader Reader() const
  {
    return ReaderOf(ImageView<float>{ this->Voxels.data(), this->Geometry });
  }
  SmoothRegion Region() const { return { this->Reader(), this->Geometry, { 5, 8 }, SerialFor }; }

  /// The part of the seed, corrected by a point in the other one.
  BitMask Corrected(bool grows, const Eigen::Vector3d& inside) const
  {
    SmoothRegion region = this->Region();
    const OrganFeatureSettings settings;
    TissueGrowth growth(region, 3, settings, Serial);
    const BitMask candidate = this->Mask(-48, -12);
    const std::vector<OtherPart> others;
    const ForegroundImage image{ region.View(), region.GetReader(),
      [&](const VoxelBox& box) { return region.Make(box, NeverStop); }, 3, Modality::CT, candidate,
      others, grows ? &growth : nullptr };
    BitMask mask = candidate;
    EXPECT_TRUE(CorrectForeground(image, { { -26, 0, 0 }, 7 },
      { { ConstraintKind::Inside, inside, 0 } }, SerialFor, NeverStop, mask));
    return mask;
  }

  ImageGeometry Geometry;
  std::vector<float> Voxels;
};

} // namespace

TEST(TissueGrowth, OnePointBringsTissueThatWasNotExpected)
{
  const TwoTissues image(130);
  const std::size_t wanted = image.Mask(-12, 48).Count();
  const auto missedBy = [&](const BitMask& corrected)
  {
    BitMask missed = image.Mask(-12, 48);
    missed.Remove(corrected);
    return missed.Count();
  };
  const BitMask corrected = image.Corrected(true, { 14, 2, 1 });
  EXPECT_LT(missedBy(corrected), wanted / 10);
  BitMask tooMuch = corrected;
  tooMuch.Remove(image.Mask(-48, 48));
  EXPECT_LT(tooMuch.Count(), wanted / 10);
  EXPECT_GT(missedBy(image.Corrected(false, { 14, 2, 1 })), wanted / 6);
  // Near the mask, a point stands for its surroundings alone.
  EXPECT_EQ(image.Corrected(true, { -6, 0, 0 }), image.Corrected(false, { -6, 0, 0 }));
}

TEST(TissueGrowth, OfTheOrgansOwnGrayValueIsNone)
{
  const TwoTissues image(60);
  EXPECT_EQ(image.Corrected(true, { 14, 2, 1 }), image.Corrected(false, { 14, 2, 1 }));
}

TEST(TissueGrowth, KeepsWhatHasGrown)
{
  const TwoTissues image(130);
  SmoothRegion region = image.Region();
  const OrganFeatureSettings settings;
  TissueGrowth growth(region, 3, settings, Serial);
  const auto tissue = growth.From({ 14, 2, 1 }, NeverStop);
  ASSERT_TRUE(tissue);
  BitMask found(image.Geometry);
  found.Insert(tissue->Voxels, tissue->Box.Begin);
  BitMask missed = image.Mask(-10, 48);
  missed.Remove(found);
  EXPECT_LT(missed.Count(), image.Mask(-10, 48).Count() / 10);
  found.Remove(image.Mask(-14, 48));
  EXPECT_EQ(found.Count(), 0U);
  EXPECT_EQ(growth.From({ 14, 2, 1 }, NeverStop), tissue);
  EXPECT_NE(growth.From({ 15, 2, 1 }, NeverStop), tissue);

  // As if it were the first one.
  SmoothRegion other = image.Region();
  TissueGrowth anew(other, 3, settings, Serial);
  const auto first = anew.From({ 15, 2, 1 }, NeverStop);
  EXPECT_EQ(first->Voxels, growth.From({ 15, 2, 1 }, NeverStop)->Voxels);

  EXPECT_FALSE(anew.From({ 16, 2, 1 }, [](double) { return false; }));
}

TEST(TissueGrowth, BeginsBetweenThickSlices)
{
  TwoTissues image(130);
  image.Geometry.Spacing[2] = 10;
  image.Geometry.Origin[2] = -200;
  SmoothRegion region = image.Region();
  const OrganFeatureSettings settings;
  TissueGrowth growth(region, 3, settings, Serial);
  EXPECT_GT(growth.From({ 14, 2, 5 }, NeverStop)->Voxels.Count(), 0U);
}

TEST(TissueGrowth, IsNoneBesideNoData)
{
  TwoTissues image(130);
  MaskOf(image.Geometry, BallShape({ 17, 2, 1 }, 2))
    .ForEach(
      [&](std::size_t voxel) { image.Voxels[voxel] = std::numeric_limits<float>::quiet_NaN(); });
  SmoothRegion region = image.Region();
  const OrganFeatureSettings settings;
  TissueGrowth growth(region, 3, settings, Serial);
  EXPECT_EQ(growth.From({ 14, 2, 1 }, NeverStop)->Voxels.Count(), 0U);
  EXPECT_GT(growth.From({ 5, 2, 1 }, NeverStop)->Voxels.Count(), 0U);
}

// What points change in a foreground.
#include "Evidence/ForegroundCorrection.h"
#include "ExampleVolumes.h"
#include "Image/NoData.h"
#include "Image/VoxelOffsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

// A bright ball of 24 mm about the middle of a dark image.
struct BallImage
{
  explicit BallImage(const Eigen::Vector3d& spacing)
  {
    this->Geometry.Spacing = spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Geometry.Dimensions[axis] = static_cast<int>(64 / spacing[axis]) + 1;
    }
    this->Geometry.Origin.setConstant(-32);
    this->Voxels.assign(this->Geometry.NumberOfVoxels(), 0.0F);
    this->Ball(24).ForEach([this](std::size_t voxel) { this->Voxels[voxel] = 100; });
  }

  BitMask Ball(double radius) const
  {
    BitMask ball(this->Geometry);
    for (const std::size_t voxel :
      VoxelsInSphere(this->Geometry, { Eigen::Vector3d::Zero(), radius }))
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      ball.Insert(index[0], index[1], index[2]);
    }
    return ball;
  }

  /// What is left of x, in mm.
  BitMask BoxBelow(double x) const
  {
    BitMask box(this->Geometry);
    const int end = NearestVoxel(this->Geometry, { x, 0, 0 })[0];
    for (int k = 0; k < this->Geometry.Dimensions[2]; ++k)
    {
      for (int j = 0; j < this->Geometry.Dimensions[1]; ++j)
      {
        box.InsertRun(0, end, j, k);
      }
    }
    return box;
  }

  BitMask Corrected(BitMask foreground, const ConstraintList& constraints) const
  {
    const SeedSphere seed{ Eigen::Vector3d::Zero(), 6 };
    const ForegroundImage image = this->Image();
    EXPECT_TRUE(CorrectForeground(image, seed, constraints, SerialFor, NeverStop, foreground));
    return foreground;
  }

  OtherPart Part(const BitMask& voxels, bool isIncluded, double margin) const
  {
    OtherPart part;
    part.Box = voxels.Bounds();
    part.Voxels = voxels.Cropped(part.Box);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    voxels.ForEach(
      [&](std::size_t voxel)
      {
        const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
        sum += this->Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
      });
    part.Doubt.Place = sum / static_cast<double>(voxels.Count());
    part.Doubt.Volume = static_cast<double>(voxels.Count());
    part.Doubt.IsIncluded = isIncluded;
    part.Doubt.Margin = margin;
    return part;
  }

  ForegroundImage Image() const
  {
    const ImageView<float> view{ this->Voxels.data(), this->Geometry };
    return { view, ReaderOf(view), [](const VoxelBox&) { return true; }, 2, Modality::CT,
      this->Candidate, this->Others, nullptr };
  }

  bool IsAt(const BitMask& mask, double x, double y, double z) const
  {
    const std::array<int, 3> voxel = NearestVoxel(this->Geometry, { x, y, z });
    return mask(voxel[0], voxel[1], voxel[2]);
  }

  ImageGeometry Geometry;
  std::vector<float> Voxels;
  BitMask Candidate;
  std::vector<OtherPart> Others;
};

} // namespace

TEST(ForegroundCorrection, MovesTheBoundaryAroundThePoint)
{
  BallImage image({ 1, 1, 1 });
  // Below, what is missed looks different.
  image.Ball(24).ForEach(
    [&](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
      const Eigen::Vector3d at =
        image.Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
      image.Voxels[voxel] = at[1] < -3 && at.norm() > 18 ? 0.0F : 100.0F;
    });
  const BitMask inside =
    image.Corrected(image.Ball(18), { { ConstraintKind::Inside, { 23, 0, 0 }, 0 } });
  EXPECT_TRUE(image.IsAt(inside, 23, 0, 0));
  EXPECT_TRUE(image.IsAt(inside, 18, 7, 0));
  EXPECT_TRUE(image.IsAt(inside, 13.4, 13.4, 0));
  EXPECT_FALSE(image.IsAt(inside, 13.4, -13.4, 0));
  EXPECT_FALSE(image.IsAt(inside, -19, 0, 0));
  EXPECT_FALSE(image.IsAt(inside, 0, 19, 0));

  const BitMask outside =
    image.Corrected(image.Ball(28), { { ConstraintKind::Outside, { 25, 0, 0 }, 0 } });
  EXPECT_FALSE(image.IsAt(outside, 25, 0, 0));
  EXPECT_FALSE(image.IsAt(outside, 25.5, 8, 0));
  EXPECT_TRUE(image.IsAt(outside, 21, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, -27, 0, 0));
}

// Where neither gray values nor necks tell a part from the rest, another opinion may.
TEST(ForegroundCorrection, TakesThePartOfAnotherOpinion)
{
  BallImage image({ 1, 1, 1 });
  const BitMask ball = image.Ball(24);
  const BitMask left = image.BoxBelow(6);
  BitMask right = ball;
  right.Remove(left);
  BitMask rest = ball;
  rest.Remove(right);
  const PointConstraint outside{ ConstraintKind::Outside, { 14, 0, 0 }, 0 };
  const PointConstraint inside{ ConstraintKind::Inside, { 14, 0, 0 }, 0 };
  const PointConstraint contrary{ ConstraintKind::Inside, { 12, 14, 0 }, 0 };

  image.Others.push_back(image.Part(right, true, 0));
  const BitMask less = image.Corrected(ball, { outside });
  EXPECT_FALSE(image.IsAt(less, 12, 16, 0));
  EXPECT_FALSE(image.IsAt(less, 12, -16, 0));
  EXPECT_FALSE(image.IsAt(less, 12, 0, -16));
  EXPECT_TRUE(image.IsAt(less, 0, 0, 0));
  EXPECT_TRUE(image.IsAt(less, -20, 0, 0));
  // A point of the other kind keeps what is near to it.
  const BitMask kept = image.Corrected(ball, { outside, contrary });
  EXPECT_TRUE(image.IsAt(kept, 12, 16, 0));
  EXPECT_FALSE(image.IsAt(kept, 12, -16, 0));

  image.Others.front().Doubt.IsIncluded = false;
  const BitMask more = image.Corrected(rest, { inside });
  EXPECT_TRUE(image.IsAt(more, 12, 16, 0));
  EXPECT_TRUE(image.IsAt(more, 12, 0, -16));
}

// Where the contrary is likelier, without any point.
TEST(ForegroundCorrection, DecidesAboutPartsOfOtherOpinions)
{
  BallImage image({ 1, 1, 1 });
  const BitMask ball = image.Ball(24);
  BitMask right = ball;
  right.Remove(image.BoxBelow(6));
  BitMask rest = ball;
  rest.Remove(right);
  const SeedSphere seed{ Eigen::Vector3d::Zero(), 6 };
  for (const bool isIncluded : { true, false })
  {
    const BitMask& before = isIncluded ? ball : rest;
    const PointConstraint answer{ isIncluded ? ConstraintKind::Outside : ConstraintKind::Inside,
      image.Part(right, isIncluded, 0).Doubt.Place, 0 };
    image.Others = { image.Part(right, isIncluded, 0.5) };
    BitMask mask = before;
    ASSERT_TRUE(
      DecideOtherParts(image.Image(), seed, {}, SerialFor, NeverStop, image.Others, mask));
    EXPECT_EQ(mask, before);
    EXPECT_EQ(image.Others.front().Doubt.IsIncluded, isIncluded);

    image.Others.front().Doubt.Margin = -0.5;
    ASSERT_TRUE(DecideOtherParts(image.Image(), seed, { image.Others.front().Doubt }, SerialFor,
      NeverStop, image.Others, mask));
    EXPECT_EQ(mask, before); // the cut has decided about it

    const BitMask answered = image.Corrected(before, { answer });
    ASSERT_TRUE(
      DecideOtherParts(image.Image(), seed, {}, SerialFor, NeverStop, image.Others, mask));
    EXPECT_EQ(mask, answered);
    EXPECT_EQ(image.IsAt(mask, 12, 16, 0), !isIncluded); // all of the part
    EXPECT_TRUE(image.IsAt(mask, 0, 0, 0));
    EXPECT_EQ(image.Others.front().Doubt.IsIncluded, !isIncluded);
    EXPECT_EQ(image.Others.front().Doubt.Margin, 0.5);
  }
}

// In a leak as deep as the organ, which no neck parts from it, a point anywhere means the part.
TEST(ForegroundCorrection, TakesTheLeakThatAnotherOpinionHasNot)
{
  BallImage image({ 1, 1, 1 });
  // The leak is of many gray values.
  for (std::size_t voxel = 0; voxel < image.Voxels.size(); ++voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
    const bool isLeak = index[0] > 37;
    const int odd = (index[0] / 8 + index[1] / 8 + index[2] / 8) % 2;
    image.Voxels[voxel] = isLeak ? 70.0F + 90.0F * odd : 100.0F;
  }
  const BitMask leaked = MaskOf(image.Geometry,
    [](const Eigen::Vector3d& point) { return point[0] > -8 && point.cwiseAbs().maxCoeff() < 31; });
  const auto beyond = [&](double x)
  {
    BitMask part = leaked;
    part.Remove(image.BoxBelow(x));
    return part;
  };
  const auto corrected = [&](const Eigen::Vector3d& outside) {
    return image.Corrected(leaked, { { ConstraintKind::Outside, outside, 0 } });
  };
  const BitMask alone = corrected({ 14, 0, 0 });
  EXPECT_GT(alone.Count(), 0.8 * leaked.Count());

  image.Others = { image.Part(beyond(5), true, 0) };
  const BitMask less = corrected({ 14, 0, 0 });
  EXPECT_FALSE(image.IsAt(less, 26, 26, -26));
  EXPECT_FALSE(image.IsAt(less, 10, -26, 26));
  EXPECT_TRUE(image.IsAt(less, 0, 0, 0));
  // Not near the rim, where a point stands for its surroundings.
  EXPECT_TRUE(image.IsAt(corrected({ 14, 0, 28 }), 26, 26, -26));
  // Not in a part that holds the seed.
  image.Others = { image.Part(beyond(-4), true, 0) };
  image.Others.front().Doubt.Place = { 25, 20, 20 };
  EXPECT_EQ(corrected({ 14, 0, 0 }), alone);
}

// Which of two parts does not depend on which one holds the other.
TEST(ForegroundCorrection, TakesTheMoreDoubtfulPart)
{
  BallImage image({ 1, 1, 1 });
  const BitMask ball = image.Ball(24);
  const auto beyond = [&](double x)
  {
    BitMask part = ball;
    part.Remove(image.BoxBelow(x));
    return part;
  };
  OtherPart large = image.Part(beyond(2), true, 0);
  OtherPart small = image.Part(beyond(10), true, 0);
  large.Doubt.Place = { 15, 0, 0 };
  small.Doubt.Place = { 15, 0, 0 };
  const ConstraintList outside{ { ConstraintKind::Outside, { 15, 0, 0 }, 0 } };
  image.Others = { large, small };
  EXPECT_FALSE(image.IsAt(image.Corrected(ball, outside), 6, 20, 0));
  image.Others = { small, large };
  const BitMask less = image.Corrected(ball, outside);
  EXPECT_TRUE(image.IsAt(less, 6, 20, 0));
  EXPECT_FALSE(image.IsAt(less, 14, 16, 0));
}

// Even where its part is no thicker than what the blocks of the cut can tell.
TEST(ForegroundCorrection, TakesAPartFromItsPlace)
{
  BallImage image({ 1, 1, 1 });
  const BitMask ball = image.Ball(24);
  BitMask part = ball;
  part.Remove(image.BoxBelow(18));
  image.Others = { image.Part(part, true, 0) };
  image.Others.front().Doubt.Place = { 19, 0, 0 };
  const BitMask less = image.Corrected(ball, { { ConstraintKind::Outside, { 19, 0, 0 }, 0 } });
  EXPECT_FALSE(image.IsAt(less, 20, 10, 0));
  EXPECT_FALSE(image.IsAt(less, 20, -10, 0));
}

// What a point means must not change by how far others look: whether it lies on top of what is
// missed depends on the ball at the far end.
TEST(ForegroundCorrection, LooksAsFarWhateverThePoints)
{
  BallImage image({ 1, 1, 1 });
  BitMask found(image.Geometry);
  image.Candidate = found;
  std::mt19937 random(3);
  for (std::size_t voxel = 0; voxel < image.Voxels.size(); ++voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
    const Eigen::Vector3d at =
      image.Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
    image.Voxels[voxel] = static_cast<float>(random() % 2000); // nothing looks alike
    if ((at - Eigen::Vector3d(-22, 0, 0)).norm() <= 8)
    {
      found.Insert(index[0], index[1], index[2]);
      image.Voxels[voxel] = 100;
    }
    if (found(index[0], index[1], index[2]) || (std::hypot(at[1], at[2]) <= 6.3 && at[0] > -22) ||
      (at - Eigen::Vector3d(17, 0, 0)).norm() <= 14)
    {
      image.Candidate.Insert(index[0], index[1], index[2]);
    }
  }
  const auto corrected = [&](const ConstraintList& points)
  {
    BitMask mask = found;
    EXPECT_TRUE(
      CorrectForeground(image.Image(), { { -22, 0, 0 }, 5 }, points, SerialFor, NeverStop, mask));
    return mask;
  };
  const PointConstraint near{ ConstraintKind::Inside, { -9, 0, 0 }, 0 };
  const PointConstraint far{ ConstraintKind::Inside, { 17, -26, 0 }, 0 };
  BitMask lost = corrected({ near });
  EXPECT_GT(lost.Count(), found.Count());
  lost.Remove(corrected({ near, far }));
  EXPECT_EQ(lost.Count(), 0U);
}

// A hole elsewhere is none of the point's business.
TEST(ForegroundCorrection, ChangesNothingFarAway)
{
  const BallImage image({ 1, 1, 1 });
  BitMask found = image.Ball(18);
  const std::array<int, 3> hole = NearestVoxel(image.Geometry, { -12, 0, 0 });
  found.RemoveRun(hole[0], hole[0] + 2, hole[1], hole[2]);
  const BitMask corrected = image.Corrected(found, { { ConstraintKind::Inside, { 23, 0, 0 }, 0 } });
  EXPECT_TRUE(image.IsAt(corrected, 23, 0, 0));
  EXPECT_FALSE(image.IsAt(corrected, -12, 0, 0));
}

// The ball that is certain around a point is not as large as thick slices are thick.
TEST(ForegroundCorrection, TakesLittleWhereSlicesAreThick)
{
  const BallImage image({ 1, 1, 8 });
  const BitMask outside =
    image.Corrected(image.Ball(24), { { ConstraintKind::Outside, { 23, 0, 0 }, 0 } });
  EXPECT_FALSE(image.IsAt(outside, 23, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, 20, 4, 0));
  EXPECT_TRUE(image.IsAt(outside, 17, 0, 0));
  EXPECT_TRUE(image.IsAt(outside, 20, -4, 0));
}

namespace
{

// A bright bar in the same grid, along the first axis from -30 to 30 mm, 14 mm thick.
struct BarImage : BallImage
{
  BarImage()
    : BallImage({ 1, 1, 1 })
  {
    std::fill(this->Voxels.begin(), this->Voxels.end(), 0.0F);
    this->Bar(-30, 30).ForEach([this](std::size_t voxel) { this->Voxels[voxel] = 100; });
  }

  BitMask Bar(double begin, double end) const
  {
    BitMask bar(this->Geometry);
    for (std::size_t voxel = 0; voxel < this->Voxels.size(); ++voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
      const Eigen::Vector3d at =
        this->Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
      if (at[0] >= begin && at[0] <= end && std::hypot(at[1], at[2]) <= 7)
      {
        bar.Insert(index[0], index[1], index[2]);
      }
    }
    return bar;
  }

  BitMask With(double found, double point) const
  {
    BitMask foreground = this->Bar(-30, found);
    EXPECT_TRUE(CorrectForeground(this->Image(), { { -23, 0, 0 }, 6 },
      { { ConstraintKind::Inside, { point, 0, 0 }, 0 } }, SerialFor, NeverStop, foreground));
    return foreground;
  }
};

} // namespace

TEST(ForegroundCorrection, SpreadsFartherFromAPointDeepOnTheWrongSide)
{
  const BarImage bar;
  const BitMask deep = bar.With(-16, 4);
  EXPECT_TRUE(bar.IsAt(deep, 4, 0, 0));
  EXPECT_TRUE(bar.IsAt(deep, 26, 0, 0));
  EXPECT_TRUE(bar.IsAt(deep, -12, 5, 0));
  EXPECT_FALSE(bar.IsAt(deep, 4, 9, 0));

  const BitMask near = bar.With(1, 4);
  EXPECT_TRUE(bar.IsAt(near, 4, 0, 0));
  EXPECT_FALSE(bar.IsAt(near, 12, 0, 0));
}

// A small ball around a point does not show how much the organ's gray values vary.
TEST(ForegroundCorrection, AllowsForTheSeedsVariety)
{
  BarImage bar;
  const BitMask varied = bar.Bar(-30, -16);
  const BitMask brighter = bar.Bar(14, 30);
  int count = 0;
  varied.ForEach(
    [&](std::size_t voxel) { bar.Voxels[voxel] += 15.0F * static_cast<float>(++count % 3 - 1); });
  brighter.ForEach([&](std::size_t voxel) { bar.Voxels[voxel] = 115; });
  const BitMask found = bar.With(-16, 4);
  EXPECT_TRUE(bar.IsAt(found, 10, 0, 0));
  EXPECT_TRUE(bar.IsAt(found, 20, 0, 0));
}

// As in a kidney whose seed lies in the medulla, and of which fat and vessels are not a part: they
// are so varied that the organ looks like them.
TEST(ForegroundCorrection, KeepsAnOrganOfTwoGrayValuesAroundVariedSurroundings)
{
  BallImage image({ 1, 1, 1 });
  const Eigen::Vector3d point(18, 0, 0);
  int count = 0;
  const auto next = [&count] { return static_cast<float>(++count % 7 - 3); };
  image.Ball(24).ForEach([&](std::size_t voxel) { image.Voxels[voxel] = 75 + next(); });
  image.Ball(8).ForEach([&](std::size_t voxel) { image.Voxels[voxel] = 100 + next(); });
  for (const std::size_t voxel : VoxelsInSphere(image.Geometry, { point, 6 }))
  {
    image.Voxels[voxel] = 75 + 25 * next();
  }
  const BitMask corrected =
    image.Corrected(image.Ball(24), { { ConstraintKind::Outside, point, 0 } });
  EXPECT_FALSE(image.IsAt(corrected, 18, 0, 0));
  EXPECT_TRUE(image.IsAt(corrected, 18, 9, 0));
  EXPECT_TRUE(image.IsAt(corrected, 18, -9, 0));
  EXPECT_TRUE(image.IsAt(corrected, 10, 0, 0));
}

// As in a kidney of which a cyst has hidden the other half: the point's surroundings show one of
// the organ's gray values only.
TEST(ForegroundCorrection, FillsAnOrganOfSeveralGrayValuesAroundAPointInItsDepth)
{
  BallImage image({ 1, 1, 1 });
  image.Ball(24).ForEach(
    [&](std::size_t voxel)
    {
      const int j = IndexOf(voxel, image.Geometry)[1];
      image.Voxels[voxel] = 75.0F + 25.0F * static_cast<float>(j / 7 % 3);
    });
  image.Ball(7).ForEach([&](std::size_t voxel) { image.Voxels[voxel] = 100; });
  BitMask found = image.Ball(24);
  found.Intersect(image.BoxBelow(2));
  const BitMask corrected = image.Corrected(found, { { ConstraintKind::Inside, { 14, 0, 0 }, 0 } });
  EXPECT_TRUE(image.IsAt(corrected, 14, 12, 0));
  EXPECT_TRUE(image.IsAt(corrected, 14, -12, 0));
  EXPECT_FALSE(image.IsAt(corrected, 27, 0, 0));
}

// Most of what is around a point in a thin part is background, and its gray values are so varied
// that anything looks like it.
TEST(ForegroundCorrection, AddsNoBackgroundAroundAPointInAThinPart)
{
  BallImage image({ 1, 1, 1 });
  const BitMask found = image.Ball(12);
  image.Ball(24).ForEach(
    [&](std::size_t voxel)
    {
      const std::array<int, 3> index = IndexOf(voxel, image.Geometry);
      const int away = std::abs(index[2] - 32);
      image.Voxels[voxel] = found(index[0], index[1], index[2])
        ? 100.0F
        : std::max(0.0F, 100.0F - 20.0F * static_cast<float>(away));
    });
  const BitMask corrected = image.Corrected(found, { { ConstraintKind::Inside, { 21, 0, 2 }, 0 } });
  EXPECT_TRUE(image.IsAt(corrected, 21, 0, 2));
  EXPECT_TRUE(image.IsAt(corrected, 18, 0, 0));
  EXPECT_FALSE(image.IsAt(corrected, 21, 0, 8));
  EXPECT_FALSE(image.IsAt(corrected, 19, 4, -7));
}

// What one point mends, a further one of its kind does not take back.
TEST(ForegroundCorrection, AddsUpWhatPointsOfAKindChange)
{
  const BallImage image({ 1, 1, 1 });
  const auto expectSum =
    [&](const BitMask& found, const PointConstraint& one, const PointConstraint& other)
  {
    BitMask both = DifferenceOf(found, image.Corrected(found, { one }));
    const BitMask ofOther = DifferenceOf(found, image.Corrected(found, { other }));
    EXPECT_GT(DifferenceOf(both, ofOther).Count(), 0U);
    both.Unite(ofOther);
    BitMask missed = both;
    missed.Remove(DifferenceOf(found, image.Corrected(found, { one, other })));
    EXPECT_EQ(missed.Count(), 0U) << NameOf(one);
  };
  expectSum(image.Ball(18), { ConstraintKind::Inside, { 23, 0, 0 }, 0 },
    { ConstraintKind::Inside, { 17, 11, 0 }, 0 });
  expectSum(image.Ball(28), { ConstraintKind::Outside, { 26, 0, 0 }, 0 },
    { ConstraintKind::Outside, { 18, 18, 0 }, 0 });
}

// An outside point that is outside to begin with keeps what an inside point adds off itself, and
// takes nothing from the rest.
TEST(ForegroundCorrection, TakesBackWhatAnotherPointAddsAndNoMore)
{
  const BarImage image;
  const BitMask found = image.Bar(-30, 12);
  const BitMask corrected = image.Corrected(found,
    { { ConstraintKind::Inside, { 26, 0, 0 }, 0 }, { ConstraintKind::Outside, { 17, 0, 0 }, 0 } });
  EXPECT_TRUE(image.IsAt(corrected, 26, 0, 0));
  EXPECT_FALSE(image.IsAt(corrected, 17, 0, 0));
  BitMask lost = found;
  lost.Remove(corrected);
  EXPECT_EQ(lost.Count(), 0U);
}

namespace
{

// Three bright balls in a row, connected by necks, the seed in the first; the organ's gray values
// vary, and beyond the third is a brighter neighbor.
struct LobesImage : BallImage
{
  explicit LobesImage(double neck = 4, double second = 100, double scale = 1)
    : BallImage({ 1, 1, 2 })
    , Neck(neck)
    , Scale(scale)
  {
    this->Geometry.Spacing *= scale;
    this->Geometry.Origin *= scale;
    std::mt19937 random(5);
    for (std::size_t voxel = 0; voxel < this->Voxels.size(); ++voxel)
    {
      const double noise = static_cast<double>(random() % 9) - 4.0;
      const double x = this->PlaceOf(voxel)[0];
      this->Voxels[voxel] = static_cast<float>(noise +
        (!this->IsOrgan(voxel) ? 0
            : x > 14           ? 130
            : x > -2           ? second
                               : 100));
    }
    this->Candidate = this->Lobes(-32, 32);
  }

  Eigen::Vector3d PlaceOf(std::size_t voxel) const
  {
    const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
    return this->Geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2])) / this->Scale;
  }

  bool IsOrgan(std::size_t voxel) const
  {
    const Eigen::Vector3d at = this->PlaceOf(voxel);
    const auto isInBall = [&](double x, double radius)
    { return (at - Eigen::Vector3d(x, 0, 0)).norm() <= radius; };
    return isInBall(-18, 11) || isInBall(4, 10) || isInBall(22, 9) ||
      (std::abs(at[0]) < 20 && std::hypot(at[1], at[2]) < this->Neck);
  }

  BitMask Lobes(double begin, double end) const
  {
    BitMask mask(this->Geometry);
    for (std::size_t voxel = 0; voxel < this->Voxels.size(); ++voxel)
    {
      const double x = this->PlaceOf(voxel)[0];
      if (this->IsOrgan(voxel) && begin <= x && x <= end)
      {
        const std::array<int, 3> index = IndexOf(voxel, this->Geometry);
        mask.Insert(index[0], index[1], index[2]);
      }
    }
    return mask;
  }

  BitMask Corrected(BitMask foreground, const ConstraintList& constraints) const
  {
    EXPECT_TRUE(CorrectForeground(this->Image(), { { -18 * this->Scale, 0, 0 }, 5 * this->Scale },
      constraints, SerialFor, NeverStop, foreground));
    return foreground;
  }

  const double Neck;  ///< its radius, of which all is by the scale
  const double Scale; ///< mm
};

} // namespace

TEST(ForegroundCorrection, OnePointInALostLobeBringsTheLobe)
{
  const LobesImage image;
  const BitMask corrected =
    image.Corrected(image.Lobes(-32, -6), { { ConstraintKind::Inside, { 5, 2, 0 }, 0 } });
  BitMask missed = image.Lobes(-32, 12);
  missed.Remove(corrected);
  EXPECT_LT(missed.Count(), image.Lobes(-32, 12).Count() / 20);
  EXPECT_FALSE(image.IsAt(corrected, 24, 0, 0));
}

TEST(ForegroundCorrection, OnePointInALeakTakesTheLeak)
{
  const LobesImage image;
  const BitMask corrected =
    image.Corrected(image.Lobes(-32, 32), { { ConstraintKind::Outside, { 5, 2, 0 }, 0 } });
  BitMask left = corrected;
  left.Remove(image.Lobes(-32, -4));
  EXPECT_LT(left.Count(), image.Lobes(-4, 32).Count() / 20);
  BitMask lost = image.Lobes(-32, -9);
  lost.Remove(corrected);
  EXPECT_EQ(lost.Count(), 0U);
}

// Behind a wide neck, only what differs from the rest: else a point in a vessel or a cyst would
// take half of an organ.
TEST(ForegroundCorrection, OnePointLeavesWhatIsTheOrgansOwnBehindAWideNeck)
{
  const ConstraintList point{ { ConstraintKind::Outside, { 10, 4, 0 }, 0 } };
  for (const bool isOwn : { true, false })
  {
    LobesImage image(8, isOwn ? 100 : 112, 2);
    for (const std::size_t voxel : VoxelsInSphere(image.Geometry, { point.front().Point, 6 }))
    {
      image.Voxels[voxel] -= 50;
    }
    const BitMask lobe = image.Lobes(-4, 14);
    BitMask left = image.Corrected(image.Lobes(-32, 14), point);
    left.Intersect(lobe);
    EXPECT_EQ(left.Count() > lobe.Count() / 2, isOwn) << left.Count() << " of " << lobe.Count();
    EXPECT_FALSE(image.IsAt(left, 10, 4, 0));
  }
}
// The organ is the end of a tube; the rest, a little brighter, is wider, so no neck parts it.
TEST(ForegroundCorrection, OnePointInALeakWithoutANeckTakesWhatIsNearer)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 101, 25, 25 } };
  geometry.Spacing.setConstant(2);
  geometry.Origin = { -100, -24, -24 };
  std::vector<float> voxels(geometry.NumberOfVoxels(), 0.0F);
  BitMask tube(geometry);
  std::mt19937 random(5);
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, geometry);
    const Eigen::Vector3d at = geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2]));
    if (std::hypot(at[1], at[2]) <= (at[0] < -8 ? 10 : 16))
    {
      voxels[voxel] = static_cast<float>((at[0] < -8 ? 100 : 112) + static_cast<int>(random() % 9));
      tube.Insert(index[0], index[1], index[2]);
    }
  }
  const BitMask candidate;
  const std::vector<OtherPart> others;
  const ImageView<float> view{ voxels.data(), geometry };
  const ForegroundImage image{ view, ReaderOf(view), [](const VoxelBox&) { return true; }, 2,
    Modality::CT, candidate, others, nullptr };
  BitMask corrected = tube;
  EXPECT_TRUE(CorrectForeground(image, { { -80, 0, 0 }, 8 },
    { { ConstraintKind::Outside, { 45, 0, 0 }, 0 } }, SerialFor, NeverStop, corrected));
  const auto isAt = [&](double x)
  {
    const std::array<int, 3> voxel = NearestVoxel(geometry, { x, 0, 0 });
    return corrected(voxel[0], voxel[1], voxel[2]);
  };
  EXPECT_TRUE(isAt(-90));
  EXPECT_TRUE(isAt(-12));
  EXPECT_FALSE(isAt(-4));
  EXPECT_FALSE(isAt(98));
}

// Whatever the points: an inside point removes nothing, an outside point adds nothing, and the
// order means nothing.
TEST(ForegroundCorrection, IsMonotoneInItsPoints)
{
  LobesImage image;
  std::mt19937 random(11);
  const auto between = [&random](double least, double most)
  { return least + (most - least) * static_cast<double>(random() % 1000) / 1000; };
  for (int sequence = 0; sequence < 60; ++sequence)
  {
    const double end = between(-10, 32);
    const BitMask found = image.Lobes(-32, end);
    image.Others.clear();
    const auto addPart = [&](double first, double last, bool isIncluded)
    {
      const BitMask part = image.Lobes(first, last);
      if (part.Count() > 0)
      {
        image.Others.push_back(image.Part(part, isIncluded, between(0, 3)));
      }
    };
    if (sequence % 2 == 1)
    {
      addPart(between(-8, end), end, true);
      addPart(end, between(end, 32), false);
      addPart(end, 32, false);
    }
    ConstraintList points;
    BitMask before = image.Corrected(found, points);
    for (int click = 0; click < 5; ++click)
    {
      const bool inside = random() % 2 == 0;
      const bool isPlace = !image.Others.empty() && random() % 3 == 0;
      const Eigen::Vector3d place = isPlace
        ? image.Others[random() % image.Others.size()].Doubt.Place
        : Eigen::Vector3d(between(-8, 31), between(-12, 12), between(-12, 12));
      points.push_back({ inside ? ConstraintKind::Inside : ConstraintKind::Outside, place, 0 });
      const BitMask after = image.Corrected(found, points);
      BitMask wrong = inside ? before : after;
      wrong.Remove(inside ? after : before);
      EXPECT_EQ(wrong.Count(), 0U) << "sequence " << sequence << ", " << NameOf(points.back());
      before = after;
    }
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_EQ(image.Corrected(found, points), before) << "sequence " << sequence;
  }
}

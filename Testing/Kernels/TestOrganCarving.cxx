// Carving on phantoms whose necks and boundaries are known.
#include "Evidence/HalfContrastRim.h"
#include "Evidence/HollowCarving.h"
#include "Evidence/OrganCarving.h"
#include "Evidence/OrganCut.h"
#include "ExampleSurfaces.h"
#include "ExampleVolumes.h"
#include "Image/BallInside.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace FlipFree;

namespace
{

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
  Shape Organ = BallShape({ 30, 30, 30 }, 20);
  Shape Both = [organ = this->Organ](const Eigen::Vector3d& point)
  {
    const bool neck =
      point.x() > 30 && point.x() < 85 && std::hypot(point.y() - 30, point.z() - 30) < 6;
    return organ(point) || neck || (point - Eigen::Vector3d(85, 30, 30)).norm() < 22;
  };
};

bool Cut(const ImagePart& part, const SeedSphere& seed, double noise, Modality modality,
  const ParallelFor& parallelFor, BitMask& mask)
{
  OrganCutState state;
  return CutOrgan(part, seed, noise, modality, {}, parallelFor, NeverStop, mask, state);
}

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
      const BitMask behind = MaskOf(leak.Geometry, BallShape({ 85, 30, 30 }, 22));
      behind.ForEach([&](std::size_t voxel) { image.Voxels[voxel] += 100 * scale; });
      const ImagePart part{ image.View() };
      BitMask mask = MaskOf(leak.Geometry, leak.Both);
      EXPECT_LT(Dice(mask, organ), 0.62);
      ASSERT_TRUE(Cut(part, leak.Seed, 4.0 * scale, modality, SerialFor, mask));
      // Some of the neck, which is like the organ, may stay.
      EXPECT_GT(Dice(mask, organ), 0.9);
      BitMask left = mask;
      left.Intersect(behind);
      EXPECT_LT(left.Count(), behind.Count() / 20);
      BitMask other = MaskOf(leak.Geometry, leak.Both);
      ASSERT_TRUE(Cut(part, leak.Seed, 4.0 * scale, modality, ScatteredFor, other));
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
    ASSERT_TRUE(Cut({ image.View() }, seed, 4, Modality::CT, SerialFor, mask));
    EXPECT_GT(Dice(mask, organ), 0.98);
    first = radius == 19 ? mask : first;
    EXPECT_EQ(mask, first);
  }
}

// A flat lobe behind a neck, as in livers. So that it is worth cutting there and not around the
// lobe's core, smoothness counts more than usual.
struct Lobed
{
  ImageGeometry Geometry = Grid({ { 124, 60, 40 } }, { 1, 1, 1.5 });
  SeedSphere Seed{ { 30, 30, 30 }, 14 };
  Shape Organ = BallShape({ 30, 30, 30 }, 20);
  Shape Lobe = [](const Eigen::Vector3d& point)
  {
    return (point - Eigen::Vector3d(86, 30, 30))
             .cwiseQuotient(Eigen::Vector3d(26, 26, 12))
             .squaredNorm() < 1;
  };
  Shape Both = [organ = this->Organ, lobe = this->Lobe](const Eigen::Vector3d& point)
  {
    const bool neck =
      point.x() > 30 && point.x() < 86 && std::hypot(point.y() - 30, point.z() - 30) < 8;
    return organ(point) || neck || lobe(point);
  };
  OrganCutSettings Settings;
  FloatImage Image;

  Lobed() { this->Settings.Smoothness = 0.6; }

  // Brighter behind the neck, or a sheet across it.
  void Draw(float brighter, float sheet)
  {
    this->Image = ImageOf(this->Geometry, this->Both, 100, 20, 0, 4);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        float& voxel = this->Image.Voxels[this->Geometry.Offset(i, j, k)];
        voxel += i > 56 ? brighter : 0;
        voxel += i == 56 || i == 57 ? sheet : 0;
      });
  }

  // How much of the lobe is kept.
  double Cut(OrganCutState& state, Modality modality = Modality::CT) const
  {
    BitMask mask = MaskOf(this->Geometry, this->Both);
    EXPECT_TRUE(CutOrgan({ this->Image.View() }, this->Seed, 4, modality, this->Settings, SerialFor,
      NeverStop, mask, state));
    const BitMask lobe = MaskOf(this->Geometry, this->Lobe);
    mask.Intersect(lobe);
    return static_cast<double>(mask.Count()) / static_cast<double>(lobe.Count());
  }
};

// What lies behind the neck has the organ's gray value, and no edge is there: it is the organ's
// own.
TEST(OrganCut, KeepsALobeWhoseGrayValuesGoOn)
{
  Lobed lobed;
  lobed.Draw(0, 0);
  OrganCutState state;
  EXPECT_GT(lobed.Cut(state), 0.98);
  ASSERT_EQ(state.Doubts.size(), 1U);
  EXPECT_TRUE(state.Doubts[0].IsIncluded);
  EXPECT_LT((state.Doubts[0].Place - Eigen::Vector3d(86, 30, 30)).norm(), 20);
  EXPECT_NEAR(state.Doubts[0].Volume, 34000, 6000);
  EXPECT_GT(state.Doubts[0].Margin, 0);
  EXPECT_GT(state.Own.Count(), MaskOf(lobed.Geometry, lobed.Lobe).Count() / 2);
}

// Where it is a little brighter, or behind a thin sheet, it is a neighbor.
TEST(OrganCut, CutsOffALobeThatDiffers)
{
  for (const bool isSheet : { false, true })
  {
    SCOPED_TRACE(isSheet);
    Lobed lobed;
    lobed.Draw(isSheet ? 0 : 8, isSheet ? -60 : 0);
    OrganCutState state;
    EXPECT_LT(lobed.Cut(state), 0.05);
    ASSERT_EQ(state.Doubts.size(), 1U);
    EXPECT_FALSE(state.Doubts[0].IsIncluded);
    EXPECT_GT(state.Doubts[0].Margin, 1.5);
    EXPECT_EQ(state.Own.Count(), 0);
  }
}

// What was found to be the organ's own is not doubted again.
TEST(OrganCut, KeepsWhatIsKnownToBeTheOrgansOwn)
{
  Lobed lobed;
  lobed.Draw(8, 0);
  OrganCutState state;
  state.Own = MaskOf(lobed.Geometry, lobed.Lobe);
  EXPECT_GT(lobed.Cut(state), 0.98);
}

// In MR, gray values do not tell.
TEST(OrganCut, CutsOffWhatGrayValuesDoNotTell)
{
  Lobed lobed;
  lobed.Draw(0, 0);
  OrganCutState state;
  EXPECT_LT(lobed.Cut(state, Modality::MR), 0.05);
}

// The lobe has the organ's gray value, but nothing else speaks for it.
TEST(OrganCut, UnsupportedBlocksAreWorthLess)
{
  Lobed lobed;
  lobed.Draw(0, 0);
  lobed.Settings.UnsupportedLoss = 3;
  OrganCutState state;
  state.Supported = MaskOf(lobed.Geometry, lobed.Organ);
  EXPECT_LT(lobed.Cut(state), 0.2);
}

TEST(OrganCarving, RadiusIsThatOfABallOrTheSeeds)
{
  const ImageGeometry geometry = Grid({ { 60, 60, 40 } }, { 1, 1, 1.5 });
  const BitMask ball = MaskOf(geometry, BallShape({ 30, 30, 30 }, 20));
  EXPECT_NEAR(RadiusOf(ball, { { 30, 30, 30 }, 5 }), 20, 0.1);
  EXPECT_EQ(RadiusOf(ball, { { 30, 30, 30 }, 25 }), 25);
  EXPECT_EQ(RadiusOf(BitMask(geometry), { { 30, 30, 30 }, 5 }), 5);
}

TEST(OrganCarving, BallInsideEndsAtTheMask)
{
  const ImageGeometry geometry = Grid({ { 60, 60, 40 } }, { 1, 1, 1.5 });
  BitMask mask = MaskOf(geometry, BallShape({ 30, 30, 30 }, 20));
  const SeedSphere seed{ { 30, 30, 30 }, 5 };
  EXPECT_NEAR(BallInside(mask, seed).Radius, 20, 0.01);
  EXPECT_NEAR(BallInside(mask, { { 36, 30, 30 }, 5 }).Radius, 14, 0.5);
  EXPECT_EQ(BallInside(mask, { { 55, 30, 30 }, 5 }).Radius, 5); // outside
  EXPECT_EQ(BallInside(BitMask(geometry), seed).Radius, 5);
  mask.Complement();
  EXPECT_EQ(BallInside(mask, seed).Radius, 5);
  mask.Unite(MaskOf(geometry, BallShape({ 30, 30, 30 }, 21)));
  EXPECT_EQ(BallInside(mask, seed).Radius, 5); // the whole grid
}

TEST(OrganCarving, LeavesAnOrganWithoutNecksAlone)
{
  const Leak leak;
  const BitMask organ = MaskOf(leak.Geometry, leak.Organ);
  const FloatImage image = ImageOf(leak.Geometry, leak.Organ, 100, 20, 0, 4);
  BitMask mask = organ;
  ASSERT_TRUE(Cut({ image.View() }, leak.Seed, 4, Modality::CT, SerialFor, mask));
  EXPECT_GT(Dice(mask, organ), 0.99);
}

TEST(OrganCarving, KeepsTheSeedWithoutAnyMask)
{
  const Leak leak;
  const FloatImage image = ImageOf(leak.Geometry, leak.Organ, 100, 20, 0, 4);
  BitMask mask(leak.Geometry);
  ASSERT_TRUE(Cut({ image.View() }, leak.Seed, 4, Modality::CT, SerialFor, mask));
  BitMask source = MaskOf(leak.Geometry, BallShape(leak.Seed.Center, 0.55 * leak.Seed.Radius));
  source.Remove(mask);
  EXPECT_EQ(source.Count(), 0);
}

// However far within the blur the mask ends.
TEST(HalfContrastRim, FindsTheBoundaryOfABlurredBall)
{
  const ImageGeometry geometry = Grid({ { 80, 80, 80 } }, { 1, 1, 1 });
  const Shape ball = BallShape({ 40, 40, 40 }, 20);
  const double expected = RadiusOf(MaskOf(geometry, ball));
  for (const Modality modality : { Modality::CT, Modality::MR })
  {
    const FloatImage image = ImageOf(geometry, ball, 120, 20, 2, 4);
    for (const double radius : { 17.5, 18.5, 19.5 })
    {
      BitMask mask = MaskOf(geometry, BallShape({ 40, 40, 40 }, radius));
      ASSERT_TRUE(GrowRim({ image.View() }, 8, modality, SerialFor, NeverStop, mask));
      EXPECT_NEAR(RadiusOf(mask), expected, 0.7) << radius;
      BitMask other = MaskOf(geometry, BallShape({ 40, 40, 40 }, radius));
      ASSERT_TRUE(GrowRim({ image.View() }, 8, modality, ScatteredFor, NeverStop, other));
      EXPECT_EQ(mask, other);
    }
  }
}

// As in a kidney soon after contrast medium was given, beside a muscle: by the gray values of
// cortex and medulla together, the muscle would be like the kidney.
TEST(HalfContrastRim, FindsTheBoundaryOfABrightCortex)
{
  const ImageGeometry geometry = Grid({ { 80, 80, 80 } }, { 1, 1, 1 });
  const Shape kidney = BallShape({ 40, 40, 40 }, 24);
  FloatImage image = ImageOf(geometry, kidney, 200, 90, 1, 10);
  const FloatImage medulla = ImageOf(geometry, BallShape({ 40, 40, 40 }, 15), 90, 0, 1, 0.1);
  std::transform(image.Voxels.begin(), image.Voxels.end(), medulla.Voxels.begin(),
    image.Voxels.begin(), std::minus<>());
  const double expected = RadiusOf(MaskOf(geometry, kidney));
  for (const double radius : { 21.5, 22.5, 23.5 })
  {
    BitMask mask = MaskOf(geometry, BallShape({ 40, 40, 40 }, radius));
    ASSERT_TRUE(GrowRim({ image.View() }, 8, Modality::CT, SerialFor, NeverStop, mask));
    EXPECT_NEAR(RadiusOf(mask), expected, 0.5) << radius;
  }
}

TEST(HalfContrastRim, LeavesAMaskWithoutACoreAlone)
{
  const ImageGeometry geometry = Grid({ { 20, 20, 20 } }, { 1, 1, 1 });
  const FloatImage image = ImageOf(geometry, BallShape({ 10, 10, 10 }, 6), 100, 0, 0, 1);
  const BitMask thin = MaskOf(geometry, BallShape({ 10, 10, 10 }, 1.5));
  BitMask mask = thin;
  ASSERT_TRUE(GrowRim({ image.View() }, 1, Modality::CT, SerialFor, NeverStop, mask));
  EXPECT_EQ(mask, thin);
}

// A kidney, as a ball, in fat. Its sinus, a tube of fat from the hilum, is narrower than the balls
// of leak control; up to the hilum, it has filled with the organ's voxels.
struct Kidney
{
  ImageGeometry Geometry = Grid({ { 80, 80, 54 } }, { 1, 1, 1.5 });
  Shape Whole = BallShape({ 40, 40, 40 }, 26);
  Shape Sinus = [](const Eigen::Vector3d& point)
  { return point.x() > 30 && std::hypot(point.y() - 40, point.z() - 40) < 6; };
  Shape Organ = [whole = this->Whole, sinus = this->Sinus](const Eigen::Vector3d& point)
  { return whole(point) && !sinus(point); };
  Shape Filled = [whole = this->Whole, sinus = this->Sinus](const Eigen::Vector3d& point)
  { return whole(point) && !(sinus(point) && point.x() > 60); };
};

BitMask Hollowed(const FloatImage& image, const BitMask& mask, Modality modality = Modality::CT)
{
  BitMask carved = mask;
  EXPECT_TRUE(CarveHollows({ image.View() }, modality, SerialFor, NeverStop, carved));
  return carved;
}

TEST(HollowCarving, CarvesTheFatOfAKidneysSinus)
{
  const Kidney kidney;
  const BitMask organ = MaskOf(kidney.Geometry, kidney.Organ);
  const BitMask filled = MaskOf(kidney.Geometry, kidney.Filled);
  for (const float gray : { 30.0F, 150.0F })
  {
    SCOPED_TRACE(gray);
    const FloatImage image = ImageOf(kidney.Geometry, kidney.Organ, gray, -100, 1.5, 6);
    const BitMask carved = Hollowed(image, filled);
    EXPECT_LT(Dice(filled, organ), 0.98);
    EXPECT_GT(Dice(carved, organ), 0.99);
    // The organ keeps its outer border, which is as dark.
    BitMask lost = organ;
    lost.Remove(carved);
    EXPECT_LT(lost.Count(), organ.Count() / 200);
    BitMask outside = carved;
    outside.Remove(filled);
    EXPECT_EQ(outside.Count(), 0);
    // The same however the work is divided; little is left to carve; and nothing in MR.
    BitMask other = filled;
    ASSERT_TRUE(CarveHollows({ image.View() }, Modality::CT, ScatteredFor, NeverStop, other));
    EXPECT_EQ(other, carved);
    EXPECT_GT(Dice(Hollowed(image, carved), carved), 0.995);
    EXPECT_EQ(Hollowed(image, filled, Modality::MR), filled);
  }
}

// A surface of one piece has no way there.
TEST(HollowCarving, LeavesFatThatIsClosedIn)
{
  const Kidney kidney;
  const BitMask filled = MaskOf(kidney.Geometry, kidney.Whole);
  const Shape closed = [&](const Eigen::Vector3d& point)
  { return kidney.Whole(point) && !(kidney.Sinus(point) && point.x() < 55); };
  EXPECT_EQ(Hollowed(ImageOf(kidney.Geometry, closed, 150, -100, 1, 6), filled), filled);
}

// Of water, within the organ and at its border, beside the fat around it.
TEST(HollowCarving, LeavesCysts)
{
  const Kidney kidney;
  const BitMask filled = MaskOf(kidney.Geometry, kidney.Whole);
  for (const double place : { 45.0, 56.0, 60.0 })
  {
    SCOPED_TRACE(place);
    FloatImage image = ImageOf(kidney.Geometry, kidney.Whole, 150, -100, 1, 6);
    const Shape cyst = [&](const Eigen::Vector3d& point)
    { return kidney.Whole(point) && (point - Eigen::Vector3d(place, 40, 40)).norm() < 8; };
    const FloatImage water = ImageOf(kidney.Geometry, cyst, 145, 0, 1, 0.1);
    std::transform(image.Voxels.begin(), image.Voxels.end(), water.Voxels.begin(),
      image.Voxels.begin(), std::minus<>());
    const BitMask carved = Hollowed(image, filled);
    EXPECT_GT(carved.Count(), 0.998 * static_cast<double>(filled.Count()));
  }
}

// A lipoma is no hollow of itself; nor is anything carved without a core.
TEST(HollowCarving, LeavesFatAndWhatIsThinAlone)
{
  const Kidney kidney;
  const BitMask filled = MaskOf(kidney.Geometry, kidney.Whole);
  const FloatImage image = ImageOf(kidney.Geometry, kidney.Whole, -90, 20, 1, 10);
  EXPECT_EQ(Hollowed(image, filled), filled);
  const BitMask thin = MaskOf(kidney.Geometry, BallShape({ 40, 40, 40 }, 1.5));
  EXPECT_EQ(Hollowed(image, thin), thin);
}

// By the steps of one round: a cut, a move of the boundary, and at the end the hollows.
BitMask CarvedInOneRound(const Leak& leak, const FloatImage& image, const BitMask& candidate)
{
  const ImagePart part{ image.View() };
  BitMask mask = candidate;
  EXPECT_TRUE(Cut(part, leak.Seed, 4, Modality::CT, SerialFor, mask));
  EXPECT_TRUE(GrowRim(part, 4, Modality::CT, SerialFor, NeverStop, mask));
  EXPECT_TRUE(CarveHollows(part, Modality::CT, SerialFor, NeverStop, mask));
  return mask;
}

BitMask CarvedFrom(const BitMask& candidate, const Leak& leak, const FloatImage& image,
  std::vector<DoubtfulPart>* doubts, const Monitor& monitor = NeverStop)
{
  BitMask foreground;
  EXPECT_TRUE(CarveOrgan(image.View(), candidate, nullptr, leak.Seed, 4, Modality::CT, SerialFor,
    monitor, foreground, doubts));
  return foreground;
}

// A second round changes nothing where the first cut took nothing, and is left out.
TEST(OrganCarving, CutsAgainOnlyWhereTheFirstCutTookSomething)
{
  const Leak leak;
  const BitMask organ = MaskOf(leak.Geometry, leak.Organ);
  const FloatImage alone = ImageOf(leak.Geometry, leak.Organ, 100, 20, 1, 4);
  EXPECT_EQ(CarvedFrom(organ, leak, alone, nullptr), CarvedInOneRound(leak, alone, organ));
  FloatImage leaking = ImageOf(leak.Geometry, leak.Both, 100, 20, 1, 4);
  MaskOf(leak.Geometry, BallShape({ 85, 30, 30 }, 22))
    .ForEach([&](std::size_t voxel) { leaking.Voxels[voxel] += 100; });
  const BitMask both = MaskOf(leak.Geometry, leak.Both);
  const BitMask carved = CarvedFrom(both, leak, leaking, nullptr);
  const BitMask once = CarvedInOneRound(leak, leaking, both);
  EXPECT_NE(carved, once);
  EXPECT_GT(Dice(carved, organ), 0.9);
}

TEST(OrganCarving, CarvesTheSameWithoutDoubts)
{
  Lobed lobed;
  lobed.Draw(8, 0);
  const BitMask both = MaskOf(lobed.Geometry, lobed.Both);
  const auto carved = [&](std::vector<DoubtfulPart>* doubts)
  {
    BitMask foreground;
    EXPECT_TRUE(CarveOrgan(lobed.Image.View(), both, nullptr, lobed.Seed, 4, Modality::CT,
      SerialFor, NeverStop, foreground, doubts));
    return foreground;
  };
  std::vector<DoubtfulPart> doubts;
  const BitMask expected = carved(&doubts);
  EXPECT_FALSE(doubts.empty());
  EXPECT_EQ(carved(nullptr), expected);
}

// Whichever question is answered by no, the last one among them.
TEST(OrganCarving, Stops)
{
  const Leak leak;
  const FloatImage image = ImageOf(leak.Geometry, leak.Both, 100, 20, 0, 4);
  const BitMask both = MaskOf(leak.Geometry, leak.Both);
  std::vector<DoubtfulPart> doubts;
  int all = 0;
  CarvedFrom(both, leak, image, &doubts,
    [&](double)
    {
      ++all;
      return true;
    });
  ASSERT_GT(all, 12);
  for (int allowed = 0; allowed < all; ++allowed)
  {
    int asked = 0;
    BitMask foreground;
    EXPECT_FALSE(CarveOrgan(
      image.View(), both, nullptr, leak.Seed, 4, Modality::CT, SerialFor,
      [&](double) { return asked++ < allowed; }, foreground, &doubts));
    EXPECT_EQ(asked, allowed + 1);
  }
}

TEST(OrganCarving, ReadsItsBoxOnly)
{
  const Leak leak;
  FloatImage image = ImageOf(leak.Geometry, leak.Both, 100, 20, 0, 4);
  BitMask inside(leak.Geometry);
  inside.InsertRun(25, 40, 30, 20);
  std::vector<DoubtfulPart> doubts;
  BitMask expected;
  ASSERT_TRUE(CarveOrgan(image.View(), inside, nullptr, leak.Seed, 4, Modality::MR, SerialFor,
    NeverStop, expected, &doubts));
  const VoxelBox box = CarvingBox(inside, leak.Seed);
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
  ASSERT_TRUE(CarveOrgan(image.View(), inside, nullptr, leak.Seed, 4, Modality::MR, SerialFor,
    NeverStop, found, &doubts));
  EXPECT_EQ(found, expected);
}

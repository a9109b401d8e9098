// Voxels without data are as the image's end, and gray values may have any scale.
#include "Deformation/VolumeSegmentation.h"
#include "ExampleMasks.h"
#include "ExampleVessels.h"
#include "Image/NoData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

using namespace FlipFree;

namespace
{

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float Infinite = std::numeric_limits<float>::infinity();

using Where = std::function<bool(const Eigen::Vector3d& place)>;

// A ball of 300 in a background of 100, as in MR.
struct BallVolume
{
  static constexpr double Radius = 16;
  const Eigen::Vector3d Center{ 40, 40, 40 };
  ImageGeometry Geometry = Grid({ { 40, 40, 40 } }, { 2, 2, 2 });
  std::vector<float> Voxels;

  explicit BallVolume(double noise = 12)
  {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 1);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const double away = (this->PlaceOf(i, j, k) - this->Center).norm();
        this->Voxels.push_back(
          static_cast<float>((away < Radius ? 300 : 100) + noise * normal(random)));
      });
  }

  Eigen::Vector3d PlaceOf(int i, int j, int k) const
  {
    return this->Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
  }

  void Clear(float value, const Where& where)
  {
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        if (where(this->PlaceOf(i, j, k)))
        {
          this->Voxels[this->Geometry.Offset(i, j, k)] = value;
        }
      });
  }

  void Scale(double factor)
  {
    for (float& value : this->Voxels)
    {
      value = static_cast<float>(factor * value);
    }
  }

  BallVolume Cropped(int columns) const
  {
    BallVolume part = *this;
    part.Geometry.Dimensions[0] = columns;
    part.Voxels.clear();
    ForEachVoxel(part.Geometry,
      [&](int i, int j, int k)
      { part.Voxels.push_back(this->Voxels[this->Geometry.Offset(i, j, k)]); });
    return part;
  }

  VolumeSegmentation Segment(const ConstraintList& constraints = {}, double seedRadius = 8) const
  {
    VolumeSegmentationSettings settings;
    settings.Method.Schedule.Resolution = 12;
    return VolumeSegmenter(GrayVolumeOf(ImageView<float>{ this->Voxels.data(), this->Geometry }),
      "it", { this->Center, seedRadius }, nullptr, settings, {})
      .Segment(constraints, NeverStop,
        [](const ContourMesh&, const PointList&, const CorrespondenceField&,
          const IterationRecord&) {});
  }

  BitMask MaskOf(const VolumeSegmentation& result) const
  {
    BitMask mask(this->Geometry);
    mask.InsertRuns(result.Voxels);
    return mask;
  }

  BitMask Truth(const Where& hasData) const
  {
    BitMask mask(this->Geometry);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d place = this->PlaceOf(i, j, k);
        if ((place - this->Center).norm() < Radius && hasData(place))
        {
          mask.Insert(i, j, k);
        }
      });
    return mask;
  }

  std::size_t WithoutDataIn(const VolumeSegmentation& result) const
  {
    std::size_t count = 0;
    this->MaskOf(result).ForEach(
      [&](std::size_t voxel) { count += HasData(this->Voxels[voxel]) ? 0 : 1; });
    return count;
  }
};

bool IsEverywhere(const Eigen::Vector3d&)
{
  return true;
}

std::string MessageOf(const std::function<void()>& run)
{
  try
  {
    run();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(NoData, NothingFlowsAcrossItsBorder)
{
  BallVolume ball;
  ball.Clear(NotANumber, [](const Eigen::Vector3d& place) { return place[0] > 41; });
  ball.Clear(-Infinite, [](const Eigen::Vector3d& place) { return place[0] > 47; });
  const auto smoothed = [](const BallVolume& volume)
  {
    std::vector<float> out(volume.Voxels.size());
    AnisotropicDiffusionSettings settings;
    settings.Contrast = 40;
    DiffuseAnisotropically(ReaderOf(ImageView<float>{ volume.Voxels.data(), volume.Geometry }),
      volume.Geometry, settings, SerialFor, NeverStop, out.data());
    return out;
  };
  const BallVolume part = ball.Cropped(21);
  const std::vector<float> whole = smoothed(ball);
  const std::vector<float> expected = smoothed(part);
  ForEachVoxel(ball.Geometry,
    [&](int i, int j, int k)
    {
      const float value = whole[ball.Geometry.Offset(i, j, k)];
      ASSERT_EQ(HasData(value), i < 21);
      ASSERT_TRUE(i >= 21 || value == expected[part.Geometry.Offset(i, j, k)]);
    });
}

TEST(NoData, IsRemovedFromMasks)
{
  BallVolume ball;
  ball.Clear(NotANumber, [](const Eigen::Vector3d& place) { return place[1] < 30; });
  const VoxelReader read = ReaderOf(ImageView<float>{ ball.Voxels.data(), ball.Geometry });
  BitMask mask = ball.Truth(IsEverywhere);
  RemoveNoData(read, SerialFor, mask);
  EXPECT_EQ(mask, ball.Truth([](const Eigen::Vector3d& place) { return place[1] >= 30; }));
  BitMask without = FindNoData(read, ball.Geometry, SerialFor);
  EXPECT_EQ(without.Count(), 40U * 40 * 15);
  without.Intersect(mask);
  EXPECT_EQ(without.Count(), 0U);
  EXPECT_TRUE(FindNoData(ReaderOf(ImageView<float>{ BallVolume().Voxels.data(), ball.Geometry }),
    ball.Geometry, SerialFor)
                .GetWords()
                .empty());
}

// As an organ that the image cuts off.
TEST(NoData, EndsAnOrganAsTheImageDoes)
{
  const auto hasData = [](const Eigen::Vector3d& place) { return place[0] < 49; };
  BallVolume ball;
  const VolumeSegmentation cropped = ball.Cropped(25).Segment();
  ball.Clear(NotANumber, [&](const Eigen::Vector3d& place) { return !hasData(place); });
  const VolumeSegmentation cut = ball.Segment();
  EXPECT_EQ(ball.WithoutDataIn(cut), 0U);
  EXPECT_GT(Dice(ball.MaskOf(cut), ball.Truth(hasData)), 0.96);
  EXPECT_GT(Dice(ball.MaskOf(cut), ball.MaskOf(cropped)), 0.97);
  // Nothing is learned from it, whatever is stored there.
  ball.Clear(Infinite, [&](const Eigen::Vector3d& place) { return !hasData(place); });
  EXPECT_EQ(ball.Segment().Organ.Points, cut.Organ.Points);
}

TEST(NoData, AroundTheFieldOfViewChangesLittle)
{
  BallVolume ball;
  ball.Clear(NotANumber,
    [&](const Eigen::Vector3d& place) { return std::hypot(place[0] - 40, place[1] - 40) > 30; });
  const VolumeSegmentation result = ball.Segment();
  EXPECT_EQ(ball.WithoutDataIn(result), 0U);
  EXPECT_GT(Dice(ball.MaskOf(result), ball.Truth(IsEverywhere)), 0.97);
  EXPECT_GT(result.Confidence.OfSurface, BallVolume().Segment().Confidence.OfSurface - 0.05);
}

TEST(NoData, InAnOrganIsEnclosedAsAHole)
{
  BallVolume ball;
  ball.Clear(NotANumber,
    [&](const Eigen::Vector3d& place) { return (place - Eigen::Vector3d(50, 40, 40)).norm() < 3; });
  const VolumeSegmentation result = ball.Segment({}, 5);
  EXPECT_GT(ball.WithoutDataIn(result), 5U);
  EXPECT_GT(Dice(ball.MaskOf(result), ball.Truth(IsEverywhere)), 0.96);
}

TEST(NoData, NeitherSeedsNorInsideNorBoundaryPointsMayTouchIt)
{
  BallVolume ball;
  ball.Clear(NotANumber, [](const Eigen::Vector3d& place) { return place[0] > 53; });
  const Eigen::Vector3d in(54.5, 40, 40);
  const auto expectRefused = [&](const ConstraintList& constraints, const std::string& start)
  {
    const std::string message = MessageOf([&] { ball.Segment(constraints); });
    EXPECT_EQ(message.substr(0, start.size()), start);
  };
  expectRefused({ { ConstraintKind::Inside, in, 0 } },
    "the inside point (54.5, 40, 40) mm touches a voxel without data (not a finite number), at "
    "(54, ");
  expectRefused({ { ConstraintKind::Boundary, in, 0 } }, "the boundary point (54.5, 40, 40) mm ");
  expectRefused({ { ConstraintKind::Seed, { 50, 40, 40 }, 5 } },
    "the sphere of the further seed at (50, 40, 40) mm touches a voxel without data");
  EXPECT_EQ(MessageOf(
              [&] {
                ball.Segment({ { ConstraintKind::Outside, { 57, 40, 40 }, 0 } });
              }),
    "");
  ball.Voxels[ball.Geometry.Offset(20, 20, 23)] = Infinite;
  expectRefused({},
    "the seed sphere touches a voxel without data (not a finite number), at (40, 40, 46) mm; "
    "move ");
}

TEST(NoData, IsWhereNoVesselRuns)
{
  const ImageGeometry grid = Grid({ { 60, 40, 50 } }, { 1, 1, 1.5 });
  const ExampleTube tube = MakeTube([](double t) { return Eigen::Vector3d(20, 20, 3 + 70 * t); },
    [](double) { return 4.0; });
  const PointList points = Points({ { 20, 20, 12 }, { 20, 20, 66 } });
  const auto trace = [&](const FloatImage& volume, double radius = 0)
  {
    VesselPathSettings settings;
    settings.Radius = radius;
    return TraceVessel(GrayVolumeOf(volume), "the volume", points, PointList(0, 3), settings,
      { SerialFor, 1 }, NeverStop);
  };
  const auto clear = [&](FloatImage& volume, const Where& where)
  {
    ForEachVoxel(grid,
      [&](int i, int j, int k)
      {
        if (where(grid.ToPhysical(Eigen::Vector3d(i, j, k))))
        {
          volume.Voxels[grid.Offset(i, j, k)] = NotANumber;
        }
      });
  };
  FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  const VesselTree before = trace(volume);
  clear(volume, [](const Eigen::Vector3d& place) { return place[0] > 35; });
  const VesselTree beside = trace(volume);
  EXPECT_NEAR(beside.Radius, before.Radius, 0.2);
  EXPECT_GT(beside.Support, before.Support - 0.02);
  FloatImage half = volume;
  clear(half, [](const Eigen::Vector3d& place) { return place[0] > 23; });
  const VesselSections sections = trace(half, 4).Branches[0].Sections;
  for (Eigen::Index section = 0; section < sections.Radii.rows(); ++section)
  {
    for (Eigen::Index ray = 0; ray < sections.Radii.cols(); ++ray)
    {
      const SectionFrame& frame = sections.Frames[section];
      const Eigen::Vector3d along = frame.Ray(2 * EIGEN_PI * ray / sections.Radii.cols());
      EXPECT_LT((frame.Origin + sections.Radii(section, ray) * along)[0], 24.1);
    }
  }
  FloatImage across = volume;
  clear(across, [](const Eigen::Vector3d& place) { return std::abs(place[2] - 40) < 3; });
  EXPECT_NE(MessageOf([&] { trace(across); }).find("no path leads to the point"),
    std::string::npos);
  clear(volume, [](const Eigen::Vector3d& place) { return place[2] > 65; });
  const std::string message = MessageOf([&] { trace(volume); });
  const std::string start = "the point (20, 20, 66) mm touches a voxel without data";
  EXPECT_EQ(message.substr(0, start.size()), start);
}

TEST(GrayValues, MayHaveAnyScale)
{
  const BallVolume ball;
  const VolumeSegmentation expected = ball.Segment();
  const double dice = Dice(ball.MaskOf(expected), ball.Truth(IsEverywhere));
  EXPECT_GT(dice, 0.97);
  for (const int power : { -30, -20, -10, 10, 30 })
  {
    BallVolume scaled = ball;
    scaled.Scale(std::ldexp(1.0, power));
    const VolumeSegmentation result = scaled.Segment();
    EXPECT_EQ(result.Organ.Points, expected.Organ.Points) << power;
    EXPECT_EQ(result.Confidence.OfSurface, expected.Confidence.OfSurface) << power;
  }
  for (const double scale : { 1e-6, 1e-3, 1e3, 1e9 })
  {
    BallVolume scaled = ball;
    scaled.Scale(scale);
    EXPECT_NEAR(Dice(scaled.MaskOf(scaled.Segment()), ball.Truth(IsEverywhere)), dice, 0.002)
      << scale;
  }
}

TEST(GrayValues, WithoutNoiseMayHaveAnyScale)
{
  const BallVolume ball(0);
  const PointList expected = ball.Segment().Organ.Points;
  for (const int power : { -30, -20, -10, 10, 30 })
  {
    BallVolume scaled = ball;
    scaled.Scale(std::ldexp(1.0, power));
    EXPECT_EQ(scaled.Segment().Organ.Points, expected) << power;
  }
}

TEST(GrayValues, OfVesselsMayHaveAnyScale)
{
  const ExampleTube tube = MakeTube([](double t) { return Eigen::Vector3d(20, 20, 3 + 70 * t); },
    [](double) { return 4.0; });
  FloatImage volume = VolumeOfTubes({ tube }, Grid({ { 40, 40, 50 } }, { 1, 1, 1.5 }), 10);
  for (float& value : volume.Voxels)
  {
    value = std::max(0.0F, value); // as in MR
  }
  const auto trace = [&](double scale)
  {
    FloatImage scaled = volume;
    for (float& value : scaled.Voxels)
    {
      value = static_cast<float>(scale * value);
    }
    return TraceVessel(GrayVolumeOf(scaled), "the volume",
      Points({ { 20, 20, 12 }, { 20, 20, 66 } }), PointList(0, 3), VesselPathSettings(),
      { SerialFor, 1 }, NeverStop);
  };
  const VesselTree expected = trace(1);
  EXPECT_EQ(trace(std::ldexp(1.0, -20)).Branches[0].Sections.Radii,
    expected.Branches[0].Sections.Radii);
  for (const double scale : { 1e-6, 1e-3, 1e3, 1e9 })
  {
    const VesselTree tree = trace(scale);
    EXPECT_NEAR(tree.Radius, expected.Radius, 0.05) << scale;
    EXPECT_NEAR(tree.Support, expected.Support, 0.01) << scale;
  }
}

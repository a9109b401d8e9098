#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "ExampleVessels.h"
#include "Vessel/Polyline.h"
#include "Vessel/VesselSegmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace FlipFree;

namespace
{

const Threading OneThread{ SerialFor, 1 };

// A quarter of a circle of radius 50 mm in the plane x = 40.
ExampleTube Bent(double radius)
{
  return MakeTube(
    [](double t)
    {
      const double angle = 0.5 * EIGEN_PI * t;
      return Eigen::Vector3d(40, 20 + 50 * std::sin(angle), 20 + 50 - 50 * std::cos(angle));
    },
    [radius](double) { return radius; });
}

ImageGeometry BentGrid()
{
  return Grid({ { 80, 96, 48 } }, { 1, 1, 2 });
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

TEST(VesselPath, RunsAlongABentTubeWithItsRadius)
{
  const ImageGeometry grid = BentGrid();
  for (const double radius : { 4.0, 11.0 }) // thin and wide
  {
    const ExampleTube tube = Bent(radius);
    const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
    const PointList points =
      Points({ tube.Line.row(5).transpose(), tube.Line.row(194).transpose() });
    const VesselTree tree = TraceVessel(GrayVolumeOf(volume), "the volume", points,
      LumenSettings().Path, OneThread, NeverStop);
    ASSERT_EQ(tree.Branches.size(), 1U);
    const PointList centers = tree.Branches[0].Sections.Centers();
    const Eigen::VectorXd radii = tree.Branches[0].Sections.MeanRadii();
    for (Eigen::Index place = 3; place + 3 < centers.rows(); ++place)
    {
      EXPECT_NEAR(std::hypot(centers(place, 1) - 20, centers(place, 2) - 70), 50, 1);
      EXPECT_NEAR(centers(place, 0), 40, 1);
      EXPECT_NEAR(radii[place], radius, 0.4);
    }
  }
}

TEST(VesselSegmentation, FindsABentTubeOfChangingRadiusBesideAnother)
{
  const ImageGeometry grid = Grid({ { 80, 60, 60 } }, { 1, 1, 1.5 });
  const ExampleTube tube =
    MakeTube([](double t) { return Eigen::Vector3d(25 + 6 * std::sin(3 * t), 30, 8 + 74 * t); },
      [](double t) { return 5 + 1.5 * std::cos(6 * t); });
  const ExampleTube other = MakeTube([](double t) { return Eigen::Vector3d(52, 30, 8 + 74 * t); },
    [](double) { return 8.0; });
  const FloatImage volume = VolumeOfTubes({ tube, other }, grid, 10);
  const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume",
    ClicksIn(tube), LumenSettings(), OneThread, NeverStop);
  EXPECT_GT(DiceOf(result, { BetweenClicks(tube) }, grid), 0.95);
  EXPECT_EQ(result.Surface.SelfIntersections, 0);
  EXPECT_EQ(result.Surface.Mesh.EulerNumber(), 2);
  EXPECT_TRUE(result.Warnings.empty()) << result.Warnings.front();
}

TEST(VesselSegmentation, ATreeIsOneSurface)
{
  const ImageGeometry grid = Grid({ { 80, 60, 60 } }, { 1, 1, 1.5 });
  const ExampleTube trunk = MakeTube([](double t) { return Eigen::Vector3d(40, 30, 8 + 74 * t); },
    [](double) { return 5.0; });
  const ExampleTube branch =
    MakeTube([](double t) { return Eigen::Vector3d(40 + 28 * t, 30, 40 + 30 * t); },
      [](double) { return 4.0; });
  const FloatImage volume = VolumeOfTubes({ trunk, branch }, grid, 10);
  const PointList points = Points({ trunk.Line.row(FirstClick).transpose(),
    trunk.Line.row(LastClick).transpose(), branch.Line.row(LastClick).transpose() });
  const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points,
    LumenSettings(), OneThread, NeverStop);
  EXPECT_EQ(result.Tree.Branches.size(), 2U);
  EXPECT_GT(DiceOf(result, { BetweenClicks(trunk), BetweenClicks(branch, 0) }, grid), 0.95);
  EXPECT_EQ(result.Surface.SelfIntersections, 0);
  EXPECT_EQ(result.Surface.Mesh.EulerNumber(), 2);

  // The same bits for any number of threads.
  const VesselSegmentation again = SegmentVessel(GrayVolumeOf(volume), "the volume", points,
    LumenSettings(), { ScatteredFor, 3 }, NeverStop);
  EXPECT_EQ(again.Surface.Points, result.Surface.Points);
}

TEST(VesselSegmentation, StopsWhenAsked)
{
  const ImageGeometry grid = BentGrid();
  const ExampleTube tube = Bent(5);
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  const PointList points = Points({ tube.Line.row(5).transpose(), tube.Line.row(194).transpose() });
  for (const int questions : { 0, 3, 8 })
  {
    int asked = 0;
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points,
      LumenSettings(), OneThread, [&](double) { return asked++ < questions; });
    EXPECT_EQ(result.Surface.Reason, StopReason::Aborted) << questions;
    EXPECT_TRUE(result.Voxels.empty());
  }
}

TEST(VesselSegmentation, BadPointsAreNamed)
{
  const ImageGeometry grid = BentGrid();
  const FloatImage volume = VolumeOfTubes({ Bent(5) }, grid, 10);
  const auto messageFor = [&](const PointList& points)
  {
    return MessageOf(
      [&]
      {
        SegmentVessel(GrayVolumeOf(volume), "the volume", points, LumenSettings(), OneThread,
          NeverStop);
      });
  };
  EXPECT_NE(messageFor(Points({ { 40, 20, 20 } })).find("two points or more, not 1"),
    std::string::npos);
  EXPECT_NE(messageFor(Points({ { 40, 20, 20 }, { 40, 20, 300 } }))
              .find("(40, 20, 300) mm lies outside the volume"),
    std::string::npos);
  EXPECT_NE(messageFor(Points({ { 40, 20, 20 }, { 40, 21, 20 } })).find("closer than 3 mm"),
    std::string::npos);
  // In two tubes that nothing joins.
  const auto upright = [](double x)
  {
    return MakeTube([x](double t) { return Eigen::Vector3d(x, 30, 30 * t); },
      [](double) { return 6.0; });
  };
  const ExampleTube left = upright(10);
  const ExampleTube right = upright(85);
  const FloatImage apart =
    VolumeOfTubes({ left, right }, Grid({ { 96, 60, 20 } }, { 1, 1, 1.5 }), 10);
  const std::string message = MessageOf(
    [&]
    {
      SegmentVessel(GrayVolumeOf(apart), "the volume", Points({ { 10, 30, 15 }, { 85, 30, 15 } }),
        LumenSettings(), OneThread, NeverStop);
    });
  EXPECT_NE(message.find("no path through gray values"), std::string::npos) << message;
  // In a vessel thinner than the image can show.
  const ExampleTube thread = MakeTube([](double t) { return Eigen::Vector3d(40, 30, 8 + 74 * t); },
    [](double) { return 1.5; });
  const FloatImage fine = VolumeOfTubes({ thread }, Grid({ { 80, 60, 60 } }, { 1, 1, 1.5 }), 10);
  const std::string noBoundary = MessageOf(
    [&]
    {
      SegmentVessel(GrayVolumeOf(fine), "the volume", ClicksIn(thread), LumenSettings(), OneThread,
        NeverStop);
    });
  EXPECT_NE(noBoundary.find("no boundary of a vessel"), std::string::npos) << noBoundary;
}

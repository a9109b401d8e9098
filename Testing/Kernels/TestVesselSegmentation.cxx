#include "Error.h"
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "ExampleVessels.h"
#include "Geometry/WindingNumber.h"
#include "MessageText.h"
#include "Vessel/Polyline.h"
#include "Vessel/VesselSegmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
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

bool HoldsText(const std::vector<std::string>& messages, const std::string& text)
{
  return std::any_of(messages.begin(), messages.end(),
    [&text](const std::string& message) { return message.find(text) != std::string::npos; });
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
    const VesselTree tree = TraceVessel(GrayVolumeOf(volume), "the volume", points, PointList(0, 3),
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
    ClicksIn(tube), {}, LumenSettings(), OneThread, NeverStop);
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
  const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points, {},
    LumenSettings(), OneThread, NeverStop);
  EXPECT_EQ(result.Tree.Branches.size(), 2U);
  EXPECT_GT(DiceOf(result, { BetweenClicks(trunk), BetweenClicks(branch, 0) }, grid), 0.95);
  EXPECT_EQ(result.Surface.SelfIntersections, 0);
  EXPECT_EQ(result.Surface.Mesh.EulerNumber(), 2);
  // Whoever cuts it with other software finds nothing that may be cut wrongly.
  const FaceList& faces = result.Surface.Mesh.Faces;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    ASSERT_LE(faces.FaceSize(face), 4);
  }
  EXPECT_TRUE(FaceHulls(result.Surface.Points, faces).FindOverlappingFaces().empty());

  // The same bits for any number of threads.
  const VesselSegmentation again = SegmentVessel(GrayVolumeOf(volume), "the volume", points, {},
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
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points, {},
      LumenSettings(), OneThread, [&](double) { return asked++ < questions; });
    EXPECT_EQ(result.Surface.Reason, StopReason::Aborted) << questions;
    EXPECT_TRUE(result.Voxels.empty());
  }
  // While the surface deforms.
  const VesselSegmentation deforming = SegmentVessel(GrayVolumeOf(volume), "the volume", points, {},
    LumenSettings(), OneThread, [](double done) { return done < 0.7; });
  EXPECT_EQ(deforming.Surface.Reason, StopReason::Aborted);
  EXPECT_FALSE(deforming.Surface.Iterations.empty());
  EXPECT_TRUE(deforming.Voxels.empty());
}

// The rule is that of organs.
TEST(VesselSegmentation, EachLevelEndsByTheScheduleOfDeformations)
{
  const ImageGeometry grid = BentGrid();
  const ExampleTube tube = Bent(5);
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  const PointList points = Points({ tube.Line.row(5).transpose(), tube.Line.row(194).transpose() });
  const auto surfaceFor = [&](int levels, int iterations)
  {
    VesselSegmentationSettings settings = LumenSettings();
    settings.Levels = levels;
    settings.MaximumIterations = iterations;
    return SegmentVessel(GrayVolumeOf(volume), "the volume", points, {}, settings, OneThread,
      NeverStop)
      .Surface;
  };
  const Eigen::Index start = surfaceFor(1, 0).Points.rows();
  for (const int levels : { 1, 2, 3 })
  {
    const OrganSurface resting = surfaceFor(levels, 0);
    EXPECT_EQ(resting.Reason, StopReason::IterationLimit);
    EXPECT_TRUE(resting.Iterations.empty());
    EXPECT_EQ(levels > 1, resting.Points.rows() > start);
    const OrganSurface surface = surfaceFor(levels, 50);
    EXPECT_TRUE(surface.Reason == StopReason::Converged ||
      surface.Reason == StopReason::DistanceBelowTolerance);
    EXPECT_EQ(surface.Iterations.back().Level, levels - 1);
    EXPECT_EQ(surface.Points.rows(), resting.Points.rows());
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
        SegmentVessel(GrayVolumeOf(volume), "the volume", points, {}, LumenSettings(), OneThread,
          NeverStop);
      });
  };
  EXPECT_NE(messageFor(Points({ { 40, 20, 20 } })).find("at least two points, not 1"),
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
        {}, LumenSettings(), OneThread, NeverStop);
    });
  EXPECT_NE(message.find("no path through gray values"), std::string::npos) << message;
  // In a vessel thinner than the image can show.
  const ExampleTube thread = MakeTube([](double t) { return Eigen::Vector3d(40, 30, 8 + 74 * t); },
    [](double) { return 1.5; });
  const FloatImage fine = VolumeOfTubes({ thread }, Grid({ { 80, 60, 60 } }, { 1, 1, 1.5 }), 10);
  const std::string noBoundary = MessageOf(
    [&]
    {
      SegmentVessel(GrayVolumeOf(fine), "the volume", ClicksIn(thread), {}, LumenSettings(),
        OneThread, NeverStop);
    });
  EXPECT_NE(noBoundary.find("no vessel boundary"), std::string::npos) << noBoundary;
}

TEST(VesselSegmentation, APathAtTheBorderLeavesTheImage)
{
  const ImageGeometry grid = Grid({ { 50, 60, 60 } }, { 1, 1, 1.5 });
  for (const double nearest : { 0.3, 8.0 }) // mm from the centers of the outermost voxels
  {
    const ExampleTube tube = MakeTube([nearest](double t)
      { return Eigen::Vector3d(nearest + 16 * std::abs(2 * t - 1), 30, 8 + 74 * t); },
      [](double) { return 5.0; });
    const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume",
      ClicksIn(tube), {}, LumenSettings(), OneThread, NeverStop);
    EXPECT_EQ(HoldsText(result.Warnings, "The path leaves the image near"), nearest < 1);
  }
}

TEST(VesselSegmentation, AClickInTouchingTissueIsNamed)
{
  const ImageGeometry grid = Grid({ { 80, 60, 60 } }, { 1, 1, 1.5 });
  const ExampleTube tube = MakeTube([](double t) { return Eigen::Vector3d(35, 30, 8 + 74 * t); },
    [](double) { return 6.0; });
  FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d place = grid.ToPhysical(Eigen::Vector3d(i, j, k));
      float& value = volume.Voxels[grid.Offset(i, j, k)];
      if (place.x() > 35 && place.z() > 60 && !IsInTube(tube, place))
      {
        value += 35; // 75, beside a vessel of 150
      }
    });
  for (const double x : { 35.0, 52.0 })
  {
    const PointList points = Points({ { 35, 30, 12 }, { x, 30, 76 } });
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points, {},
      LumenSettings(), OneThread, NeverStop);
    EXPECT_EQ(HoldsText(result.Warnings, "The point (52, 30, 76) mm does not look like the vessel"),
      x > 50);
  }
}

// An arch that is far from its ends, and wider than a thin vessel: its legs are near to each other.
// Whether or not its radius is told.
TEST(VesselPath, AWideVesselIsSoughtFarFromItsEnds)
{
  const ExampleTube arch = MakeTube(
    [](double t)
    {
      constexpr double leg = 90;
      constexpr double bend = 22;
      const double length = t * (2 * leg + EIGEN_PI * bend);
      if (length < leg)
      {
        return Eigen::Vector3d(30, 25, 10 + length);
      }
      const double angle = std::min<double>(EIGEN_PI, (length - leg) / bend);
      const double down = std::max<double>(0, length - leg - EIGEN_PI * bend);
      return Eigen::Vector3d(30 + bend * (1 - std::cos(angle)), 25,
        10 + leg + bend * std::sin(angle) - down);
    },
    [](double) { return 9.0; });
  const FloatImage volume = VolumeOfTubes({ arch }, Grid({ { 52, 26, 72 } }, { 2, 2, 2 }), 10);
  VesselSegmentationSettings settings = LumenSettings();
  for (const double radius : { 0.0, 9.0 })
  {
    SCOPED_TRACE(radius);
    settings.Path.Radius = radius;
    const VesselTree tree = TraceVessel(GrayVolumeOf(volume), "the volume", ClicksIn(arch),
      PointList(0, 3), settings.Path, OneThread, NeverStop);
    ASSERT_EQ(tree.Branches.size(), 1U);
    const PointList centers = tree.Branches[0].Sections.Centers();
    EXPECT_NEAR(centers.col(2).maxCoeff(), 122, 3);
    EXPECT_NEAR(tree.Radius, 9, 1);
    EXPECT_GT(tree.Support, 0.9);
  }
}

// The legs of a winding bend are joined by a haze: the way through it is much shorter, but it has
// no boundary.
TEST(VesselPath, AShortcutThatTheImageDoesNotSupportIsAvoided)
{
  const ExampleTube bend = MakeTube(
    [](double t)
    {
      constexpr double leg = 20;
      constexpr double radius = 20;
      constexpr double turn = EIGEN_PI * radius;
      const double length = t * (2 * leg + turn);
      const double angle = std::max(0.0, std::min<double>(EIGEN_PI, (length - leg) / radius));
      const double up = std::min(leg, length) - std::max(0.0, length - leg - turn);
      const double winding = 15 * std::min(1.0, 5 * std::min(t, 1 - t));
      return Eigen::Vector3d(40 - radius * std::cos(angle),
        40 + winding * std::sin(6 * EIGEN_PI * t), 6 + up + radius * std::sin(angle));
    },
    [](double) { return 4.0; });
  const ImageGeometry grid = Grid({ { 80, 80, 30 } }, { 1, 1, 2 });
  FloatImage volume = VolumeOfTubes({ bend }, grid, 5);
  const PointList clicks = ClicksIn(bend);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d point = grid.ToPhysical(Eigen::Vector3d(i, j, k));
      if (k >= 2 && std::abs(point[0] - 40) < 20 && !IsInTube(bend, point))
      {
        const double square =
          std::pow(point[1] - clicks(0, 1), 2) + std::pow(point[2] - clicks(0, 2) - 4, 2);
        volume.Voxels[grid.Offset(i, j, k)] += static_cast<float>(105 * std::exp(-square / 200));
      }
    });
  VesselSegmentationSettings settings = LumenSettings();
  settings.Path.Radius = 4;
  const VesselTree tree = TraceVessel(GrayVolumeOf(volume), "the volume", clicks, PointList(0, 3),
    settings.Path, OneThread, NeverStop);
  EXPECT_NEAR(tree.Branches.at(0).Sections.Centers().col(2).maxCoeff(), 46, 3);
  EXPECT_GT(tree.Support, 0.9);
}

// Where the far search would look for a wide vessel, in vain.
TEST(VesselPath, VoxelsFarAwayNeedNoData)
{
  const auto stub = [](double from, double to)
  {
    return MakeTube([=](double t) { return Eigen::Vector3d(30, 30, from + (to - from) * t); },
      [](double) { return 5.0; });
  };
  const ImageGeometry grid = Grid({ { 80, 30, 45 } }, { 2, 2, 2 });
  const PointList points = Points({ { 30, 30, 12 }, { 30, 30, 66 } });
  const auto trace = [&](const FloatImage& volume)
  {
    return TraceVessel(GrayVolumeOf(volume), "the volume", points, PointList(0, 3),
      LumenSettings().Path, OneThread, NeverStop);
  };
  FloatImage volume = VolumeOfTubes({ stub(5, 22), stub(56, 85) }, grid, 10);
  const VesselTree before = trace(volume);
  ASSERT_LT(before.Support, DoubtfulSupport);
  volume.Voxels[grid.Offset(60, 15, 20)] = std::numeric_limits<float>::quiet_NaN(); // x = 120 mm
  const VesselTree after = trace(volume);
  EXPECT_LT(after.Support, DoubtfulSupport);
  EXPECT_NEAR(after.Radius, before.Radius, 1);
}

TEST(VesselSegmentation, ObeysEveryCorrection)
{
  const ImageGeometry grid = Grid({ { 60, 60, 60 } }, { 1, 1, 1.5 });
  const ExampleTube tube = MakeTube([](double t) { return Eigen::Vector3d(30, 30, 5 + 80 * t); },
    [](double) { return 6.0; });
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  const ConstraintList corrections = { { ConstraintKind::Inside, { 38, 30, 30 }, 0 },
    { ConstraintKind::Outside, { 26, 30, 45 }, 0 },
    { ConstraintKind::Boundary, { 30, 37.5, 60 }, 0 } };
  const auto segment = [&](const ConstraintList& constraints)
  {
    return SegmentVessel(GrayVolumeOf(volume), "the volume", ClicksIn(tube), constraints,
      LumenSettings(), OneThread, NeverStop);
  };
  const VesselSegmentation before = segment({});
  const VesselSegmentation after = segment(corrections);
  const auto windingAt = [](const VesselSegmentation& result, const PointConstraint& constraint)
  { return WindingNumber(result.Surface.Points, result.Surface.Mesh.Triangles, constraint.Point); };
  EXPECT_EQ(windingAt(before, corrections[0]), 0);
  EXPECT_EQ(windingAt(after, corrections[0]), 1);
  EXPECT_EQ(windingAt(before, corrections[1]), 1);
  EXPECT_EQ(windingAt(after, corrections[1]), 0);
  EXPECT_LE(
    (ClosestPlace(after.Surface.Points, after.Surface.Mesh.Triangles, corrections[2].Point).Point -
      corrections[2].Point)
      .norm(),
    0.5);
  EXPECT_EQ(after.Surface.SelfIntersections, 0);
  EXPECT_EQ(after.Surface.Mesh.EulerNumber(), 2);
  // The vessel as a whole stays.
  EXPECT_GT(DiceOf(after, { BetweenClicks(tube) }, grid), 0.9);
  // Their order means nothing.
  EXPECT_EQ(segment({ corrections.rbegin(), corrections.rend() }).Surface.Points,
    after.Surface.Points);
}

// The cells of its start surface are 6 mm wide at first.
TEST(VesselSegmentation, APointNearThePathOfAWideVesselLiesOutside)
{
  const ImageGeometry grid = Grid({ { 45, 45, 45 } }, { 2, 2, 2 });
  const ExampleTube tube = MakeTube([](double t) { return Eigen::Vector3d(45, 45, 5 + 80 * t); },
    [](double) { return 12.0; });
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  for (const double angle : { 0.0, 2.0, 4.0 })
  {
    SCOPED_TRACE(angle);
    const PointConstraint outside{ ConstraintKind::Outside,
      { 45 + 4 * std::cos(angle), 45 + 4 * std::sin(angle), 45 }, 0 };
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume",
      ClicksIn(tube), { outside }, LumenSettings(), OneThread, NeverStop);
    EXPECT_EQ(WindingNumber(result.Surface.Points, result.Surface.Mesh.Triangles, outside.Point),
      0);
    EXPECT_EQ(result.Surface.SelfIntersections, 0);
    EXPECT_EQ(result.Surface.Mesh.EulerNumber(), 2);
    EXPECT_GT(DiceOf(result, { BetweenClicks(tube) }, grid), 0.8);
  }
}

// Its start surface has cells of 2.5 mm at first, one of which holds the point and the path.
TEST(VesselSegmentation, APointBesideThePathLiesOutside)
{
  const ImageGeometry grid = Grid({ { 60, 60, 60 } }, { 1, 1, 1.5 });
  const ExampleTube tube =
    MakeTube([](double t) { return Eigen::Vector3d(30, 30 + 6 * std::sin(4 * t), 5 + 80 * t); },
      [](double) { return 5.0; });
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  Eigen::Vector3d point = tube.Line.row(110).transpose();
  point[0] -= 1.5;
  VesselSegmentationSettings settings = LumenSettings();
  settings.Path.Radius = 5;
  const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume",
    ClicksIn(tube), { { ConstraintKind::Outside, point, 0 } }, settings, OneThread, NeverStop);
  EXPECT_EQ(WindingNumber(result.Surface.Points, result.Surface.Mesh.Triangles, point), 0);
}

TEST(VesselSegmentation, APointOutsideTurnsThePathAway)
{
  // From one end to the other there are two ways around, one of them longer.
  const auto arc = [](double side)
  {
    return MakeTube(
      [side](double t)
      {
        return Eigen::Vector3d(40 + side * std::sin(EIGEN_PI * t), 25,
          45 - 35 * std::cos(EIGEN_PI * t));
      },
      [](double) { return 4.0; });
  };
  const FloatImage volume =
    VolumeOfTubes({ arc(18), arc(-28) }, Grid({ { 72, 50, 60 } }, { 1, 1, 1.5 }), 10);
  const PointList points = Points({ { 40, 25, 11 }, { 40, 25, 79 } });
  const auto farthest = [&](const ConstraintList& constraints)
  {
    const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume", points,
      constraints, LumenSettings(), OneThread, NeverStop);
    const PointList centers = result.Tree.Branches.front().Sections.Centers();
    return centers(centers.rows() / 2, 0);
  };
  EXPECT_NEAR(farthest({}), 58, 2);
  EXPECT_NEAR(farthest({ { ConstraintKind::Outside, { 58, 25, 45 }, 0 } }), 12, 2);
}

TEST(VesselSegmentation, CorrectionsThatCannotBeObeyedAreNamed)
{
  const ExampleTube tube = Bent(5);
  const FloatImage volume = VolumeOfTubes({ tube }, BentGrid(), 10);
  const PointList points = ClicksIn(tube);
  const auto messageFor = [&](ConstraintKind kind, const Eigen::Vector3d& point)
  {
    return MessageOf(
      [&]
      {
        SegmentVessel(GrayVolumeOf(volume), "the volume", points, { { kind, point, 4 } },
          LumenSettings(), OneThread, NeverStop);
      });
  };
  const auto expect =
    [&](ConstraintKind kind, const Eigen::Vector3d& point, const std::string& text)
  {
    const std::string message = messageFor(kind, point);
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const Eigen::Vector3d near = points.row(0).transpose() + Eigen::Vector3d(0, 0.4, 0);
  expect(ConstraintKind::Outside, near, "lies at the vessel's point " + TextOf(points.row(0)));
  expect(ConstraintKind::Inside, { 40, 20, 300 }, "the inside point (40, 20, 300) mm lies outside");
  expect(ConstraintKind::Seed, { 40, 55, 35 }, "is of no use to a vessel");
  for (const auto kind : { ConstraintKind::Inside, ConstraintKind::Boundary })
  {
    expect(kind, { 75, 20, 70 }, "point (75, 20, 70) mm lies too far from the vessel's path");
  }
}

TEST(VesselPath, AThinnerWallLeavesATubeOrIsNamed)
{
  const ExampleTube tube = Bent(5);
  const FloatImage volume = VolumeOfTubes({ tube }, BentGrid(), 10);
  const auto trace = [&](double thickness)
  {
    VesselPathSettings settings;
    settings.WallThickness = thickness;
    return TraceVessel(GrayVolumeOf(volume), "the volume", ClicksIn(tube), PointList(0, 3),
      settings, OneThread, NeverStop);
  };
  const Eigen::MatrixXd lumen = trace(0).Branches.front().Sections.Radii;
  const Eigen::MatrixXd thinner = trace(-1).Branches.front().Sections.Radii;
  EXPECT_NEAR((lumen - thinner).minCoeff(), 1, 1e-9);
  const double most = lumen.mean() - 0.6;
  EXPECT_GE(trace(-most).Branches.front().Sections.Radii.minCoeff(), 0.5);
  const std::string message = MessageOf([&] { trace(-5); });
  EXPECT_NE(
    message.find("a WallThickness of -5 mm leaves less than 0.5 mm of a branch with a mean radius"),
    std::string::npos)
    << message;
}

// A weak contrast, which is none in Hounsfield units.
TEST(VesselPath, UsersSayWhatTheScaleOfTheGrayValuesIs)
{
  const ExampleTube tube = Bent(5);
  FloatImage volume = VolumeOfTubes({ tube }, BentGrid(), 10);
  for (float& value : volume.Voxels)
  {
    value *= 0.16F;
  }
  const auto support = [&](Modality modality)
  {
    VesselPathSettings settings;
    settings.Modality = modality;
    return TraceVessel(GrayVolumeOf(volume), "the volume", ClicksIn(tube), PointList(0, 3),
      settings, OneThread, NeverStop)
      .Support;
  };
  EXPECT_GT(support(Modality::MR), 0.95);
  EXPECT_THROW(support(Modality::CT), Error);
  EXPECT_EQ(support(Modality::Automatic), support(Modality::MR)); // nothing is as bright as tissue
}

TEST(VesselSegmentation, WarnsWhereTheImageDoesNotShowTheBoundary)
{
  // Two stubs; what joins them is as dark as its surroundings.
  const auto stub = [](double from, double to)
  {
    return MakeTube([=](double t) { return Eigen::Vector3d(30, 30, from + (to - from) * t); },
      [](double) { return 5.0; });
  };
  const FloatImage volume =
    VolumeOfTubes({ stub(5, 22), stub(56, 85) }, Grid({ { 60, 60, 60 } }, { 1, 1, 1.5 }), 10);
  const VesselSegmentation result = SegmentVessel(GrayVolumeOf(volume), "the volume",
    Points({ { 30, 30, 12 }, { 30, 30, 66 } }), {}, LumenSettings(), OneThread, NeverStop);
  EXPECT_LT(result.Tree.Support, DoubtfulSupport);
  EXPECT_LT(result.Confidence.Value, VesselConfidenceSettings().Doubtful);
  EXPECT_TRUE(result.Confidence.IsFaint);
  ASSERT_FALSE(result.Warnings.empty());
  const std::string& warning = result.Warnings.front();
  EXPECT_NE(warning.find("The result is doubtful: the vessel's boundary is hardly visible"),
    std::string::npos);
  // It names a place between the stubs.
  double x = 0;
  double y = 0;
  double z = 0;
  const std::size_t place = warning.find("near (");
  ASSERT_NE(place, std::string::npos) << warning;
  ASSERT_EQ(std::sscanf(warning.c_str() + place, "near (%lf, %lf, %lf) mm", &x, &y, &z), 3);
  EXPECT_GT(z, 22);
  EXPECT_LT(z, 56);
}

// What joins the two ends has an outline as fine as theirs, but is not as bright.
TEST(VesselSegmentation, WarnsWhereThePathLeavesTheVessel)
{
  const auto stub = [](double from, double to)
  {
    return MakeTube([=](double t) { return Eigen::Vector3d(30, 30, from + (to - from) * t); },
      [](double) { return 5.0; });
  };
  const ImageGeometry grid = Grid({ { 60, 60, 60 } }, { 1, 1, 1.5 });
  FloatImage volume = VolumeOfTubes({ stub(5, 85) }, grid, 10);
  const auto trace = [&]
  {
    return SegmentVessel(GrayVolumeOf(volume), "the volume",
      Points({ { 30, 30, 12 }, { 30, 30, 78 } }), {}, LumenSettings(), OneThread, NeverStop);
  };
  const VesselSegmentation plain = trace();
  EXPECT_GT(plain.Confidence.Value, 0.7);
  EXPECT_TRUE(plain.Warnings.empty());

  const ExampleTube other = stub(32, 58);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (IsInTube(other, grid.ToPhysical(Eigen::Vector3d(i, j, k))))
      {
        volume.Voxels[grid.Offset(i, j, k)] -= 60;
      }
    });
  const VesselSegmentation result = trace();
  EXPECT_GT(result.Tree.Support, 0.9);
  EXPECT_LT(result.Confidence.Value, VesselConfidenceSettings().Doubtful);
  EXPECT_FALSE(result.Confidence.IsFaint);
  EXPECT_GT(result.Confidence.Place.z(), 32);
  EXPECT_LT(result.Confidence.Place.z(), 58);
  ASSERT_EQ(result.Warnings.size(), 1U);
  EXPECT_EQ(result.Warnings[0].find("The result is doubtful: the path leaves what looks like the "
                                    "vessel at its points, most of all near ("),
    0U);
}

TEST(VesselConfidence, IsThatOfTheLeastSection)
{
  VesselTree tree;
  tree.Branches.resize(2);
  for (VesselBranch& branch : tree.Branches)
  {
    for (int section = 0; section < 101; ++section)
    {
      branch.Sections.Frames.push_back(
        { { 0, 0, 1.0 * section }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } });
    }
    branch.Support.setConstant(101, 0.9);
    branch.Speed.setConstant(101, 1);
  }
  VesselConfidenceSettings settings;
  settings.Length = 10;
  settings.SlownessWeight = 0.2;
  EXPECT_NEAR(ConfidenceOf(tree, settings).Value, 0.9, 1e-12);
  tree.Branches[1].Speed.segment(40, 21).setConstant(0.1);
  const VesselConfidence slow = ConfidenceOf(tree, settings);
  EXPECT_NEAR(slow.Value, 0.9 - 0.2 * std::log(10.0), 1e-12);
  EXPECT_FALSE(slow.IsFaint);
  EXPECT_NEAR(slow.Place.z(), 50, 6);
  tree.Branches[0].Support.segment(70, 21).setConstant(0.2);
  const VesselConfidence faint = ConfidenceOf(tree, settings);
  EXPECT_NEAR(faint.Value, 0.2, 1e-12);
  EXPECT_TRUE(faint.IsFaint);
  EXPECT_NEAR(faint.Place.z(), 80, 6);
  tree.Branches[0].Speed.setConstant(1e-3);
  EXPECT_EQ(ConfidenceOf(tree, settings).Value, 0);
}

// Vessels of known shape: what makes real ones hard, one at a time.
#include "ExampleVessels.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace FlipFree;

namespace
{

VesselSegmentation SegmentTubes(const FloatImage& volume, const PointList& points)
{
  return SegmentVessel(GrayVolumeOf(volume), "the volume", points, {}, LumenSettings(),
    { SerialFor, 1 }, NeverStop);
}

void ExpectFound(const VesselSegmentation& result, const std::vector<ExampleTube>& truth,
  const ImageGeometry& grid, double dice)
{
  EXPECT_GT(DiceOf(result, truth, grid), dice);
  EXPECT_EQ(result.Surface.SelfIntersections, 0);
  EXPECT_EQ(result.Surface.Mesh.EulerNumber(), 2);
}

ImageGeometry UprightGrid()
{
  return Grid({ { 60, 60, 64 } }, { 1, 1, 1.25 });
}

// An upright tube of 5 mm that is wider or narrower around its middle.
ExampleTube Uneven(double inTheMiddle, double extent)
{
  return MakeTube([](double t) { return Eigen::Vector3d(30, 30, 80 * t); },
    [=](double t)
    { return 5 + (inTheMiddle - 5) * std::exp(-0.5 * std::pow((80 * t - 40) / extent, 2)); });
}

ExampleTube Straight(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius)
{
  return MakeTube([=](double t) { return Eigen::Vector3d(from + t * (to - from)); },
    [=](double) { return radius; });
}

Eigen::Vector3d ClickAtEnd(const ExampleTube& tube)
{
  return tube.Line.row(LastClick).transpose();
}

} // namespace

TEST(VesselPhantoms, AStenosis)
{
  const ExampleTube tube = Uneven(2.2, 6);
  const FloatImage volume = VolumeOfTubes({ tube }, UprightGrid(), 10);
  ExpectFound(SegmentTubes(volume, ClicksIn(tube)), { BetweenClicks(tube) }, UprightGrid(), 0.95);
}

TEST(VesselPhantoms, AnAneurysm)
{
  const ExampleTube tube = Uneven(10, 8);
  const FloatImage volume = VolumeOfTubes({ tube }, UprightGrid(), 10);
  ExpectFound(SegmentTubes(volume, ClicksIn(tube)), { BetweenClicks(tube) }, UprightGrid(), 0.95);
}

TEST(VesselPhantoms, ABifurcation)
{
  const ImageGeometry grid = Grid({ { 80, 48, 64 } }, { 1, 1, 1.25 });
  const ExampleTube trunk = Straight({ 40, 24, 0 }, { 40, 24, 36 }, 6);
  const ExampleTube left = Straight({ 40, 24, 36 }, { 16, 24, 80 }, 4.5);
  const ExampleTube right = Straight({ 40, 24, 36 }, { 64, 24, 80 }, 4.5);
  const FloatImage volume = VolumeOfTubes({ trunk, left, right }, grid, 10);
  const VesselSegmentation result = SegmentTubes(volume,
    Points({ trunk.Line.row(FirstClick + 30).transpose(), ClickAtEnd(left), ClickAtEnd(right) }));
  EXPECT_EQ(result.Tree.Branches.size(), 2U);
  ExampleTube root = trunk;
  root.Line = trunk.Line.bottomRows(trunk.Line.rows() - FirstClick - 30);
  root.Radii.erase(root.Radii.begin(), root.Radii.begin() + FirstClick + 30);
  ExpectFound(result, { root, BetweenClicks(left, 0), BetweenClicks(right, 0) }, grid, 0.95);
}

TEST(VesselPhantoms, ATreeOfSevenBranches)
{
  const ImageGeometry grid = Grid({ { 100, 40, 80 } }, { 1, 1, 1.25 });
  const Eigen::Vector3d first(48, 20, 30);
  const Eigen::Vector3d left(28, 20, 58);
  const Eigen::Vector3d right(68, 20, 58);
  std::vector<ExampleTube> tubes = { Straight({ 48, 20, 0 }, first, 5.5),
    Straight(first, left, 4.5), Straight(first, right, 4.5) };
  for (const double x : { 12.0, 40.0 })
  {
    tubes.push_back(Straight(left, { x, 20, 98 }, 3.5));
    tubes.push_back(Straight(right, { x + 44, 20, 98 }, 3.5));
  }
  const FloatImage volume = VolumeOfTubes(tubes, grid, 10);
  std::vector<Eigen::Vector3d> clicks = { { 48, 20, 6 } };
  for (std::size_t tube = 0; tube < tubes.size(); ++tube)
  {
    if (tube >= 3)
    {
      clicks.push_back(ClickAtEnd(tubes[tube]));
      tubes[tube] = BetweenClicks(tubes[tube], 0);
    }
  }
  tubes[0] = Straight(clicks[0], first, 5.5);
  const VesselSegmentation result = SegmentTubes(volume, Points(clicks));
  EXPECT_EQ(result.Tree.Branches.size(), 4U); // paths: one through the root, and three more
  ExpectFound(result, tubes, grid, 0.93);
}

// Of the left brachiocephalic vein's size, and a contrast as in the paper's Fig. 9.
TEST(VesselPhantoms, TheSurfaceOfAVeinIsWithinAThirdOfAMillimeter)
{
  const ImageGeometry grid = Grid({ { 100, 64, 40 } }, { 0.8, 0.8, 1.25 });
  const ExampleTube tube = MakeTube([](double t)
    { return Eigen::Vector3d(80 * t, 26 + 8 * std::sin(2.5 * t), 18 + 10 * t); },
    [](double t) { return 5.5 + std::sin(5 * t); });
  const FloatImage volume = VolumeOfTubes({ tube }, grid, 10);
  const VesselSegmentation result = SegmentTubes(volume, ClicksIn(tube));
  double sum = 0;
  int count = 0;
  for (Eigen::Index vertex = 0; vertex < result.Surface.Points.rows(); ++vertex)
  {
    Eigen::Index nearest = 0;
    const double distance = std::sqrt((tube.Line.rowwise() - result.Surface.Points.row(vertex))
                                        .rowwise()
                                        .squaredNorm()
                                        .minCoeff(&nearest));
    if (nearest > FirstClick + 5 && nearest < LastClick - 5) // not of the disks at the ends
    {
      sum += std::abs(distance - tube.Radii[nearest]);
      ++count;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_LT(sum / count, 0.35);
  ExpectFound(result, { BetweenClicks(tube) }, grid, 0.95);
}

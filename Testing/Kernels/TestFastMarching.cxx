#include "ExampleMasks.h"
#include "Vessel/FastMarching.h"
#include "Vessel/MinimalPaths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace FlipFree;

namespace
{

constexpr float Always = std::numeric_limits<float>::infinity();

FloatImage Uniform(const ImageGeometry& geometry, float speed)
{
  FloatImage image;
  image.Geometry = geometry;
  image.Voxels.assign(geometry.NumberOfVoxels(), speed);
  return image;
}

double LengthOf(const PointList& line)
{
  double length = 0;
  for (Eigen::Index point = 1; point < line.rows(); ++point)
  {
    length += (line.row(point) - line.row(point - 1)).norm();
  }
  return length;
}

} // namespace

TEST(FastMarching, TimesAreDistancesOverSpeed)
{
  const ImageGeometry grid = Grid({ { 41, 31, 21 } }, { 1, 1.5, 2 });
  const FloatImage speed = Uniform(grid, 2);
  const std::size_t source = grid.Offset(20, 15, 10);
  const std::size_t corner = grid.Offset(0, 0, 0);
  const Arrivals arrivals =
    MarchFront(speed.View(), { source }, {}, grid.NumberOfVoxels(), Always, NeverStop);
  const Eigen::Vector3d center = grid.ToPhysical(Eigen::Vector3d(20, 15, 10));
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const double distance = (grid.ToPhysical(Eigen::Vector3d(i, j, k)) - center).norm();
      const double time = arrivals.Times[grid.Offset(i, j, k)];
      // Differences of the first order are late, by less than a voxel or so and never early.
      EXPECT_GE(time, distance / 2 - 1e-3);
      EXPECT_LE(time, (distance * 1.06 + 2.0) / 2);
    });
  // Along an axis they are exact.
  EXPECT_NEAR(arrivals.Times[grid.Offset(0, 15, 10)], 10, 1e-4);
  EXPECT_NEAR(arrivals.Times[grid.Offset(20, 15, 0)], 10, 1e-4);
  const auto way = DescendToSource(arrivals, grid, corner);
  EXPECT_EQ(way.front(), corner);
  EXPECT_EQ(way.back(), source);
}

TEST(FastMarching, StopsAtTheFirstTargetAndWhenAsked)
{
  const ImageGeometry grid = Grid({ { 80, 60, 50 } }, { 1, 1, 1 });
  const FloatImage speed = Uniform(grid, 1);
  const std::size_t near = grid.Offset(10, 5, 5);
  const std::size_t far = grid.Offset(70, 50, 40);
  const Arrivals arrivals =
    MarchFront(speed.View(), { grid.Offset(5, 5, 5) }, { far, near }, 1, Always, NeverStop);
  ASSERT_EQ(arrivals.Reached, std::vector<std::size_t>{ near });
  EXPECT_TRUE(std::isinf(arrivals.Times[far]));
  const Arrivals stopped = MarchFront(speed.View(), { grid.Offset(5, 5, 5) }, { far }, 1, Always,
    [](double) { return false; });
  EXPECT_TRUE(stopped.Reached.empty());
}

TEST(FastMarching, StopsAtTheLatestTime)
{
  const ImageGeometry grid = Grid({ { 40, 9, 9 } }, { 1, 1, 1 });
  const FloatImage speed = Uniform(grid, 2);
  const std::size_t source = grid.Offset(5, 4, 4);
  const std::size_t target = grid.Offset(25, 4, 4); // after 10
  EXPECT_TRUE(MarchFront(speed.View(), { source }, { target }, 1, 9.9F, NeverStop).Reached.empty());
  EXPECT_EQ(MarchFront(speed.View(), { source }, { target }, 1, 10.1F, NeverStop).Reached.size(),
    1U);
}

TEST(FastMarching, LeavesASourceInAWall)
{
  const ImageGeometry grid = Grid({ { 9, 9, 9 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 1);
  speed.Voxels[grid.Offset(0, 4, 4)] = 0;
  const Arrivals arrivals = MarchFront(speed.View(), { grid.Offset(0, 4, 4) }, {},
    grid.NumberOfVoxels(), Always, NeverStop);
  EXPECT_EQ(arrivals.Times[grid.Offset(0, 4, 4)], 0);
  EXPECT_NEAR(arrivals.Times[grid.Offset(8, 4, 4)], 8, 1e-5);
}

TEST(FastMarching, DoesNotEnterWalls)
{
  const ImageGeometry grid = Grid({ { 30, 30, 3 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 1);
  for (int j = 0; j < 30; ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      speed.Voxels[grid.Offset(15, j, k)] = 0;
    }
  }
  const std::size_t beyond = grid.Offset(25, 5, 1);
  EXPECT_TRUE(MarchFront(speed.View(), { grid.Offset(5, 5, 1) }, { beyond }, 1, Always, NeverStop)
                .Reached.empty());
  PointList points(2, 3);
  points << 5, 5, 1, 25, 5, 1;
  EXPECT_THROW(JoinPoints(speed.View(), points, points, 5, NeverStop), std::invalid_argument);
  // A gap at the far end: around the wall, 10 and 24 voxels to either side of it.
  speed.Voxels[grid.Offset(15, 29, 1)] = 1;
  const auto paths = JoinPoints(speed.View(), points, points, 5, NeverStop);
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_NEAR(LengthOf(paths[0].Line), 2 * std::hypot(10, 24), 5);
}

TEST(FastMarching, FrontsMeetOnTheFastestWayBetweenAnyTwo)
{
  const ImageGeometry grid = Grid({ { 60, 30, 20 } }, { 1, 1, 1.5 });
  const FloatImage speed = Uniform(grid, 0.5F);
  const std::size_t left = grid.Offset(10, 15, 10);
  const std::size_t right = grid.Offset(31, 15, 10);
  const std::size_t away = grid.Offset(58, 15, 10);
  const Meeting meeting = MeetFronts(speed.View(), { left, away, right }, NeverStop);
  ASSERT_EQ(meeting.Voxels.size(), 2U);
  EXPECT_EQ(meeting.Voxels[0], grid.Offset(20, 15, 10));
  EXPECT_EQ(meeting.Voxels[1], grid.Offset(21, 15, 10));
  EXPECT_EQ(meeting.Times.Owners[meeting.Voxels[0]], 0);
  EXPECT_EQ(meeting.Times.Owners[meeting.Voxels[1]], 2);
  EXPECT_EQ(DescendToSource(meeting.Times, grid, meeting.Voxels[0]).back(), left);
  EXPECT_EQ(DescendToSource(meeting.Times, grid, meeting.Voxels[1]).back(), right);
  // Half of the distance, and no farther.
  EXPECT_TRUE(std::isinf(meeting.Times.Times[grid.Offset(45, 15, 10)]));
  // In another order.
  EXPECT_EQ(MeetFronts(speed.View(), { away, right, left }, NeverStop).Voxels, meeting.Voxels);
  EXPECT_TRUE(MeetFronts(speed.View(), { left }, NeverStop).Voxels.empty());
}

TEST(FastMarching, FrontsMeetAsFarAwayAsOneFrontArrives)
{
  // Speeds that vary, with a fast detour.
  const ImageGeometry grid = Grid({ { 40, 30, 12 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 0.05F);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (std::abs(std::hypot(i - 20, j) - 18) < 2.5)
      {
        speed.Voxels[grid.Offset(i, j, k)] = static_cast<float>(0.5 + 0.02 * i);
      }
    });
  const std::size_t from = grid.Offset(2, 1, 6);
  const std::size_t to = grid.Offset(38, 1, 6);
  const Arrivals one = MarchFront(speed.View(), { from }, { to }, 1, Always, NeverStop);
  const Meeting meeting = MeetFronts(speed.View(), { from, to }, NeverStop);
  ASSERT_EQ(meeting.Voxels.size(), 2U);
  const double whole =
    meeting.Times.Times[meeting.Voxels[0]] + meeting.Times.Times[meeting.Voxels[1]];
  EXPECT_NEAR(whole, one.Times[to], 0.05 * one.Times[to]);
}

TEST(MinimalPaths, MessagesNameThePointsThatTheUserGave)
{
  const ImageGeometry grid = Grid({ { 30, 30, 3 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 1);
  for (int j = 0; j < 30; ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      speed.Voxels[grid.Offset(15, j, k)] = 0;
    }
  }
  PointList points(3, 3);
  points << 5, 5, 1, 5, 20, 1, 25, 5, 1;
  PointList names = points;
  names(2, 1) = 7;
  try
  {
    JoinPoints(speed.View(), points, names, 5, NeverStop);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("the point (25, 7, 1) mm"), std::string::npos)
      << error.what();
  }
}

TEST(MinimalPaths, PreferTheFasterWayAround)
{
  // A fast quarter of an annulus in a slow plane.
  const ImageGeometry grid = Grid({ { 60, 60, 3 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 0.01F);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (std::abs(std::hypot(i, j) - 40) < 3)
      {
        speed.Voxels[grid.Offset(i, j, k)] = 1;
      }
    });
  PointList points(2, 3);
  points << 40, 0, 1, 0, 40, 1;
  const auto paths = JoinPoints(speed.View(), points, points, 5, NeverStop);
  ASSERT_EQ(paths.size(), 1U);
  for (Eigen::Index point = 0; point < paths[0].Line.rows(); ++point)
  {
    EXPECT_NEAR(paths[0].Line.row(point).head<2>().norm(), 40, 4);
  }
}

TEST(MinimalPaths, APointOnTheWayProlongsAndAPointAsideBranchesOff)
{
  const ImageGeometry grid = Grid({ { 80, 60, 5 } }, { 1, 1, 1 });
  FloatImage speed = Uniform(grid, 0.01F);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (std::abs(j - 20) < 3 || (std::abs(i - 40) < 3 && j > 20))
      {
        speed.Voxels[grid.Offset(i, j, k)] = 1;
      }
    });
  PointList onTheWay(3, 3);
  onTheWay << 5, 20, 2, 75, 20, 2, 50, 20, 2;
  const auto line = JoinPoints(speed.View(), onTheWay, onTheWay, 6, NeverStop);
  ASSERT_EQ(line.size(), 1U);
  EXPECT_NEAR(LengthOf(line[0].Line), 70, 1);
  PointList aside(3, 3);
  aside << 20, 20, 2, 60, 20, 2, 40, 55, 2;
  const auto tree = JoinPoints(speed.View(), aside, aside, 6, NeverStop);
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].Parent, 0);
  EXPECT_EQ(tree[1].Line.row(0), tree[0].Line.row(tree[1].Junction));
  EXPECT_NEAR(LengthOf(tree[0].Line) + LengthOf(tree[1].Line), 40 + 35, 3);
}

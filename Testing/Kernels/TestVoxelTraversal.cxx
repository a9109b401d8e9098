#include "ExampleSurfaces.h"
#include "Image/VoxelTraversal.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace FlipFree;

namespace
{

ImageGeometry AnisotropicGrid(const Eigen::Matrix3d& direction)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 17, 13, 9 } };
  geometry.Origin = Eigen::Vector3d(-40, 25, 310);
  geometry.Spacing = Eigen::Vector3d(0.7, 1.1, 2.9);
  geometry.Direction = direction;
  return geometry;
}

std::array<int, 3> VoxelOf(const ImageGeometry& geometry, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d index = geometry.ToIndex(point);
  return { { static_cast<int>(std::floor(index[0] + 0.5)),
    static_cast<int>(std::floor(index[1] + 0.5)), static_cast<int>(std::floor(index[2] + 0.5)) } };
}

struct Step
{
  std::array<int, 3> Voxel;
  double Entry;
  double Exit;
};

std::vector<Step> StepsWithin(const ImageGeometry& geometry, const Eigen::Vector3d& start,
  const Eigen::Vector3d& direction, double length)
{
  std::vector<Step> steps;
  const VoxelGrid grid(geometry);
  for (VoxelTraversal walk(grid, start, direction); walk.GetEntry() <= length; walk.Advance())
  {
    steps.push_back({ walk.GetVoxel(), walk.GetEntry(), walk.GetExit() });
  }
  return steps;
}

} // namespace

// Dense samples of the line fall into the voxels of the walk, one after the other, at the distances
// that it names; and the walk has no voxel in which the line is longer than the samples' spacing
// that these do not see.
TEST(VoxelTraversal, IsWhatDenseSamplingSees)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double length = 30;
  const double spacing = 1e-3;
  for (const auto& [name, matrix] : ExampleDirections())
  {
    const ImageGeometry geometry = AnisotropicGrid(matrix);
    for (int repeat = 0; repeat < 20; ++repeat)
    {
      const Eigen::Vector3d start = geometry.ToPhysical(
        Eigen::Vector3d(8 + 9 * uniform(random), 6 + 7 * uniform(random), 4 + 5 * uniform(random)));
      const Eigen::Vector3d direction =
        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
      const std::vector<Step> steps = StepsWithin(geometry, start, direction, length);
      std::size_t at = 0;
      std::vector<char> seen(steps.size(), 0);
      for (double distance = 0; distance <= length; distance += spacing)
      {
        while (at + 1 < steps.size() && steps[at].Exit < distance)
        {
          ++at;
        }
        // On a face itself either side is right.
        if (distance - steps[at].Entry > 1e-9 && steps[at].Exit - distance > 1e-9)
        {
          ASSERT_EQ(VoxelOf(geometry, start + distance * direction), steps[at].Voxel)
            << name << " line " << repeat << " at " << distance;
          seen[at] = 1;
        }
      }
      for (std::size_t step = 0; step + 1 < steps.size(); ++step)
      {
        EXPECT_TRUE(seen[step] || steps[step].Exit - steps[step].Entry < 2 * spacing) << name;
      }
    }
  }
}

TEST(VoxelTraversal, VisitsEachVoxelOnceThroughFaces)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& [name, matrix] : ExampleDirections())
  {
    const ImageGeometry geometry = AnisotropicGrid(matrix);
    for (int repeat = 0; repeat < 100; ++repeat)
    {
      const Eigen::Vector3d start = geometry.ToPhysical(Eigen::Vector3d(8, 6, 4) +
        20 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random)));
      const Eigen::Vector3d direction =
        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
      const std::vector<Step> steps = StepsWithin(geometry, start, direction, 100);
      std::set<std::array<int, 3>> voxels;
      EXPECT_EQ(steps.front().Voxel, VoxelOf(geometry, start));
      EXPECT_EQ(steps.front().Entry, 0);
      for (std::size_t step = 0; step < steps.size(); ++step)
      {
        EXPECT_TRUE(voxels.insert(steps[step].Voxel).second) << name;
        EXPECT_GE(steps[step].Exit, steps[step].Entry);
        if (step > 0)
        {
          EXPECT_EQ(steps[step].Entry, steps[step - 1].Exit);
          int moves = 0;
          for (int axis = 0; axis < 3; ++axis)
          {
            moves += std::abs(steps[step].Voxel[axis] - steps[step - 1].Voxel[axis]);
          }
          EXPECT_EQ(moves, 1);
        }
      }
    }
  }
}

TEST(VoxelTraversal, WalksAlongTheAxes)
{
  for (const auto& [name, matrix] : ExampleDirections())
  {
    ImageGeometry geometry = AnisotropicGrid(matrix);
    geometry.Origin.setZero();
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int sign : { -1, 1 })
      {
        const std::array<int, 3> first{ { 8, 6, 4 } };
        const Eigen::Vector3d start = geometry.ToPhysical(Eigen::Vector3d(8, 6, 4));
        const std::vector<Step> steps = StepsWithin(geometry, start,
          sign * geometry.Direction.col(axis), 3.2 * geometry.Spacing[axis]);
        ASSERT_EQ(steps.size(), 4u) << name;
        for (int step = 0; step < 4; ++step)
        {
          std::array<int, 3> expected = first;
          expected[axis] += sign * step;
          EXPECT_EQ(steps[step].Voxel, expected) << name;
          EXPECT_NEAR(steps[step].Exit, (step + 0.5) * geometry.Spacing[axis], 1e-12) << name;
        }
      }
    }
  }
}

TEST(VoxelTraversal, ComesInFromOutside)
{
  const ImageGeometry geometry = AnisotropicGrid(ObliqueRotation());
  const VoxelGrid grid(geometry);
  const Eigen::Vector3d start = geometry.ToPhysical(Eigen::Vector3d(-10, 6, 4));
  VoxelTraversal walk(grid, start, geometry.Direction.col(0));
  EXPECT_FALSE(walk.IsInside());
  int outside = 0;
  for (; !walk.IsInside() && outside < 100; walk.Advance())
  {
    ++outside;
  }
  EXPECT_EQ(outside, 10);
  EXPECT_EQ(walk.GetVoxel(), (std::array<int, 3>{ { 0, 6, 4 } }));
  EXPECT_NEAR(walk.GetEntry(), 9.5 * 0.7, 1e-12);
  int inside = 0;
  for (; walk.IsInside() && inside < 100; walk.Advance())
  {
    ++inside;
  }
  EXPECT_EQ(inside, 17);
  EXPECT_NEAR(walk.GetEntry(), 26.5 * 0.7, 1e-12);
}

TEST(VoxelTraversal, FarOutsideNeverArrives)
{
  const VoxelGrid grid(AnisotropicGrid(Eigen::Matrix3d::Identity()));
  for (double far : { 1e12, 1e300, -1e300 })
  {
    VoxelTraversal walk(grid, Eigen::Vector3d(far, 0, 0), Eigen::Vector3d(-1, 0, 0));
    for (int step = 0; step < 100; ++step, walk.Advance())
    {
      ASSERT_FALSE(walk.IsInside());
    }
  }
}

// The minimum cut against all cuts that there are, on grids that are small enough.
#include "../Kernels/ExampleMasks.h"
#include "Image/SeedRegion.h"
#include "VoxelCut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace FlipFree;

namespace
{

struct Problem
{
  FloatImage Image;
  std::vector<float> LogOdds;
  BitMask Candidates;
  BitMask Seeds;
  VoxelCutSettings Settings;
};

// 12 voxels, one seed, one that is no candidate.
Problem RandomProblem(unsigned int number)
{
  std::mt19937 random(number);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Problem problem;
  problem.Image.Geometry.Dimensions = { { 3, 2, 2 } };
  problem.Image.Geometry.Spacing = Eigen::Vector3d(0.8, 1.1, 2.5);
  for (int voxel = 0; voxel < 12; ++voxel)
  {
    problem.Image.Voxels.push_back(20 * uniform(random));
    problem.LogOdds.push_back(3 * uniform(random));
  }
  problem.Candidates = BitMask(problem.Image.Geometry);
  problem.Candidates.Complement();
  BitMask excluded(problem.Image.Geometry);
  excluded.Insert(2, 1, static_cast<int>(number % 2));
  problem.Candidates.Remove(excluded);
  problem.Seeds = BitMask(problem.Image.Geometry);
  problem.Seeds.Insert(0, 0, 0);
  problem.Settings.Smoothness = 1 + uniform(random);
  problem.Settings.EdgeContrast = 15;
  return problem;
}

// What the header says is minimized, but for the voxels' volume as a common factor.
double EnergyOf(const Problem& problem, const std::function<bool(int, int, int)>& inside)
{
  const ImageView<float> image = problem.Image.View();
  const auto& size = image.Geometry.Dimensions;
  double energy = 0;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        energy -= inside(i, j, k) ? problem.LogOdds[image.Geometry.Offset(i, j, k)] : 0;
        const int steps[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
        for (int axis = 0; axis < 3; ++axis)
        {
          const int next[3] = { i + steps[axis][0], j + steps[axis][1], k + steps[axis][2] };
          if (image.Geometry.Contains(next[0], next[1], next[2]) &&
            inside(i, j, k) != inside(next[0], next[1], next[2]))
          {
            const double jump =
              (image(i, j, k) - image(next[0], next[1], next[2])) / problem.Settings.EdgeContrast;
            energy += problem.Settings.Smoothness / image.Geometry.Spacing[axis] *
              std::exp(-jump * jump / 2);
          }
        }
      }
    }
  }
  return energy;
}

double MinimumEnergy(const Problem& problem)
{
  const ImageGeometry& geometry = problem.Image.Geometry;
  double least = HUGE_VAL;
  for (unsigned int subset = 0; subset < 1U << 12U; ++subset)
  {
    const auto inside = [&](int i, int j, int k)
    { return (subset >> geometry.Offset(i, j, k) & 1U) != 0; };
    bool allowed = true;
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      { allowed &= inside(i, j, k) ? problem.Candidates(i, j, k) : !problem.Seeds(i, j, k); });
    least = allowed ? std::min(least, EnergyOf(problem, inside)) : least;
  }
  return least;
}

} // namespace

TEST(VoxelCut, IsTheBestOfAllCuts)
{
  int mixed = 0;
  for (unsigned int number = 0; number < 60; ++number)
  {
    const Problem problem = RandomProblem(number);
    BitMask organ;
    ASSERT_TRUE(FindVoxelCut(problem.Image.View(), problem.LogOdds, problem.Candidates,
      problem.Seeds, problem.Settings, NeverStop, organ));
    EXPECT_TRUE(organ(0, 0, 0));
    EXPECT_FALSE(organ(2, 1, static_cast<int>(number % 2)));
    const auto inside = [&organ](int i, int j, int k) { return organ(i, j, k); };
    EXPECT_NEAR(EnergyOf(problem, inside), MinimumEnergy(problem), 1e-4) << "problem " << number;
    mixed += organ.Count() > 1 && organ.Count() < 11;
  }
  EXPECT_GT(mixed, 20); // or all of them would be trivial
}

TEST(VoxelCut, FollowsTheEdgeOfAnObjectWithoutARegionalTerm)
{
  // A bright block of 6 x 6 x 4 in 12 x 12 x 8 dark voxels. The rim of the grid is no candidate.
  FloatImage image;
  image.Geometry.Dimensions = { { 12, 12, 8 } };
  BitMask candidates(image.Geometry);
  BitMask seeds(image.Geometry);
  const auto isInside = [](int i, int j, int k)
  { return i > 2 && i < 9 && j > 2 && j < 9 && k > 1 && k < 6; };
  ForEachVoxel(image.Geometry,
    [&](int i, int j, int k) { image.Voxels.push_back(isInside(i, j, k) ? 100.0F : 0.0F); });
  ForEachVoxel(VoxelBox{ { { 1, 1, 1 } }, { { 11, 11, 7 } } },
    [&](int i, int j, int k) { candidates.Insert(i, j, k); });
  seeds.Insert(5, 5, 4);
  const std::vector<float> odds(image.Voxels.size(), 0);
  BitMask organ;
  ASSERT_TRUE(FindVoxelCut(image.View(), odds, candidates, seeds, { 1, 20 }, NeverStop, organ));
  EXPECT_EQ(organ.Count(), 6U * 6 * 4);
  EXPECT_TRUE(organ(3, 3, 2));
  EXPECT_FALSE(organ(2, 3, 2));
}

TEST(VoxelCut, StopsAndLeavesTheMaskAsItWas)
{
  FloatImage image;
  image.Geometry.Dimensions = { { 40, 40, 40 } };
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<float> odds;
  for (std::size_t voxel = 0; voxel < image.Geometry.NumberOfVoxels(); ++voxel)
  {
    image.Voxels.push_back(normal(random));
    odds.push_back(normal(random));
  }
  BitMask candidates(image.Geometry);
  candidates.Complement();
  BitMask seeds(image.Geometry);
  seeds.Insert(20, 20, 20);
  BitMask organ;
  for (const int stop : { 3, 43 }) // while the graph is built, plane by plane, and while it is cut
  {
    int asked = 0;
    double last = 0;
    EXPECT_FALSE(FindVoxelCut(
      image.View(), odds, candidates, seeds, { 1, 1 },
      [&](double fraction)
      {
        EXPECT_GE(fraction, last);
        EXPECT_LT(fraction, 1);
        last = fraction;
        return ++asked < stop;
      },
      organ));
    EXPECT_EQ(asked, stop);
    EXPECT_EQ(last > 0, stop > image.Geometry.Dimensions[2]);
    EXPECT_TRUE(organ.GetWords().empty());
  }
}

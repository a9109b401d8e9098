// Lengths that follow the seed and the voxels, within their limits.
#include "Deformation/SegmentationSettings.h"
#include "ExampleMasks.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

const ImageGeometry Fine = Grid({ { 8, 8, 8 } }, { 1, 1, 0.5 });
const ImageGeometry Coarse = Grid({ { 8, 8, 8 } }, { 1, 1, 5 });

} // namespace

TEST(SegmentationSettings, ReachFollowsTheSeed)
{
  EXPECT_EQ(ReachOf({}, 5), 100);
  EXPECT_EQ(ReachOf({}, 20), 200);
  EXPECT_EQ(ReachOf({}, 40), 250);
  EXPECT_EQ(ReachOf({ 33, 5 }, 40), 33);
}

TEST(SegmentationSettings, SearchLinesFollowTheSeed)
{
  TargetSettings settings;
  EXPECT_EQ(SearchDistanceOf(settings, 5), 15);
  EXPECT_EQ(SearchDistanceOf(settings, 25), 40);
  EXPECT_EQ(SearchDistanceOf(settings, 50), 60);
  settings.SearchScale = 2;
  EXPECT_EQ(SearchDistanceOf(settings, 10), 20);
  settings.Correspondence.SearchDistance = 7;
  EXPECT_EQ(SearchDistanceOf(settings, 10), 7);
  EXPECT_EQ(EdgeWindowOf(settings, Fine), 1.5);
  EXPECT_EQ(EdgeWindowOf(settings, Coarse), 3);
}

TEST(SegmentationSettings, LeakControlFollowsTheSeedAndTheVoxels)
{
  EXPECT_EQ(RadiiOf({}, 10, Coarse).Closing, 1.5);
  EXPECT_EQ(RadiiOf({ 3, 0.4 }, 10, Fine).Closing, 2);
  EXPECT_EQ(RadiiOf({}, 5, Coarse).Opening, 2.5);
  EXPECT_EQ(RadiiOf({}, 10, Coarse).Opening, 4);
  EXPECT_EQ(RadiiOf({}, 30, Coarse).Opening, 6);
  EXPECT_EQ(RadiiOf({}, 10, Fine).Opening, 2);
  EXPECT_EQ(RadiiOf({ 0, 0 }, 10, Coarse).Closing, 0);
  EXPECT_EQ(RadiiOf({ 0, 0 }, 10, Coarse).Opening, 0);
}

TEST(SegmentationSettings, LevelsEndByTheMeanDistance)
{
  ScheduleSettings schedule;
  schedule.DistanceTolerance = 0.1;
  schedule.ChangeTolerance = 0.02;
  const double voxel = 2;
  EXPECT_EQ(schedule.ReasonToStop({ 0.19 }, voxel), StopReason::DistanceBelowTolerance);
  EXPECT_EQ(schedule.ReasonToStop({ 0.21 }, voxel), StopReason::NotRun);
  std::vector<double> distances(ScheduleSettings::ChangeSpan, 1);
  EXPECT_EQ(schedule.ReasonToStop(distances, voxel), StopReason::NotRun);
  distances.push_back(0.95);
  EXPECT_EQ(schedule.ReasonToStop(distances, voxel), StopReason::NotRun);
  distances.back() = 0.97;
  EXPECT_EQ(schedule.ReasonToStop(distances, voxel), StopReason::Converged);
  distances.back() = 2;
  EXPECT_EQ(schedule.ReasonToStop(distances, voxel), StopReason::Converged);
  schedule.ChangeTolerance = -1;
  EXPECT_EQ(schedule.ReasonToStop(distances, voxel), StopReason::NotRun);
}

TEST(SegmentationSettings, LevelsBeginWithTwoVerticesAlongAnEdge)
{
  const auto expect = [](int resolution, int wanted, int levels, int first)
  {
    ScheduleSettings schedule;
    schedule.Resolution = resolution;
    schedule.Levels = wanted;
    EXPECT_EQ(schedule.NumberOfLevels(), levels) << resolution << ", " << wanted;
    EXPECT_EQ(schedule.FirstResolution(), first) << resolution << ", " << wanted;
  };
  expect(32, 3, 3, 8);
  expect(32, 6, 5, 2);
  expect(10, 6, 3, 2);
  expect(7, 1, 1, 7);
  expect(2, 4, 1, 2);
}

TEST(SegmentationSettings, AGivenSurfaceIsRefinedToAboutTheSpheresVertices)
{
  const auto levels = [](int vertices, int wanted, int resolution)
  {
    ScheduleSettings schedule;
    schedule.Resolution = resolution;
    schedule.Levels = wanted;
    return schedule.From(vertices).NumberOfLevels();
  };
  EXPECT_EQ(levels(6 * 4 * 4, 4, 32), 4); // as the sphere of 4 x 4
  EXPECT_EQ(levels(6 * 8 * 8, 4, 32), 3);
  EXPECT_EQ(levels(6 * 32 * 32, 4, 32), 1); // an earlier result
  EXPECT_EQ(levels(6 * 64 * 64, 4, 32), 1);
  EXPECT_EQ(levels(480, 4, 32), 3); // 7,680 are nearer to 6,144 than 1,920
  EXPECT_EQ(levels(800, 4, 32), 2); // and 3,200 nearer than 12,800
  EXPECT_EQ(levels(480, 2, 32), 2); // never more than wanted
  EXPECT_EQ(levels(480, 4, 64), 4);
  EXPECT_EQ(levels(480, 6, 8), 1);
}

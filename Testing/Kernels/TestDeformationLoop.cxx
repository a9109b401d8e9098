// Two organs that deform under one guard: what belongs to one is nothing to the other.
#include "Deformation/DeformationLoop.h"
#include "Deformation/DeformingOrgan.h"
#include "ExampleMasks.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>
#include <vector>

using namespace FlipFree;

namespace
{

// Two balls, apart from each other.
class DistantBalls
{
public:
  DistantBalls()
  {
    this->Image.Geometry = Grid({ { 80, 40, 40 } }, { 1, 1, 1 });
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, Noise);
    ForEachVoxel(this->Image.Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d place(i, j, k);
        const bool inside = (place - this->Left.Center).norm() < Radius ||
          (place - this->Right.Center).norm() < Radius;
        this->Image.Voxels.push_back(static_cast<float>((inside ? 100 : 0) + normal(random)));
      });
    this->Settings.Schedule.Resolution = 16;
    this->Settings.Schedule.Levels = 2;
    this->Settings.Feature.ReestimateIntensities = false;
    this->Region = std::make_unique<SmoothRegion>(ReaderOf(this->Image.View()),
      this->Image.Geometry, AnisotropicDiffusionSettings{ 5, 3 * Noise }, this->Parallel);
  }

  std::unique_ptr<DeformingOrgan> MakeOrgan(
    const SeedSphere& seed, const OrganSegmentationSettings& settings,
    const ConstraintList& constraints = {},
    const IterationObserver& observer = [](const ContourMesh&, const PointList&,
                                          const CorrespondenceField&, const IterationRecord&) {})
  {
    auto organ =
      std::make_unique<DeformingOrgan>(*this->Region, Noise, seed, settings, this->Parallel);
    EXPECT_TRUE(organ->FindForegroundOfSeed(NeverStop));
    organ->BeginAt(MakeStartSphere(settings.Schedule.FirstResolution(), seed.Center, seed.Radius),
      0, constraints, OutsidePoints::FromTheStart, observer);
    return organ;
  }

  bool Run(std::vector<DeformingSurface*> organs, std::vector<DeformableSurface> fixed = {}) const
  {
    return DeformationLoop(std::move(organs), std::move(fixed), this->Parallel).Run(NeverStop);
  }

  static constexpr double Radius = 13;
  const SeedSphere Left{ { 20, 20, 20 }, 4 };
  const SeedSphere Right{ { 60, 20, 20 }, 4 };
  OrganSegmentationSettings Settings;

private:
  static constexpr double Noise = 4;
  const ParallelFor Parallel = SerialFor; // whom the organs refer to
  FloatImage Image;
  std::unique_ptr<SmoothRegion> Region;
};

} // namespace

// An outside point of the left one may lie in the right one, which passes it when it is refined.
TEST(DeformationLoop, IsHeldByEachOrgansOwnPoints)
{
  DistantBalls balls;
  PointList coarse;
  const auto left = balls.MakeOrgan(balls.Left, balls.Settings);
  const auto right = balls.MakeOrgan(balls.Right, balls.Settings, {},
    [&coarse](const ContourMesh&, const PointList& points, const CorrespondenceField&,
      const IterationRecord& record)
    {
      if (record.Level == 0)
      {
        coarse = points;
      }
    });
  ASSERT_TRUE(balls.Run({ left.get(), right.get() }));
  ConstraintList inTheRight;
  for (const Eigen::RowVector3d vertex : coarse.rowwise())
  {
    const Eigen::Vector3d below =
      balls.Right.Center + 0.99 * (vertex.transpose() - balls.Right.Center);
    inTheRight.push_back({ ConstraintKind::Outside, below, 0 });
  }
  const auto bound = balls.MakeOrgan(balls.Left, balls.Settings, inTheRight);
  const auto other = balls.MakeOrgan(balls.Right, balls.Settings);
  ASSERT_TRUE(balls.Run({ bound.get(), other.get() }));
  EXPECT_EQ(other->GetSurface().Points.rows(), 6 * 16 * 16);
  EXPECT_EQ(other->GetSurface().Points, right->GetSurface().Points);
  EXPECT_EQ(bound->GetSurface().Points, left->GetSurface().Points);
}

// The graver of two reasons: a surface that is nobody's is worse than a coarse one.
TEST(DeformationLoop, StillSaysThatNoBoundaryWasFoundWhereItCannotRefine)
{
  DistantBalls balls;
  OrganSegmentationSettings blind = balls.Settings;
  blind.Targets.Correspondence.SearchDistance = 1;
  blind.Targets.Correspondence.RunLength = 0;
  const auto left = balls.MakeOrgan(balls.Left, blind);
  const auto right = balls.MakeOrgan(balls.Right, balls.Settings);
  // It lies within the right one, from the start, which the refinement refuses.
  const DeformableSurface within = MakeStartSphere(3, balls.Right.Center, 1);
  ASSERT_TRUE(balls.Run({ left.get(), right.get() }, { within }));
  EXPECT_EQ(left->GetSurface().Reason, StopReason::NoBoundaryFound);
  EXPECT_EQ(right->GetSurface().Reason, StopReason::NotRefined);
}

// Points that correct a segmentation: obeyed exactly, whatever their order and history.
#include "Deformation/VolumeSegmentation.h"
#include "Error.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Image/VoxelOffsets.h"
#include "Phantom/PhantomVolume.h"
#include "SurfaceMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace FlipFree;

namespace
{

// A ball of 30 mm, its seed at the center, and what is segmented of it.
class BallSegmenter
{
public:
  BallSegmenter()
  {
    PhantomSettings settings;
    settings.Dimensions = { { 48, 48, 48 } };
    settings.Spacing = { 2, 2, 2 };
    this->Geometry = GridOf(settings);
    const Phantom phantom = PhantomOf(settings, this->Geometry);
    this->Voxels.resize(this->Geometry.NumberOfVoxels());
    std::vector<std::uint8_t> labels(this->Voxels.size());
    SampleTissues(phantom.Tissues, this->Geometry, SamplingOf(settings), this->Voxels.data(),
      labels.data());
    const Ball& start = phantom.Seeds.front().Start;
    this->Seed = { GridToPhysical(this->Geometry, start.Center), start.Radius };
    VolumeSegmentationSettings method;
    method.Method.Schedule.Resolution = 16;
    this->Again = std::make_unique<VolumeSegmenter>(
      GrayVolumeOf(ImageView<std::int16_t>{ this->Voxels.data(), this->Geometry }), "it",
      this->Seed, nullptr, method, Threading());
  }

  OrganSurface Run(const ConstraintList& constraints) const
  {
    return this->Again
      ->Segment(constraints, NeverStop,
        [](const ContourMesh&, const PointList&, const CorrespondenceField&,
          const IterationRecord&) {})
      .Organ;
  }

  std::string MessageOf(const ConstraintList& constraints) const
  {
    try
    {
      this->Run(constraints);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  }

  PointConstraint At(ConstraintKind kind, double x, double y, double z, double radius = 0) const
  {
    return { kind, this->Seed.Center + Eigen::Vector3d(x, y, z), radius };
  }

  SeedSphere Seed;

private:
  ImageGeometry Geometry;
  std::vector<std::int16_t> Voxels;
  std::unique_ptr<VolumeSegmenter> Again;
};

void ExpectObeyed(const OrganSurface& organ, const ConstraintList& constraints)
{
  EXPECT_EQ(organ.SelfIntersections, 0);
  EXPECT_EQ(CountSelfIntersections(organ.Points, organ.Mesh.Faces), 0);
  for (const PointConstraint& constraint : constraints)
  {
    if (constraint.Kind == ConstraintKind::Boundary)
    {
      const SurfacePlace place = ClosestPlace(organ.Points, organ.Mesh.Triangles, constraint.Point);
      EXPECT_LE((place.Point - constraint.Point).norm(), 1) << NameOf(constraint);
    }
    else
    {
      EXPECT_EQ(WindingNumber(organ.Points, organ.Mesh.Triangles, constraint.Point),
        constraint.Kind == ConstraintKind::Outside ? 0 : 1)
        << NameOf(constraint);
    }
  }
}

} // namespace

TEST(Corrections, AreObeyedOneByOneAndTogether)
{
  const BallSegmenter ball;
  const double radius = ball.Seed.Radius;
  const ConstraintList all{ ball.At(ConstraintKind::Inside, 36, 0, 0),
    ball.At(ConstraintKind::Outside, 0, 25, 0), ball.At(ConstraintKind::Boundary, 0, 0, 33),
    ball.At(ConstraintKind::Boundary, 0, 0, -26), ball.At(ConstraintKind::Seed, -33, 0, 0, 4),
    // In the start sphere.
    ball.At(ConstraintKind::Outside, 0, -0.8 * radius, 0) };
  const OrganSurface free = ball.Run({});
  int disobeyed = 0;
  for (const PointConstraint& constraint : all)
  {
    const int winding = WindingNumber(free.Points, free.Mesh.Triangles, constraint.Point);
    disobeyed += winding != (constraint.Kind == ConstraintKind::Outside ? 0 : 1) ? 1 : 0;
    ExpectObeyed(ball.Run({ constraint }), { constraint });
  }
  EXPECT_GE(disobeyed, 4);
  ExpectObeyed(ball.Run(all), all);
}

TEST(Corrections, DependOnTheSetAlone)
{
  const BallSegmenter ball;
  const OrganSurface free = ball.Run({});
  ConstraintList points{ ball.At(ConstraintKind::Inside, 36, 0, 0),
    ball.At(ConstraintKind::Outside, 0, 25, 0), ball.At(ConstraintKind::Boundary, 0, 0, 33) };
  const OrganSurface corrected = ball.Run(points);
  EXPECT_GT((corrected.Points - free.Points).rowwise().norm().maxCoeff(), 2);
  std::reverse(points.begin(), points.end());
  points.push_back(points.front());
  EXPECT_EQ(ball.Run(points).Points, corrected.Points);
  EXPECT_EQ(BallSegmenter().Run(points).Points, corrected.Points);
  EXPECT_EQ(ball.Run({}).Points, free.Points);
}

// Also one after the other. A run with points is to change nothing where they change nothing; only
// where a lobe is added far away, all levels run again.
TEST(Corrections, AreLocal)
{
  const BallSegmenter ball;
  const ConstraintList all{ ball.At(ConstraintKind::Inside, 34, 0, 0),
    ball.At(ConstraintKind::Outside, 0, 26, 0), ball.At(ConstraintKind::Inside, 0, 0, -43),
    ball.At(ConstraintKind::Boundary, -27, 0, 0) };
  OrganSurface former = ball.Run({});
  ConstraintList points;
  for (const PointConstraint& point : all)
  {
    points.push_back(point);
    const OrganSurface corrected = ball.Run(points);
    ExpectObeyed(corrected, points);
    const double most = &point == &all[2] ? 0.1 : 0.02;
    EXPECT_LT(MotionBeyond(point.Point, corrected, former, 100), most) << NameOf(point);
    EXPECT_LT(MotionBeyond(point.Point, former, corrected, 100), most) << NameOf(point);
    former = corrected;
  }
}

// A ball with two brighter lobes on opposite sides, each deep enough for a run of all levels.
// The lobe that a point has added stays as it is when the other one comes, whichever is the first.
TEST(Corrections, OfDeepPlacesFarApartDoNotDisturbEachOther)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 104, 60, 60 } };
  geometry.Spacing.setConstant(2);
  const Eigen::Vector3d center = geometry.ToPhysical(Eigen::Vector3d(52, 30, 30));
  const Eigen::Vector3d side(64, 0, 0);
  std::vector<std::int16_t> voxels(geometry.NumberOfVoxels());
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 4);
  for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    const std::array<int, 3> index = IndexOf(voxel, geometry);
    const Eigen::Vector3d at =
      geometry.ToPhysical(Eigen::Vector3d(index[0], index[1], index[2])) - center;
    const bool isLobe = std::min((at - side).norm(), (at + side).norm()) < 26;
    const bool isOrgan = at.norm() < 48;
    const double value = isOrgan ? 100 : (isLobe ? 150 : 0);
    voxels[voxel] = static_cast<std::int16_t>(std::lround(value + noise(random)));
  }
  VolumeSegmentationSettings method;
  method.Method.Schedule.Resolution = 16;
  const auto segmenter = [&]
  {
    return std::make_unique<VolumeSegmenter>(
      GrayVolumeOf(ImageView<std::int16_t>{ voxels.data(), geometry }), "it",
      SeedSphere{ center, 24 }, nullptr, method, Threading());
  };
  const auto run = [](VolumeSegmenter& with, const ConstraintList& points)
  {
    return with
      .Segment(points, NeverStop,
        [](const ContourMesh&, const PointList&, const CorrespondenceField&,
          const IterationRecord&) {})
      .Organ;
  };
  const PointConstraint left{ ConstraintKind::Inside, center - side, 0 };
  const PointConstraint right{ ConstraintKind::Inside, center + side, 0 };
  const auto kept = segmenter();
  const OrganSurface both = run(*kept, { left, right });
  ExpectObeyed(both, { left, right });
  for (const PointConstraint& one : { left, right })
  {
    const OrganSurface alone = run(*kept, { one });
    ExpectObeyed(alone, { one });
    EXPECT_EQ(WindingNumber(alone.Points, alone.Mesh.Triangles, 2 * center - one.Point), 0);
    const double motion = MeanMotion(both, alone, 500,
      [&](const Eigen::Vector3d& at) { return (at - center).dot(one.Point - center) > 0; });
    EXPECT_LT(motion, 0.5) << NameOf(one); // a quarter of a voxel
  }
  EXPECT_EQ(run(*segmenter(), { right, left }).Points, both.Points);
}

// A ball with a cleft, as a kidney's sinus: a point in it must not hold back the surface around it.
TEST(Corrections, LeaveTheRestOfTheOrganWhereAPointLiesInACleft)
{
  ImageGeometry geometry;
  geometry.Dimensions = { { 48, 48, 48 } };
  geometry.Spacing = { 2, 2, 2 };
  const Eigen::Vector3d center(47, 47, 47);
  std::vector<std::int16_t> voxels(geometry.NumberOfVoxels());
  BitMask organ(geometry);
  for (int k = 0; k < 48; ++k)
  {
    for (int j = 0; j < 48; ++j)
    {
      for (int i = 0; i < 48; ++i)
      {
        const Eigen::Vector3d at = geometry.ToPhysical(Eigen::Vector3d(i, j, k)) - center;
        const bool isCleft = std::abs(at[0]) < 4 && at[1] > 2 && std::abs(at[2]) < 16;
        const bool is = at.norm() < 30 && !isCleft;
        voxels[geometry.Offset(i, j, k)] = static_cast<std::int16_t>(is ? 100 : 0);
        organ.SetRun(is, i, i + 1, j, k);
      }
    }
  }
  VolumeSegmenter segmenter(GrayVolumeOf(ImageView<std::int16_t>{ voxels.data(), geometry }), "it",
    { center - Eigen::Vector3d(0, 14, 0), 9 }, nullptr, {}, Threading());
  const auto scoreOf = [&](const ConstraintList& constraints)
  {
    const VolumeSegmentation result = segmenter.Segment(constraints, NeverStop,
      [](const ContourMesh&, const PointList&, const CorrespondenceField&, const IterationRecord&) {
      });
    ExpectObeyed(result.Organ, constraints);
    BitMask found(geometry);
    found.InsertRuns(result.Voxels);
    BitMask both = found;
    both.Intersect(organ);
    return 2.0 * static_cast<double>(both.Count()) /
      static_cast<double>(found.Count() + organ.Count());
  };
  const double before = scoreOf({});
  EXPECT_GT(before, 0.9);
  const auto at = [&](double x, double y, double z) {
    return PointConstraint{ ConstraintKind::Outside, center + Eigen::Vector3d(x, y, z), 0 };
  };
  EXPECT_GT(scoreOf({ at(3, 4, 10) }), before - 0.005);
  EXPECT_GT(scoreOf({ at(0, 4, 14), at(0, 4, -14), at(0, 10, 0) }), before - 0.008);
}

TEST(Corrections, AreRefusedByName)
{
  const BallSegmenter ball;
  const auto has = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  has(ball.MessageOf({ ball.At(ConstraintKind::Inside, 500, 0, 0) }),
    "mm lies outside it, which spans");
  has(ball.MessageOf(
        { ball.At(ConstraintKind::Inside, 9, 0, 0), ball.At(ConstraintKind::Outside, 9, 0, 0) }),
    "mm are in the same place; remove one of them");
  has(ball.MessageOf({ ball.At(ConstraintKind::Outside, 1, 0, 0) }),
    "lies in the inner half of the seed sphere");
  has(ball.MessageOf({ ball.At(ConstraintKind::Boundary, 1, 0, 0) }),
    "lies in the inner half of the seed sphere");
  has(ball.MessageOf({ ball.At(ConstraintKind::Seed, 9, 0, 0, 0.5) }),
    "has a radius of 0.5 mm, where at least a voxel of it");
  has(ball.MessageOf(
        { ball.At(ConstraintKind::Seed, 32, 0, 0, 5), ball.At(ConstraintKind::Outside, 34, 0, 0) }),
    "lies in the sphere of the further seed at");
  PointConstraint nan = ball.At(ConstraintKind::Inside, 0, 0, 0);
  nan.Point[1] = std::nan("");
  has(ball.MessageOf({ nan }), "is not a place; give three finite numbers");
}

// The first call with points also runs without them, which must not lose the seconds so far: of
// finding and carving the foreground, which the second call does not repeat.
TEST(Corrections, TakeTimeInEachStage)
{
  const BallSegmenter ball;
  const ConstraintList points{ ball.At(ConstraintKind::Inside, 36, 0, 0) };
  const OrganSurface first = ball.Run(points);
  const OrganSurface second = ball.Run(points);
  EXPECT_GT(first.SmoothingSeconds, 0);
  EXPECT_GE(first.FeatureSeconds, 0);
  EXPECT_GE(second.FeatureSeconds, 0);
}

TEST(Corrections, BeginAtTheLargestSeed)
{
  SeedSphere seed{ { 1, 2, 3 }, 5 };
  ConstraintList constraints{ { ConstraintKind::Seed, { 9, 9, 9 }, 4 },
    { ConstraintKind::Seed, { 0, 9, 9 }, 7 }, { ConstraintKind::Inside, { 4, 4, 4 }, 0 },
    { ConstraintKind::Seed, { 0, 8, 9 }, 7 } };
  TakeLargestSeed(seed, constraints);
  EXPECT_EQ(seed.Center, Eigen::Vector3d(0, 8, 9));
  EXPECT_EQ(seed.Radius, 7);
  ASSERT_EQ(constraints.size(), 4u);
  std::vector<double> radii;
  for (const PointConstraint& constraint : constraints)
  {
    radii.push_back(constraint.Radius);
  }
  std::sort(radii.begin(), radii.end());
  EXPECT_EQ(radii, std::vector<double>({ 0, 4, 5, 7 }));
}

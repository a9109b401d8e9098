// By itself, and, as a part of the guard, against brute force over all cuts of small surfaces.
#include "AdverseMotions.h"
#include "BruteForceMotion.h"
#include "ExampleSurfaces.h"
#include "Guard/EmbeddingGuard.h"
#include "Guard/StepLimiter.h"
#include "Mesh/EdgeLength.h"
#include "Mesh/MeshUnion.h"
#include "Vessel/QuadTube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace FlipFree;

namespace
{

constexpr double AnyShear = std::numeric_limits<double>::infinity();
constexpr double NotRounded = 0; // too short an edge for single precision

PointList UnitMotion(Eigen::Index count)
{
  PointList motion = PointList::Zero(count, 3);
  motion.col(1).setOnes();
  return motion;
}

// The parts of unit motions that the limiter leaves.
Eigen::VectorXd ScalesOf(const StepLimiter& step)
{
  return (step.Path().To - step.Path().From).rowwise().norm();
}

// A surface, its guard, and all pairs of its features, with those of obstacles.
struct GuardedScene
{
  GuardedScene(const ContourMesh& mesh, PointList points, PointList obstacles = PointList(0, 3))
    : Mesh(mesh)
    , Points(std::move(points))
    , Obstacles(std::move(obstacles))
    , Edge(TypicalEdgeLength(mesh.Neighbors, this->Points))
    , Guard(mesh)
    , Features(mesh.Faces)
  {
    this->Guard.SetObstacles(this->Obstacles);
    for (int obstacle = 0; obstacle < this->Obstacles.rows(); ++obstacle)
    {
      this->Features.AddPoint(mesh.NumberOfPoints() + obstacle);
    }
  }

  // As EmbeddingGuard promises it.
  double WantedDistance() const { return 1e-3 * this->Edge; }

  double TimeNearerThan(double distance, const PointList& motion) const
  {
    PointList from = this->Points;
    AppendPoints(this->Obstacles, from);
    PointList to = this->Points + motion;
    AppendPoints(this->Obstacles, to);
    return this->Features.TimeNearerThan(distance, from, to);
  }

  GuardReport Limit(PointList& motion) const
  {
    return this->Guard.Limit(this->Points, motion, SerialFor, NeverStop);
  }

  ContourMesh Mesh;
  PointList Points;
  PointList Obstacles;
  double Edge;
  mutable EmbeddingGuard Guard;
  CutFeatures Features;
};

GuardedScene CoarseSphere()
{
  const TestSphere sphere(4);
  return { sphere.Mesh, sphere.Points() };
}

// Bent until its ends face each other.
GuardedScene BentTube()
{
  PointList line(60, 3);
  for (int point = 0; point < 60; ++point)
  {
    const double turn = 4.7 * point / 59;
    line.row(point) << 20 * std::cos(turn), 20 * std::sin(turn), 0;
  }
  const QuadTube tube =
    MakeQuadTube(line, Eigen::VectorXd::Constant(60, 6), 2, "the line", SerialFor);
  return { BuildContourMesh(static_cast<int>(tube.Points.rows()), tube.Faces), tube.Points };
}

// A millimeter apart.
GuardedScene TwoOrgans()
{
  const auto organ = [](double x)
  { return MakeQuadSphere(3, Eigen::Vector3d(x, 0, 0), 12, QuadSphereSpacing::Equiangular); };
  const QuadSphere one = organ(0);
  PointList points = one.Points;
  AppendPoints(organ(25).Points, points);
  const ContourMesh part = BuildContourMesh(static_cast<int>(one.Points.rows()), one.Faces);
  ContourMesh mesh = part;
  AppendMesh(part, mesh);
  return { mesh, points };
}

// Points inside and outside.
GuardedScene SphereAmongObstacles()
{
  const TestSphere sphere(3);
  const Eigen::RowVector3d center = sphere.Points().colwise().mean();
  PointList obstacles(12, 3);
  for (int index = 0; index < obstacles.rows(); ++index)
  {
    const double height = (index + 0.5) / 6 - 1;
    const double radius = std::sqrt(1 - height * height);
    const Eigen::RowVector3d direction(radius * std::cos(2.4 * index),
      radius * std::sin(2.4 * index), height);
    obstacles.row(index) = center + (index % 2 == 0 ? 19 : 27) * direction;
  }
  return { sphere.Mesh, sphere.Points(), obstacles };
}

// Every vertex goes a part of its way.
void ExpectPartsOf(const PointList& wanted, const PointList& motion)
{
  for (Eigen::Index vertex = 0; vertex < wanted.rows(); ++vertex)
  {
    const Eigen::RowVector3d direction = wanted.row(vertex).stableNormalized();
    const double along = motion.row(vertex).dot(direction);
    // Ends are rounded to single precision.
    EXPECT_LT((motion.row(vertex) - along * direction).norm(), 1e-4) << vertex;
    EXPECT_GE(along, -1e-4) << vertex;
    EXPECT_LE(along, wanted.row(vertex).stableNorm() + 1e-4) << vertex;
  }
}

void ExpectSafe(const GuardedScene& scene, const PointList& motion)
{
  EXPECT_EQ(scene.TimeNearerThan(0.999 * scene.WantedDistance(), motion), Never);
  EXPECT_EQ(TimeOfLostShape(scene.Mesh, scene.Points, scene.Points + motion), Never);
}

void ExpectAdverseMotionsMadeSafe(const GuardedScene& scene, std::uint32_t seed)
{
  std::mt19937 random(seed);
  ASSERT_EQ(scene.TimeNearerThan(scene.WantedDistance(), 0 * scene.Points), Never);
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    const PointList wanted = AdverseMotion(kind, scene.Edge, scene.Points, random);
    PointList motion = wanted;
    scene.Limit(motion);
    EXPECT_FALSE(motion.isZero(0)) << AdverseMotionNames[kind];
    ExpectPartsOf(wanted, motion);
    ExpectSafe(scene, motion);
    ASSERT_FALSE(::testing::Test::HasFailure()) << AdverseMotionNames[kind];
  }
}

// How far motions can go, in brute force's view: those that end before are left as they are, and
// those that go so far are not. Some end by a contact, others by a lost shape.
void ExpectLimitsOfBruteForce(const GuardedScene& scene, std::uint32_t seed, int leastContacts)
{
  std::mt19937 random(seed);
  int held = 0;
  int contacts = 0;
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    // Smooth and rough, so that now a shape ends the motion, now a contact.
    const PointList toward = (-scene.Points).rowwise() + Eigen::RowVector3d(scene.Points.row(0));
    const PointList wanted = WhiteNoise(scene.Points.rows(), scene.Edge, random) +
      static_cast<double>(repeat % 3) * toward * Eigen::DiagonalMatrix<double, 3>(1, 0.3, 0.1);
    const double shape = TimeOfLostShape(scene.Mesh, scene.Points, scene.Points + wanted, 1024);
    const double contact = scene.TimeNearerThan(0.9 * scene.WantedDistance(), wanted);
    const double before =
      std::min(shape, scene.TimeNearerThan(4 * scene.WantedDistance(), wanted)) - 1.0 / 256;
    const double after = std::min(shape, contact);
    ASSERT_LE(after, 1) << repeat;
    contacts += contact < shape ? 1 : 0;
    PointList shorter = before * wanted;
    held += scene.Limit(shorter).Guarded > 0 ? 1 : 0;
    PointList longer = after * wanted;
    EXPECT_GT(scene.Limit(longer).Guarded, 0) << repeat;
  }
  EXPECT_LE(held, 1);
  EXPECT_GE(contacts, leastContacts);
}

} // namespace

TEST(StepLimiter, KeepsAPartOfTheMotionUpToTheImpact)
{
  const TestSphere sphere(2);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::array<std::array<double, 2>, 9> expected{ { { none, 0.12 }, { -1, 0.12 }, { 0, 0.12 },
    { 0.1, 0.12 }, { 0.2, 0.18 }, { 0.4, 0.36 }, { 0.55, 0.495 }, { 0.6, 0.5 }, { 0.999, 0.5 } } };
  for (const auto& [time, scale] : expected)
  {
    StepLimiter step(sphere.Points(), UnitMotion(24), sphere.Mesh.Neighbors, AnyShear, NotRounded);
    EXPECT_TRUE(step.IsClean());
    step.Limit(std::array<int, 2>{ { 7, 3 } }, 0.8);
    step.Limit(std::array<int, 1>{ { 7 } }, time);
    step.Limit(std::array<int, 1>{ { 7 } }, 0.9);
    EXPECT_FALSE(step.IsClean());
    EXPECT_EQ(step.ScaleDown(), (std::vector<int>{ 3, 7 }));
    EXPECT_TRUE(step.IsClean());
    Eigen::VectorXd scales = Eigen::VectorXd::Ones(24);
    scales[3] = 0.5;
    scales[7] = std::isnan(time) ? 0.12 : std::min(scale, 0.5);
    EXPECT_TRUE(ScalesOf(step).isApprox(scales, 1e-12)) << time;
    std::vector<char> scaled(24, 0);
    scaled[3] = scaled[7] = 1;
    EXPECT_EQ(step.IsScaled(), scaled);
  }
}

// Whatever fails, however late: the bound by which the passes end.
TEST(StepLimiter, RestsAfterSevenFailures)
{
  const TestSphere sphere(2);
  StepLimiter step(sphere.Points(), UnitMotion(24), sphere.Mesh.Neighbors, AnyShear, NotRounded);
  for (int failure = 1; failure <= 7; ++failure)
  {
    EXPECT_FALSE(step.Path().IsAtRest(5)) << failure;
    step.Limit(std::array<int, 1>{ { 5 } }, 0.99);
    step.ScaleDown();
  }
  EXPECT_TRUE(step.Path().IsAtRest(5));
  EXPECT_FALSE(step.Path().IsAtRest(4));
  // One at rest is not limited any more.
  step.Limit(std::array<int, 1>{ { 5 } }, 0);
  EXPECT_TRUE(step.ScaleDown().empty());
}

// From the definition: no scale is above another by more than the shear allows along any path.
TEST(StepLimiter, ScalesChangeGraduallyAmongNeighbors)
{
  std::mt19937 random(1);
  const TestSphere sphere(6);
  const int count = sphere.Mesh.NumberOfPoints();
  const double shear = 0.3;
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    const PointList wanted = WhiteNoise(count, 2, random);
    StepLimiter step(sphere.Points(), wanted, sphere.Mesh.Neighbors, shear, NotRounded);
    Eigen::VectorXd expected = Eigen::VectorXd::Ones(count);
    for (int limited = 0; limited < 3; ++limited)
    {
      const int vertex = std::uniform_int_distribution<int>(0, count - 1)(random);
      step.Limit(std::array<int, 1>{ { vertex } }, 0.2);
      expected[vertex] = 0.18;
    }
    for (int round = 0; round < count; ++round)
    {
      for (int vertex = 0; vertex < count; ++vertex)
      {
        for (const int neighbor : sphere.Mesh.Neighbors[vertex])
        {
          expected[vertex] =
            std::min(expected[vertex], expected[neighbor] + shear / wanted.row(vertex).norm());
        }
      }
    }
    const std::vector<int> changed = step.ScaleDown();
    std::vector<int> lowered;
    for (int vertex = 0; vertex < count; ++vertex)
    {
      const Eigen::RowVector3d to =
        sphere.Points().row(vertex) + expected[vertex] * wanted.row(vertex);
      EXPECT_LT((step.Path().To.row(vertex) - to).norm(), 1e-12);
      if (expected[vertex] < 1)
      {
        lowered.push_back(vertex);
      }
    }
    EXPECT_EQ(changed, lowered);
    EXPECT_GT(lowered.size(), 6u);
  }
}

// What comes later changes nothing, what comes earlier does, so that the order of tests that may
// end then does not matter.
TEST(StepLimiter, LatestUsefulTimeIsWhereTimesBeginToMatter)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  const TestSphere sphere(2);
  const Hull one{ { 0, 1, 2, 3 } };
  const Hull two{ { 4, 5, 6, 6 } };
  int useless = 0;
  int useful = 0;
  for (int repeat = 0; repeat < 400; ++repeat)
  {
    const auto endOf = [&](std::uint32_t seed, double extraTime)
    {
      std::mt19937 again(seed);
      StepLimiter step(sphere.Points(), UnitMotion(24), sphere.Mesh.Neighbors, AnyShear,
        NotRounded);
      const double longest = uniform(again);
      for (int vertex = 0; vertex < 7; ++vertex)
      {
        if (uniform(again) < 0.95)
        {
          step.Limit(std::array<int, 1>{ { vertex } }, longest * uniform(again));
        }
      }
      const double latest = step.LatestUsefulTime(one, two);
      if (extraTime != 0)
      {
        step.Limit(one, latest + extraTime);
        step.Limit(two, latest + extraTime);
      }
      step.ScaleDown();
      return std::make_pair(latest, step.Path().To);
    };
    const std::uint32_t seed = random();
    const auto [latest, to] = endOf(seed, 0);
    EXPECT_TRUE(latest >= 0 && latest <= 1);
    if (latest < 1)
    {
      EXPECT_EQ(endOf(seed, 1e-9).second, to);
      EXPECT_EQ(endOf(seed, 0.3).second, to);
      ++useless;
    }
    if (latest > 0)
    {
      EXPECT_NE(endOf(seed, -1e-3).second, to) << latest;
      ++useful;
    }
  }
  EXPECT_GT(useless, 100);
  EXPECT_GT(useful, 100);
}

TEST(StepLimiter, NothingIsUsefulToWhatRests)
{
  const TestSphere sphere(2);
  StepLimiter step(sphere.Points(), UnitMotion(24), sphere.Mesh.Neighbors, AnyShear, NotRounded);
  const Hull one{ { 0, 1, 2, 3 } };
  const Hull two{ { 4, 5, 6, 7 } };
  for (int failure = 0; failure < 7; ++failure)
  {
    EXPECT_EQ(step.LatestUsefulTime(one, two), 1);
    step.Limit(one, 0.99);
    EXPECT_EQ(step.LatestUsefulTime(one, two), 1); // the other has not been limited
    step.Limit(two, 0.99);
    EXPECT_LT(step.LatestUsefulTime(one, two), 1);
    step.ScaleDown();
  }
  EXPECT_EQ(step.LatestUsefulTime(one, two), 0);
}

TEST(GuardAgainstBruteForce, NothingMeetsOnASphere)
{
  ExpectAdverseMotionsMadeSafe(CoarseSphere(), 3);
}

TEST(GuardAgainstBruteForce, NothingMeetsOnATube)
{
  ExpectAdverseMotionsMadeSafe(BentTube(), 4);
}

TEST(GuardAgainstBruteForce, TwoOrgansDoNotMeet)
{
  ExpectAdverseMotionsMadeSafe(TwoOrgans(), 5);
}

TEST(GuardAgainstBruteForce, ObstaclesAreNotMet)
{
  ExpectAdverseMotionsMadeSafe(SphereAmongObstacles(), 6);
}

TEST(GuardAgainstBruteForce, LimitsOnASphere)
{
  ExpectLimitsOfBruteForce(CoarseSphere(), 7, 0);
}

TEST(GuardAgainstBruteForce, LimitsOfTwoOrgans)
{
  ExpectLimitsOfBruteForce(TwoOrgans(), 8, 2);
}

TEST(GuardAgainstBruteForce, LimitsAmongObstacles)
{
  ExpectLimitsOfBruteForce(SphereAmongObstacles(), 9, 10);
}

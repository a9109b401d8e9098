// Organs of equal gray value that touch, segmented together: their surfaces never meet.
#include "Deformation/OrganGroup.h"
#include "Error.h"
#include "ExampleMasks.h"
#include "Geometry/SelfIntersection.h"
#include "Geometry/WindingNumber.h"
#include "Mesh/MeshUnion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <string>

using namespace FlipFree;

namespace
{

const auto Ignore = [](std::size_t, const ContourMesh&, const PointList&,
                      const CorrespondenceField&, const IterationRecord&) {};

// Two balls of one gray value that overlap a little: an eight. The plane between them is no edge.
class TouchingBalls
{
public:
  TouchingBalls()
    : Geometry(Grid({ { 62, 38, 38 } }, { 2, 2, 2 }))
  {
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, 6);
    ForEachVoxel(this->Geometry,
      [&](int i, int j, int k)
      {
        const Eigen::Vector3d place = this->Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
        const bool inside = (place - this->Left.Center).norm() < Radius ||
          (place - this->Right.Center).norm() < Radius;
        this->Voxels.push_back(static_cast<float>((inside ? 100 : 0) + normal(random)));
      });
  }

  GrayVolume Gray() const
  {
    return GrayVolumeOf(ImageView<float>{ this->Voxels.data(), this->Geometry });
  }

  static VolumeSegmentationSettings Coarse()
  {
    VolumeSegmentationSettings settings;
    settings.Method.Schedule.Resolution = 16;
    return settings;
  }

  void SetAt(const Eigen::Vector3d& place, float value)
  {
    const auto [i, j, k] = NearestVoxel(this->Geometry, place);
    this->Voxels[this->Geometry.Offset(i, j, k)] = value;
  }

  std::vector<SeededOrgan> Organs() const
  {
    return { { "left", this->Left }, { "right", this->Right } };
  }

  std::vector<VolumeSegmentation> Run(const std::vector<SeededOrgan>& organs,
    const std::vector<ConstraintList>& constraints = { {}, {} },
    const std::vector<FixedSurface>& fixed = {}, const Monitor& monitor = NeverStop) const
  {
    OrganGroup group(this->Gray(), "it", organs, fixed, Coarse(), {});
    return group.Segment(constraints, monitor, Ignore);
  }

  std::string MessageOf(const std::vector<SeededOrgan>& organs,
    const std::vector<ConstraintList>& constraints = { {}, {} },
    const std::vector<FixedSurface>& fixed = {}) const
  {
    try
    {
      this->Run(organs, constraints, fixed);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "";
  }

  static constexpr double Radius = 22;
  const ImageGeometry Geometry;
  const SeedSphere Left{ { 38, 37, 37 }, 11 };
  const SeedSphere Right{ { 80, 37, 37 }, 10 };

private:
  std::vector<float> Voxels;
};

// Exact, of surfaces one beside the other.
std::ptrdiff_t CountContacts(const std::vector<const OrganSurface*>& organs,
  const std::vector<FixedSurface>& fixed = {})
{
  ContourMesh mesh;
  PointList points(0, 3);
  for (const OrganSurface* organ : organs)
  {
    AppendMesh(organ->Mesh, mesh);
    AppendPoints(organ->Points, points);
  }
  for (const FixedSurface& surface : fixed)
  {
    AppendMesh(surface.Surface.Mesh, mesh);
    AppendPoints(surface.Surface.Points, points);
  }
  return CountSelfIntersections(points, mesh.Faces);
}

std::size_t CountCommon(const std::vector<VoxelRun>& one, const std::vector<VoxelRun>& two,
  const ImageGeometry& geometry)
{
  std::vector<int> voxels(geometry.NumberOfVoxels(), 0);
  FillRuns(one, 1, geometry, voxels.data());
  std::size_t common = 0;
  for (const VoxelRun& run : two)
  {
    for (int i = run.Begin; i < run.End; ++i)
    {
      common += voxels[geometry.Offset(i, run.J, run.K)];
    }
  }
  return common;
}

// Of the voxels and a ball, cut where the other ball begins.
double DiceOf(const TouchingBalls& balls, const std::vector<VoxelRun>& runs, bool left)
{
  std::vector<int> voxels(balls.Geometry.NumberOfVoxels(), 0);
  FillRuns(runs, 1, balls.Geometry, voxels.data());
  double both = 0;
  double sum = 0;
  ForEachVoxel(balls.Geometry,
    [&](int i, int j, int k)
    {
      const Eigen::Vector3d place = balls.Geometry.ToPhysical(Eigen::Vector3d(i, j, k));
      const SeedSphere& own = left ? balls.Left : balls.Right;
      const SeedSphere& other = left ? balls.Right : balls.Left;
      const double away = (place - own.Center).norm();
      const bool inside = away < TouchingBalls::Radius && away < (place - other.Center).norm();
      const int found = voxels[balls.Geometry.Offset(i, j, k)];
      both += inside ? 2 * found : 0;
      sum += found + (inside ? 1 : 0);
    });
  return both / sum;
}

} // namespace

TEST(OrganGroup, OfTouchingOrgansOfOneGrayValue)
{
  const TouchingBalls balls;
  const std::vector<VolumeSegmentation> organs = balls.Run(balls.Organs());
  ASSERT_EQ(organs.size(), 2u);
  EXPECT_EQ(CountContacts({ &organs[0].Organ, &organs[1].Organ }), 0);
  EXPECT_EQ(CountCommon(organs[0].Voxels, organs[1].Voxels, balls.Geometry), 0u);
  EXPECT_GT(DiceOf(balls, organs[0].Voxels, true), 0.95);
  EXPECT_GT(DiceOf(balls, organs[1].Voxels, false), 0.95);
  // They come close: what keeps them apart was needed.
  double nearest = 1e9;
  for (const auto& point : organs[0].Organ.Points.rowwise())
  {
    const Eigen::Vector3d at = point.transpose();
    const SurfacePlace place =
      ClosestPlace(organs[1].Organ.Points, organs[1].Organ.Mesh.Triangles, at);
    nearest = std::min(nearest, (place.Point - at).norm());
  }
  EXPECT_LT(nearest, 2);
  for (const VolumeSegmentation& organ : organs)
  {
    EXPECT_EQ(organ.Organ.SelfIntersections, 0);
    EXPECT_EQ(organ.Organ.Mesh.NumberOfPoints(), 6 * 16 * 16);
    EXPECT_EQ(organ.Confidence.OfVertices.size(), 6u * 16 * 16);
    EXPECT_GT(organ.Organ.Iterations.back().Level, 2);
  }
}

TEST(OrganGroup, DoesNotDependOnTheOrder)
{
  const TouchingBalls balls;
  const std::vector<VolumeSegmentation> organs = balls.Run(balls.Organs());
  const std::vector<VolumeSegmentation> turned =
    balls.Run({ { "right", balls.Right }, { "left", balls.Left } });
  EXPECT_EQ(organs[0].Organ.Points, turned[1].Organ.Points);
  EXPECT_EQ(organs[1].Organ.Points, turned[0].Organ.Points);
  // And not on what was asked before.
  OrganGroup group(balls.Gray(), "it", balls.Organs(), {}, TouchingBalls::Coarse(), {});
  const ConstraintList point{ { ConstraintKind::Outside, { 38, 55, 37 }, 0 } };
  const auto corrected = group.Segment({ point, {} }, NeverStop, Ignore);
  EXPECT_NE(corrected[0].Organ.Points, organs[0].Organ.Points);
  EXPECT_EQ(group.Segment({ {}, {} }, NeverStop, Ignore)[0].Organ.Points, organs[0].Organ.Points);
}

TEST(OrganGroup, OfOneIsTheOrganAlone)
{
  const TouchingBalls balls;
  const VolumeSegmentation alone =
    VolumeSegmenter(balls.Gray(), "it", balls.Left, nullptr, TouchingBalls::Coarse(), {})
      .Segment({}, NeverStop,
        [](const ContourMesh&, const PointList&, const CorrespondenceField&,
          const IterationRecord&) {});
  const std::vector<VolumeSegmentation> group = balls.Run({ { "left", balls.Left } }, { {} });
  EXPECT_EQ(group.front().Organ.Points, alone.Organ.Points);
  EXPECT_EQ(group.front().Organ.Iterations.size(), alone.Organ.Iterations.size());
  EXPECT_EQ(group.front().Confidence.OfVertices, alone.Confidence.OfVertices);
  EXPECT_EQ(group.front().Warnings, alone.Warnings);
}

// What is certain of an organ is the core of its seed (UniformSphere), also where they contend.
TEST(OrganGroup, ASeedThatReachesOutOfItsOrganTakesNothingFromTheOther)
{
  const TouchingBalls balls;
  const SeedSphere large{ balls.Left.Center, 1.6 * TouchingBalls::Radius };
  const SeedSphere small{ balls.Right.Center, 6 };
  const std::vector<VolumeSegmentation> organs =
    balls.Run({ { "left", large }, { "right", small } });
  const std::vector<VolumeSegmentation> expected =
    balls.Run({ { "left", balls.Left }, { "right", small } });
  for (const bool left : { true, false })
  {
    EXPECT_NEAR(DiceOf(balls, organs[left ? 0 : 1].Voxels, left),
      DiceOf(balls, expected[left ? 0 : 1].Voxels, left), 0.02);
  }
}

// The points of one organ are outside the other, from the start, and each obeys its own.
TEST(OrganGroup, ObeysPoints)
{
  const TouchingBalls balls;
  const Eigen::Vector3d beyond(64, 37, 37); // on the right organ's side
  const ConstraintList left{ { ConstraintKind::Inside, beyond, 0 },
    { ConstraintKind::Outside, { 38, 56, 37 }, 0 } };
  const ConstraintList right{ { ConstraintKind::Seed, { 80, 37, 52 }, 4 } };
  const auto organs = balls.Run(balls.Organs(), { left, right });
  const auto windingOf = [&](int organ, const Eigen::Vector3d& point)
  { return WindingNumber(organs[organ].Organ.Points, organs[organ].Organ.Mesh.Triangles, point); };
  EXPECT_EQ(windingOf(0, beyond), 1);
  EXPECT_EQ(windingOf(1, beyond), 0);
  EXPECT_EQ(windingOf(0, left[1].Point), 0);
  EXPECT_EQ(windingOf(1, right[0].Point), 1);
  EXPECT_EQ(windingOf(0, right[0].Point), 0);
  EXPECT_EQ(CountContacts({ &organs[0].Organ, &organs[1].Organ }), 0);
  EXPECT_EQ(CountCommon(organs[0].Voxels, organs[1].Voxels, balls.Geometry), 0u);
}

TEST(OrganGroup, RespectsASurfaceAtRest)
{
  const TouchingBalls balls;
  // As large as the right organ and somewhat to the left of it.
  const std::vector<FixedSurface> fixed{ { "the tumor", MakeStartSphere(7, { 72, 37, 37 }, 17) } };
  const auto organs = balls.Run({ { "left", balls.Left } }, { {} }, fixed);
  EXPECT_EQ(CountContacts({ &organs[0].Organ }, fixed), 0);
  EXPECT_EQ(
    CountCommon(organs[0].Voxels,
      VoxelizeSurface(fixed[0].Surface.Points, fixed[0].Surface.Mesh.Triangles, balls.Geometry),
      balls.Geometry),
    0u);
  EXPECT_GT(DiceOf(balls, organs[0].Voxels, true), 0.9);
}

TEST(OrganGroup, StopsWheneverItIsTold)
{
  const TouchingBalls balls;
  int questions = 0;
  double last = 0;
  balls.Run(balls.Organs(), { {}, {} }, {},
    [&](double fraction)
    {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      return ++questions > 0;
    });
  ASSERT_GT(questions, 40);
  for (const int stop : { 1, questions / 4, questions / 2, 3 * questions / 4, questions })
  {
    int asked = 0;
    const auto organs =
      balls.Run(balls.Organs(), { {}, {} }, {}, [&](double) { return ++asked < stop; });
    EXPECT_EQ(asked, stop);
    for (const VolumeSegmentation& organ : organs)
    {
      EXPECT_EQ(organ.Organ.Reason, StopReason::Aborted) << stop;
      EXPECT_TRUE(organ.Voxels.empty());
    }
  }
}

TEST(OrganGroup, StartsAgainAfterAnAbort)
{
  const TouchingBalls balls;
  VolumeSegmentationSettings brief = TouchingBalls::Coarse();
  brief.Method.Schedule.Resolution = 8;
  brief.Method.Schedule.MaximumIterations = 3;
  const auto make = [&]
  {
    return std::make_unique<OrganGroup>(balls.Gray(), "it", balls.Organs(),
      std::vector<FixedSurface>(), brief, Threading());
  };
  int questions = 0;
  const std::vector<VolumeSegmentation> expected = make()->Segment(
    { {}, {} }, [&questions](double) { return ++questions > 0; }, Ignore);
  for (const int stop : { 1, questions / 4, questions / 2, questions })
  {
    const auto group = make();
    int asked = 0;
    group->Segment(
      { {}, {} }, [&asked, stop](double) { return ++asked < stop; }, Ignore);
    ASSERT_EQ(asked, stop);
    const std::vector<VolumeSegmentation> again = group->Segment({ {}, {} }, NeverStop, Ignore);
    EXPECT_EQ(again[0].Organ.Points, expected[0].Organ.Points) << stop;
    EXPECT_EQ(again[1].Organ.Points, expected[1].Organ.Points) << stop;
  }
}

// What goes wrong with one of them says with which.
TEST(OrganGroup, NamesTheOrganOfAnError)
{
  const auto startsWith = [](const std::string& message, const std::string& part)
  { EXPECT_EQ(message.substr(0, part.size()), part); };
  TouchingBalls broken;
  broken.SetAt({ 38, 37, 45 }, std::numeric_limits<float>::quiet_NaN());
  startsWith(broken.MessageOf(broken.Organs()),
    "'left': the seed sphere touches a voxel without data");
  const TouchingBalls balls;
  const auto messageOf =
    [&](const VolumeSegmentationSettings& settings, const std::vector<ConstraintList>& points)
  {
    OrganGroup group(balls.Gray(), "it", balls.Organs(), {}, settings, {});
    try
    {
      group.Segment(points, NeverStop, Ignore);
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  // An inside point in a cage of outside points.
  const Eigen::Vector3d place(8, 37, 37);
  ConstraintList cage{ { ConstraintKind::Inside, place, 0 } };
  for (int point = 0; point < 27; ++point)
  {
    const Eigen::Vector3d away(point % 3 - 1, point / 3 % 3 - 1, point / 9 - 1);
    if (point != 13)
    {
      cage.push_back({ ConstraintKind::Outside, place + 1.5 * away, 0 });
    }
  }
  VolumeSegmentationSettings brief = TouchingBalls::Coarse();
  brief.Method.Schedule.Resolution = 8;
  brief.Method.Schedule.MaximumIterations = 3;
  startsWith(messageOf(brief, { cage, {} }),
    "'left': the inside point (8, 37, 37) mm cannot be obeyed");
  // The start is in the middle of what is known of the other.
  brief.StartCenterOffset = { 0, 14, 0 };
  brief.StartScale = 0.5;
  startsWith(messageOf(brief, { {}, { { ConstraintKind::Inside, { 38, 51, 37 }, 0 } } }),
    "'left': the inside point (38, 51, 37) mm of 'right', which must lie outside 'left', lies in "
    "the "
    "start surface");
  // One of the organ's own is not taken for another's in the same place, or with the same numbers
  // in messages.
  for (const double z : { 37.0, 37.00001 })
  {
    startsWith(messageOf(brief,
                 { { { ConstraintKind::Outside, { 38, 51, 37 }, 0 } },
                   { { ConstraintKind::Inside, { 38, 51, z }, 0 } } }),
      "'left': the outside point (38, 51, 37) mm lies in the start surface");
  }
}

TEST(OrganGroup, RefusesByName)
{
  const TouchingBalls balls;
  const auto has = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  const SeedSphere wide{ balls.Right.Center, 35 };
  has(balls.MessageOf({}, {}), "there is no organ; give each a name and a seed");
  has(balls.MessageOf({ { "left", balls.Left }, { "left", balls.Right } }),
    "two organs are named 'left'; give each a name of its own");
  has(balls.MessageOf({ { "", balls.Left }, { "right", balls.Right } }), "an organ has no name");
  has(balls.MessageOf({ { "left", balls.Left }, { "right", wide } }),
    "the seeds of 'left' and 'right' overlap: the sphere of 11 mm at (38, 37, 37) mm and the "
    "sphere "
    "of 35 mm at (80, 37, 37) mm; move them apart, or lower a radius");
  has(balls.MessageOf({ { "left", balls.Left }, { "right", { { 500, 0, 0 }, 10 } } }),
    "'right': the seed");
  has(balls.MessageOf(balls.Organs(), { {} }), "there are 1 lists of constraints for 2 organs");
  has(balls.MessageOf(balls.Organs(), { { { ConstraintKind::Inside, { 80, 40, 37 }, 0 } }, {} }),
    "the inside point (80, 40, 37) mm of 'left' lies in the seed of 'right'");
  has(balls.MessageOf(balls.Organs(),
        { { { ConstraintKind::Inside, { 60, 37, 37 }, 0 } },
          { { ConstraintKind::Boundary, { 60, 37, 37 }, 0 } } }),
    "the inside point (60, 37, 37) mm of 'left' and the boundary point (60, 37, 37) mm of 'right' "
    "are "
    "in the same place");
  has(balls.MessageOf(balls.Organs(), { { { ConstraintKind::Seed, { 66, 37, 37 }, 6 } }, {} }),
    "the seeds of 'left' and 'right' overlap");
  has(balls.MessageOf(balls.Organs(), { { { ConstraintKind::Inside, { 500, 37, 37 }, 0 } }, {} }),
    "'left': the inside point (500, 37, 37) mm lies outside it");
  const FixedSurface ball{ "the tumor", MakeStartSphere(5, { 80, 37, 37 }, 12) };
  const FixedSurface small{ "the cyst", MakeStartSphere(5, { 80, 37, 37 }, 3) };
  has(balls.MessageOf(balls.Organs(), { {}, {} }, { ball }),
    "the start sphere of 'right' meets the tumor, which stays as it is");
  has(balls.MessageOf(balls.Organs(), { {}, {} }, { small }),
    "the start sphere of 'right' meets the cyst");
  has(balls.MessageOf({ { "left", balls.Left } }, { {} }, { ball, small }),
    "the tumor and the cyst meet");
  has(balls.MessageOf({ { "left", balls.Left } },
        { { { ConstraintKind::Inside, { 80, 40, 37 }, 0 } } }, { ball }),
    "the inside point (80, 40, 37) mm of 'left' lies in the tumor");
  // The center of a further seed lies outside, its sphere not.
  has(balls.MessageOf({ { "left", balls.Left } },
        { { { ConstraintKind::Seed, { 62, 37, 37 }, 9 } } }, { ball }),
    "a seed of 'left', the sphere of 9 mm at (62, 37, 37) mm, meets the tumor, which stays");
  VolumeSegmentationSettings settings = TouchingBalls::Coarse();
  settings.Method.Step.Guard = false;
  EXPECT_THROW(OrganGroup(balls.Gray(), "it", balls.Organs(), {}, settings, {}), Error);
}

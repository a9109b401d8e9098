// The whole method on a region that is smoothed where it is asked for, against the same on one that
// has been smoothed before: the same surface, bit for bit, and nothing read that was not smoothed.
#include "Deformation/OrganSegmentation.h"
#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Intensity/ModelFit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace FlipFree;

namespace
{

constexpr double Noise = 4;

// An organ in the dark, and where its surface starts from.
struct Scene
{
  /// `gray` of a point, in millimeters, to which noise is added.
  Scene(const ImageGeometry& geometry, const SeedSphere& seed,
    const std::function<double(const Eigen::Vector3d&)>& gray)
    : Seed(seed)
  {
    this->Image.Geometry = geometry;
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, Noise);
    ForEachVoxel(geometry,
      [&](int i, int j, int k)
      {
        const double level = gray(geometry.ToPhysical(Eigen::Vector3d(i, j, k)));
        this->Image.Voxels.push_back(static_cast<float>(level + normal(random)));
      });
    this->Settings.Schedule.MaximumIterations = 12;
    this->Settings.Feature.Leaks = { 0, 0 };
    this->Settings.Targets.Correspondence.SearchDistance = 25;
    this->Settings.Targets.Correspondence.RunLength = 0;
    this->Settings.Targets.Correspondence.ImageBoundaryDistance = 0;
    this->Settings.Targets.Correspondence.EdgeWindow = 0;
    this->Settings.Targets.MaximumDisplacement = 0;
    const QuadSphere sphere =
      MakeQuadSphere(4, seed.Center, seed.Radius, QuadSphereSpacing::Equiangular);
    this->Start = BuildContourMesh(static_cast<int>(sphere.Points.rows()), sphere.Faces);
    this->StartPoints = sphere.Points;
  }

  std::vector<float> Smooth() const
  {
    std::vector<float> smooth(this->Image.Voxels.size());
    DiffuseAnisotropically(ReaderOf(this->Image.View()), this->Image.Geometry, this->Diffusion,
      SerialFor, NeverStop, smooth.data());
    return smooth;
  }

  OrganSurface FromWhole() const
  {
    SmoothRegion region(ReaderOf(this->Image.View()), this->Image.Geometry, this->Diffusion,
      SerialFor);
    region.Make({ { { 0, 0, 0 } }, this->Image.Geometry.Dimensions }, NeverStop);
    return this->Segment(region, SerialFor, NeverStop);
  }

  OrganSurface FromRegion(VoxelBox& made, const Monitor& monitor = NeverStop) const
  {
    SmoothRegion region(ReaderOf(this->Image.View()), this->Image.Geometry, this->Diffusion,
      ScatteredFor);
    // What is not made is not to be looked at: whoever does, goes astray.
    std::fill_n(const_cast<float*>(region.View().Data), this->Image.Voxels.size(),
      std::numeric_limits<float>::quiet_NaN());
    OrganSurface organ = this->Segment(region, ScatteredFor, monitor);
    made = region.GetMade();
    return organ;
  }

  FloatImage Image;
  SeedSphere Seed;
  AnisotropicDiffusionSettings Diffusion{ 5, 2 * std::sqrt(2.0) * Noise };
  OrganSegmentationSettings Settings;
  ContourMesh Start;
  PointList StartPoints;

private:
  OrganSurface Segment(SmoothRegion& region, const ParallelFor& parallelFor,
    const Monitor& monitor) const
  {
    return OrganSegmenter(region, Noise, this->Seed, { this->Start, this->StartPoints },
      this->Settings, parallelFor)
      .FindSurface({}, nullptr, monitor,
        [](const ContourMesh&, const PointList&, const CorrespondenceField&,
          const IterationRecord&) {});
  }
};

Scene BallScene()
{
  const Eigen::Vector3d center(40, 20, 20);
  return { Grid({ { 80, 40, 40 } }, { 1, 1, 1 }), { center, 6 },
    [&](const Eigen::Vector3d& point) { return (point - center).norm() < 13 ? 100.0 : 0.0; } };
}

// Returns what has been smoothed of the region.
VoxelBox ExpectRegionGivesTheSurfaceOfTheWhole(const Scene& scene)
{
  VoxelBox made;
  double last = 0;
  const OrganSurface part = scene.FromRegion(made,
    [&last](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  const OrganSurface whole = scene.FromWhole();
  EXPECT_EQ(part.Reason, whole.Reason);
  EXPECT_EQ(part.Field.States, whole.Field.States);
  const bool asMany = part.Points.rows() == whole.Points.rows();
  EXPECT_TRUE(asMany && part.Points == whole.Points);
  EXPECT_TRUE(asMany && part.Field.Displacements == whole.Field.Displacements);
  EXPECT_EQ(part.Iterations.size(), whole.Iterations.size());
  for (std::size_t row = 0; row < std::min(part.Iterations.size(), whole.Iterations.size()); ++row)
  {
    const TargetReport& found = part.Iterations[row].Targets;
    const TargetReport& expected = whole.Iterations[row].Targets;
    EXPECT_EQ(found.MeanDistance, expected.MeanDistance) << row;
    EXPECT_EQ(found.Matched, expected.Matched) << row;
    EXPECT_EQ(found.Solitary, expected.Solitary) << row;
  }
  EXPECT_EQ(whole.SelfIntersections, 0);
  return made;
}

} // namespace

// It lies far along the rows, and is six seed radii longer than what is smoothed at first.
TEST(OrganSegmentation, OfALongOrganFarAlongTheRows)
{
  const Eigen::Vector3d center(150, 30, 33);
  Scene scene(Grid({ { 260, 60, 46 } }, { 1, 1, 1.5 }), { center, 7 },
    [&](const Eigen::Vector3d& point)
    {
      const Eigen::Vector3d axes(50, 15, 14);
      return (point - center).cwiseQuotient(axes).norm() < 1 ? 100.0 : 0.0;
    });
  for (const double window : { 0.0, 2.0 })
  {
    scene.Settings.Targets.Correspondence.EdgeWindow = window;
    for (const LeakControlSettings& leaks :
      { LeakControlSettings{ 0, 0 }, LeakControlSettings{ 1.5, 3.0 / 7 } })
    {
      scene.Settings.Feature.Leaks = leaks;
      const VoxelBox made = ExpectRegionGivesTheSurfaceOfTheWhole(scene);
      EXPECT_GT(made.Begin[0], 0);
      EXPECT_LT(made.End[0], 250);
      EXPECT_GT(made.Size(0), 3 * 2 * 7 + 50);
    }
  }
}

// A seventh of the seed is not the organ's, and lies farther from it than what is searched when the
// organ is known.
TEST(OrganSegmentation, OfAnOrganAtWhoseRimTheSeedLies)
{
  const SeedSphere seed{ { 113.2, 40, 40 }, 16 };
  const Scene scene(Grid({ { 190, 80, 80 } }, { 1, 1, 1 }), seed,
    [&](const Eigen::Vector3d& point)
    {
      const Eigen::Array3d from = (point - Eigen::Vector3d(96, 40, 40)).array().abs();
      return (from < Eigen::Array3d(26, 20, 22)).all() ? 100.0 : 0.0;
    });
  std::size_t inside = 0;
  const std::vector<std::size_t> voxels = VoxelsInSphere(scene.Image.Geometry, seed);
  for (const std::size_t voxel : voxels)
  {
    inside += scene.Image.Voxels[voxel] > 50;
  }
  EXPECT_LT(inside, 0.88 * static_cast<double>(voxels.size()));
  const VoxelBox made = ExpectRegionGivesTheSurfaceOfTheWhole(scene);
  EXPECT_LT(made.End[0], 190);
}

// It grows brighter along its length. The seed knows little of that; the start surface, which
// hardly moves, holds most of it, so that the second level finds far more than was searched before.
TEST(OrganSegmentation, OfAnOrganThatWidensWhenItsIntensitiesAreKnown)
{
  const Eigen::Vector3d center(140, 25, 25);
  Scene scene(Grid({ { 270, 50, 50 } }, { 1, 1, 1 }), { center, 5 },
    [&](const Eigen::Vector3d& point)
    {
      const double from = std::hypot(point.y() - 25, point.z() - 25);
      const bool inside = from < 14 && std::abs(point.x() - center.x()) < 52;
      return inside ? 100 + 0.5 * (point.x() - center.x()) : 0.0;
    });
  scene.Settings.Schedule.Levels = 2;
  scene.Settings.Schedule.MaximumIterations = 1;
  scene.Settings.Targets.MaximumDisplacement = 0.5;
  scene.Settings.Feature.Intensity.NoiseWidening = 0;
  for (Eigen::Index vertex = 0; vertex < scene.StartPoints.rows(); ++vertex)
  {
    const Eigen::Array3d from = scene.StartPoints.row(vertex).transpose() - center;
    scene.StartPoints.row(vertex) = center + (from * Eigen::Array3d(9.6, 2.4, 2.4)).matrix();
  }
  const std::vector<float> voxels = scene.Smooth();
  const ImageView<float> smooth{ voxels.data(), scene.Image.Geometry };
  IntensityModel model = FitToSeed(smooth, scene.Seed, Noise, scene.Settings.Feature.Intensity);
  const auto lengthOfForeground = [&]
  {
    BitMask foreground;
    FindForeground(smooth, model, scene.Seed, scene.Settings.Feature, SerialFor, NeverStop,
      foreground);
    return foreground.Bounds().Size(0);
  };
  const int first = lengthOfForeground();
  ASSERT_EQ(RefitToSurface(smooth, scene.StartPoints, scene.Start.Triangles, Noise,
              scene.Settings.Feature.Intensity, SerialFor, NeverStop, model),
    Refit::Done);
  EXPECT_GT(lengthOfForeground(), first + 40);

  const VoxelBox made = ExpectRegionGivesTheSurfaceOfTheWhole(scene);
  EXPECT_GT(made.Begin[0], 0);
  EXPECT_LT(made.End[0], 270);
}

TEST(OrganSegmentation, OfOneSlice)
{
  Scene scene(Grid({ { 150, 60, 1 } }, { 1, 1, 3 }), { { 90, 30, 0 }, 6 },
    [](const Eigen::Vector3d& point)
    { return std::hypot(0.5 * (point.x() - 90), point.y() - 30) < 14 ? 100.0 : 0.0; });
  scene.Settings.Targets.Correspondence.ImageBoundaryDistance = 12;
  const VoxelBox made = ExpectRegionGivesTheSurfaceOfTheWhole(scene);
  EXPECT_EQ(made.Size(2), 1);
  EXPECT_LT(made.End[0], 150);
}

// All of it is smoothed, since all that looks like the organ counts.
TEST(OrganSegmentation, WithoutLeakControl)
{
  Scene scene = BallScene();
  scene.Settings.Feature.ControlLeaks = false;
  const VoxelBox made = ExpectRegionGivesTheSurfaceOfTheWhole(scene);
  EXPECT_EQ(made, (VoxelBox{ { { 0, 0, 0 } }, { { 80, 40, 40 } } }));
}

TEST(OrganSegmentation, StopsWheneverItIsTold)
{
  Scene scene = BallScene();
  scene.Settings.Schedule.Levels = 2;
  scene.Settings.Schedule.MaximumIterations = 2;
  VoxelBox made;
  int questions = 0;
  const auto count = [&questions](double) { return ++questions > 0; };
  EXPECT_NE(scene.FromRegion(made, count).Reason, StopReason::Aborted);
  ASSERT_GT(questions, 20);
  for (int stop = 1; stop <= questions; stop += 3)
  {
    int asked = 0;
    const OrganSurface organ = scene.FromRegion(made, [&](double) { return ++asked < stop; });
    EXPECT_EQ(organ.Reason, StopReason::Aborted) << stop;
    EXPECT_EQ(asked, stop);
  }
}

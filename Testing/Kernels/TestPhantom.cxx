#include "ExampleMasks.h"
#include "ExampleSurfaces.h"
#include "Phantom/Phantom.h"
#include "Phantom/ShapeCube.h"
#include "Phantom/VoxelNoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using namespace FlipFree;
using Eigen::Vector3d;

namespace
{

const double Pi = 3.14159265358979324;

// A value breaks the contract if the surface is nearer than it says or if its sign is wrong. Either
// shows as a change of sign within a ball of this radius.
void ExpectBound(const ImplicitShape& shape, double size)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-size, size);
  std::normal_distribution<double> normal;
  int inside = 0;
  for (int trial = 0; trial < 4000; ++trial)
  {
    const Vector3d point(place(random), place(random), place(random));
    const double value = shape(point);
    inside += value < 0;
    for (int step = 0; step < 20; ++step)
    {
      const Vector3d way = Vector3d(normal(random), normal(random), normal(random)).normalized();
      EXPECT_EQ(shape(point + 0.999 * std::abs(value) * way) < 0, value < 0) << point.transpose();
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, 3980);
}

// An exact distance has slope one almost everywhere.
void ExpectDistance(const ImplicitShape& shape, double size)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-size, size);
  const double h = 1e-5;
  int kinks = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Vector3d point(place(random), place(random), place(random));
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = h * Vector3d::Unit(axis);
      gradient[axis] = (shape(point + step) - shape(point - step)) / (2 * h);
    }
    kinks += std::abs(gradient.norm() - 1) > 1e-4;
  }
  EXPECT_LT(kinks, 10);
}

ImageGeometry CubeGrid(int n, double spacing)
{
  return FlipFree::Grid({ { n, n, n } }, { spacing, spacing, spacing });
}

struct Volume
{
  std::vector<std::int16_t> Intensities;
  std::vector<std::uint8_t> Labels;
};

Volume Sample(const Phantom& phantom, const ImageGeometry& grid,
  const SamplingOptions& options = {}, const ParallelFor& parallelFor = SerialFor)
{
  Volume volume;
  volume.Intensities.resize(grid.NumberOfVoxels());
  volume.Labels.resize(grid.NumberOfVoxels());
  EXPECT_TRUE(SampleTissues(phantom.Tissues, grid, options, volume.Intensities.data(),
    volume.Labels.data(), parallelFor));
  return volume;
}

double VolumeByLabel(const Volume& volume, const ImageGeometry& grid)
{
  return std::count(volume.Labels.begin(), volume.Labels.end(), 1) * grid.Spacing.prod();
}

// Contrast 1000, so that rounding to integers does not matter.
double VolumeByGrayValue(const Volume& volume, const ImageGeometry& grid)
{
  return std::accumulate(volume.Intensities.begin(), volume.Intensities.end(), 0.0) / 1000 *
    grid.Spacing.prod();
}

// In units of 1/96 of the extent, as Phantom.h documents the sizes.
double ClosedFormVolume(PlainShape shape)
{
  const auto ball = [](double radius) { return 4 * Pi / 3 * std::pow(radius, 3); };
  switch (shape)
  {
    case PlainShape::Sphere:
      return ball(30);
    case PlainShape::Cube:
      return 52.0 * 52 * 52;
    case PlainShape::Cup:
      // Half a shell, a hollow cylinder, half a torus.
      return (ball(32) - ball(16)) / 2 + Pi * (32 * 32 - 16 * 16) * 24 + Pi * Pi * 24 * 64;
    case PlainShape::UTube:
      // By Pappus, the half torus is as long as its middle; two legs; two half balls.
      return Pi * 81 * (Pi * 18 + 2 * 30) + ball(9);
    default:
    {
      double length = 0;
      Vector3d last;
      for (int i = 0; i <= 100000; ++i)
      {
        const double t = 2 * i / 100000.0 - 1;
        const Vector3d point(36 * t, 16 * std::sin(Pi * t), 10 * std::cos(0.8 * Pi * t + 0.5));
        length += i ? (point - last).norm() : 0;
        last = point;
      }
      EXPECT_NEAR(length, 105, 3);
      return Pi * 16 * length + ball(4);
    }
  }
}

class PlainPhantom : public ::testing::TestWithParam<PlainShape>
{
};

} // namespace

TEST(ImplicitShape, ValuesAreBoundedByTheDistance)
{
  const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const ImplicitShape ellipsoid = MakeEllipsoid({ 1, 2, 3 }, { 4, 9, 6 }, turned);
  const ImplicitShape tube = MakeTube({ { -9, 0, 0 }, { 0, 5, 3 }, { 9, 0, 0 } }, { 2, 5, 3 });
  const ImplicitShape box = MakeBox({ 3, 0, 0 }, { 4, 5, 8 }, 1.5);
  ExpectBound(ellipsoid, 12);
  ExpectBound(tube, 12);
  ExpectBound(box, 12);
  ExpectBound(MakeEllipticCylinder({ 1, 2 }, { 5, 8 }), 12);
  ExpectBound(
    MakeSplineTube({ { -9, 0, 0 }, { 0, 8, 3 }, { 9, 0, 0 }, { 9, -9, 3 } }, { 2, 3, 1, 2 }), 12);
  ExpectBound(MakeHalfSpace({ 1, 2, 3 }, Vector3d(1, -2, 2) / 3), 12);
  ExpectBound(Unite({ ellipsoid, tube }), 12);
  ExpectBound(SmoothUnite({ ellipsoid, tube, box }, 4), 12);
  ExpectBound(Intersect({ ellipsoid, Complement(tube) }), 12);
  ExpectBound(SmoothIntersect({ box, Complement(tube) }, 2), 12);
}

TEST(ImplicitShape, PrimitivesThatPromiseItGiveTheDistance)
{
  ExpectDistance(MakeSphere({ 1, 2, 3 }, 7), 12);
  ExpectDistance(MakeHalfSpace({ 1, 2, 3 }, Vector3d(1, -2, 2) / 3), 12);
  ExpectDistance(MakeBox({ 1, 0, 0 }, { 4, 5, 8 }, 1), 12);
  ExpectDistance(MakeColumn({ 1, 0 }, { 4, 5 }, 2), 12);
  ExpectDistance(MakeCup({ 0, 1, 0 }, 6, 2, 5), 12);
  ExpectDistance(MakeUTube({ 0, 1, 0 }, 6, 2, 5), 12);
  ExpectDistance(MakeTube({ { -9, 0, 0 }, { 0, 5, 3 }, { 9, 0, 0 } }, { 2, 2, 2 }), 12);
}

TEST(ImplicitShape, SplineTubePassesThroughItsPointsWithTheirRadii)
{
  const std::vector<Vector3d> points = { { -9, 0, 0 }, { 0, 8, 3 }, { 9, 0, 0 }, { 9, -9, 3 } };
  const ImplicitShape tube = MakeSplineTube(points, { 2, 3, 1, 2 });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double radii[] = { 2, 3, 1, 2 };
    EXPECT_NEAR(tube(points[i]), -radii[i], 0.15);
  }
  // Smooth: the spline leaves the chord of the bend, the polyline does not.
  EXPECT_GT((Vector3d(4.5, 4, 1.5) - Vector3d(0, 8, 3)).norm(), 0);
  EXPECT_GT(tube({ 4.5, 4, 1.5 }), -1.99);
  EXPECT_THROW(MakeSplineTube(points, { 1, 1 }), std::invalid_argument);
}

TEST(ImplicitShape, SmoothUnionFillsTheNotchAndNothingElse)
{
  const ImplicitShape a = MakeSphere({ -4, 0, 0 }, 5);
  const ImplicitShape b = MakeSphere({ 4, 0, 0 }, 5);
  const ImplicitShape sharp = Unite({ a, b });
  const ImplicitShape smooth = SmoothUnite({ a, b }, 3);
  const Vector3d notch(0, 3.2, 0);
  EXPECT_GT(sharp(notch), 0);
  EXPECT_LT(smooth(notch), 0);
  const Vector3d far(-9.5, 0, 0);
  EXPECT_DOUBLE_EQ(smooth(far), sharp(far));
}

TEST(ImplicitShape, RefusesSizesThatMakeNoSolid)
{
  EXPECT_THROW(MakeSphere(Vector3d::Zero(), 0), std::invalid_argument);
  EXPECT_THROW(MakeSphere(Vector3d::Zero(), std::nan("")), std::invalid_argument);
  EXPECT_THROW(MakeBox(Vector3d::Zero(), { 1, 1, 1 }, 1), std::invalid_argument);
  EXPECT_THROW(MakeEllipsoid(Vector3d::Zero(), { 1, -1, 1 }), std::invalid_argument);
  EXPECT_THROW(MakeTube({ Vector3d::Zero() }, { 1 }), std::invalid_argument);
  EXPECT_THROW(MakeTube({ { 0, 0, 0 }, { 1, 0, 0 } }, { 1 }), std::invalid_argument);
  EXPECT_THROW(MakeTube({ { 0, 0, 0 }, { 0, 0, 0 } }, { 1, 1 }), std::invalid_argument);
  EXPECT_THROW(MakeCup(Vector3d::Zero(), 2, 2, 1), std::invalid_argument);
  EXPECT_THROW(MakeUTube(Vector3d::Zero(), 1, 2, 1), std::invalid_argument);
  EXPECT_THROW(SmoothUnite({ MakeSphere(Vector3d::Zero(), 1) }, 0), std::invalid_argument);
}

TEST(VoxelNoise, HasMeanStandardDeviationAndCorrelationAsked)
{
  const Eigen::Array3i size(200, 150, 20);
  for (double correlation : { 0.0, 0.3, 0.7 })
  {
    std::vector<float> noise(200 * 150 * 20, 5.0f);
    AddNoise(3, 12, correlation, { -7, 4, 90 }, size, noise.data());
    double sum = 0;
    double squares = 0;
    Vector3d neighbors = Vector3d::Zero();
    Vector3d pairs = Vector3d::Zero();
    const std::array<std::size_t, 3> stride = { { 1, 200, 200 * 150 } };
    ForEachVoxel(Grid({ { 200, 150, 20 } }, { 1, 1, 1 }),
      [&](int i, int j, int k)
      {
        const std::size_t at = i + stride[1] * j + stride[2] * k;
        const double value = noise[at] - 5;
        sum += value;
        squares += value * value;
        const std::array<int, 3> index = { { i, j, k } };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (index[axis] + 1 < size[axis])
          {
            neighbors[axis] += value * (noise[at + stride[axis]] - 5);
            pairs[axis] += 144;
          }
        }
      });
    const double count = static_cast<double>(noise.size());
    EXPECT_NEAR(sum / count, 0, 0.1) << correlation;
    EXPECT_NEAR(std::sqrt(squares / count), 12, 0.1) << correlation;
    EXPECT_NEAR(neighbors[0] / pairs[0], correlation, 0.01);
    EXPECT_NEAR(neighbors[1] / pairs[1], correlation, 0.01);
    EXPECT_NEAR(neighbors[2] / pairs[2], 0, 0.01);
  }
}

TEST(VoxelNoise, DependsOnPlaceNotOnTheBoxThatIsAsked)
{
  std::vector<float> whole(20 * 20 * 2, 0.0f);
  AddNoise(3, 12, 0.3, { 0, 0, 0 }, { 20, 20, 2 }, whole.data());
  std::vector<float> part(5 * 6, 0.0f);
  AddNoise(3, 12, 0.3, { 9, 7, 1 }, { 5, 6, 1 }, part.data());
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 5; ++i)
    {
      EXPECT_EQ(part[i + 5 * j], whole[9 + i + 20 * (7 + j) + 400]);
    }
  }
  std::vector<float> other(5 * 6, 0.0f);
  AddNoise(4, 12, 0.3, { 9, 7, 1 }, { 5, 6, 1 }, other.data());
  EXPECT_NE(part, other);
}

TEST(VoxelNoise, SmoothFieldHasUnitStandardDeviationAndNoSteps)
{
  const SmoothField field(5, 4, { 200, 200, 200 });
  double sum = 0;
  double squares = 0;
  double steepest = 0;
  int count = 0;
  for (double x = -99; x < 99; x += 2.3)
  {
    for (double y = -99; y < 99; y += 2.3)
    {
      for (double z = -99; z < 99; z += 2.3)
      {
        const double value = field({ x, y, z });
        sum += value;
        squares += value * value;
        steepest = std::max(steepest, std::abs(field({ x + 0.01, y, z }) - value) / 0.01);
        ++count;
      }
    }
  }
  EXPECT_NEAR(sum / count, 0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.03);
  // Slope at most 1.5 times the greatest difference of nodes (about 10 deviations) over 4 mm.
  EXPECT_LT(steepest, 1.5 * 10 / 4 / std::pow(26.0 / 35, 1.5));
  EXPECT_TRUE(std::isfinite(field({ 1e4, -1e4, 0 })));
}

TEST(VoxelNoise, RefusesWhatIsNoStandardDeviationOrCorrelation)
{
  EXPECT_THROW(RequireNoise(-1, 0), std::invalid_argument);
  EXPECT_THROW(RequireNoise(std::nan(""), 0), std::invalid_argument);
  EXPECT_THROW(RequireNoise(1, -0.1), std::invalid_argument);
  EXPECT_THROW(RequireNoise(1, 0.71), std::invalid_argument);
  EXPECT_NO_THROW(RequireNoise(0, 0.7));
}

TEST_P(PlainPhantom, VolumeIsThatOfTheClosedFormAndScalesWithTheGrid)
{
  const ImageGeometry grid = CubeGrid(96, 1);
  const Volume volume = Sample(MakePlainPhantom(GetParam(), GridExtent(grid), 1000, 0), grid);
  const double expected = ClosedFormVolume(GetParam());
  EXPECT_NEAR(VolumeByGrayValue(volume, grid) / expected, 1, 0.002);
  EXPECT_NEAR(VolumeByLabel(volume, grid) / expected, 1, 0.01);

  const ImageGeometry other = Grid({ { 60, 100, 40 } }, { 1, 0.6, 1.5 });
  const Volume smaller = Sample(MakePlainPhantom(GetParam(), GridExtent(other), 1000, 0), other);
  EXPECT_NEAR(VolumeByGrayValue(smaller, other) / (expected * std::pow(60.0 / 96, 3)), 1, 0.01);
}

// Brute force: the same rule voxel by voxel, without the hierarchy.
TEST_P(PlainPhantom, HierarchyPaintsWhatEveryVoxelAloneWould)
{
  const ImageGeometry grid = Grid({ { 37, 33, 19 } }, { 1, 1, 2 });
  const Phantom phantom = MakePlainPhantom(GetParam(), GridExtent(grid), 1000, -200);
  const Volume volume = Sample(phantom, grid);
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      const Vector3d center = Vector3d(i - 18, j - 16, 2 * (k - 9));
      const std::size_t at = grid.Offset(i, j, k);
      EXPECT_EQ(volume.Labels[at], phantom.Surface(center) < 0 ? 1 : 0);
      int inside = 0;
      for (int sample = 0; sample < 16; ++sample)
      {
        const Vector3d offset(sample % 2 * 0.5 - 0.25, sample / 2 % 2 * 0.5 - 0.25,
          sample / 4 * 0.5 - 0.75);
        inside += phantom.Surface(center + offset) < 0;
      }
      ASSERT_EQ(volume.Intensities[at], std::lround(-200 + 1200 * inside / 16.0));
    });
}

TEST_P(PlainPhantom, SeedLiesInsideAndTheEnclosingBallIsTight)
{
  const ImageGeometry grid = CubeGrid(96, 1);
  const Phantom phantom = MakePlainPhantom(GetParam(), GridExtent(grid), 100, 0);
  ASSERT_EQ(phantom.Seeds.size(), 1u);
  const Ball seed = phantom.Seeds[0].Start;
  EXPECT_EQ(phantom.Seeds[0].Label, 1);
  EXPECT_GT(seed.Radius, 2.5);
  EXPECT_LE(seed.Radius, -0.7 * phantom.Surface(seed.Center) + 1e-9);

  const Volume volume = Sample(phantom, grid);
  ASSERT_TRUE(phantom.Enclosing.has_value());
  double farthest = 0;
  ForEachVoxel(grid,
    [&](int i, int j, int k)
    {
      if (volume.Labels[grid.Offset(i, j, k)])
      {
        farthest = std::max(farthest,
          (Vector3d(i - 47.5, j - 47.5, k - 47.5) - phantom.Enclosing->Center).norm());
      }
    });
  EXPECT_LT(farthest, phantom.Enclosing->Radius);
  EXPECT_GT(farthest + 1, phantom.Enclosing->Radius / 1.05);
  EXPECT_LT(phantom.Enclosing->Radius, 48);
}

TEST_P(PlainPhantom, PointsAreProjectedOntoTheSurface)
{
  const Phantom phantom = MakePlainPhantom(GetParam(), { 96, 96, 96 }, 100, 0);
  for (const double shift : { -1.0, 0.0, 1.5 })
  {
    const Vector3d step(0.03, 0.02, 0.01);
    // Along a line through the object to its surface.
    Vector3d point = phantom.Seeds[0].Start.Center;
    while (phantom.Surface(point) < shift)
    {
      point += step;
    }
    const Vector3d projected = ProjectOntoSurface(phantom.Surface, point, 1e-4);
    EXPECT_NEAR(phantom.Surface(projected), 0, 1e-6);
    EXPECT_LT((projected - point).norm(), std::abs(shift) + 1);
  }
}

TEST_P(PlainPhantom, IsSampledInACubeThatHoldsItsSurface)
{
  const ImageGeometry grid = CubeGrid(96, 1);
  const Phantom phantom = MakePlainPhantom(GetParam(), GridExtent(grid), 100, 0);
  const ShapeCube cube = CubeAround(*phantom.Enclosing);
  constexpr int size = ShapeCube::Size;
  std::vector<float> values(static_cast<std::size_t>(size) * size * size);
  SampleInCube(phantom.Surface, cube, SerialFor, values.data());
  std::vector<float> scattered(values.size());
  SampleInCube(phantom.Surface, cube, ScatteredFor, scattered.data());
  EXPECT_EQ(scattered, values);
  PointList inside(0, 3);
  for (int sample = 0; sample < size * size * size; sample += 1013)
  {
    const Vector3d index(sample % size, sample / size % size, sample / (size * size));
    const double value = phantom.Surface(cube.First + cube.Step * index);
    EXPECT_EQ(values[sample], static_cast<float>(-value));
    if (std::abs(value) < cube.Step)
    {
      inside.conservativeResize(inside.rows() + 1, 3);
      inside.bottomRows(1) = index.transpose();
    }
  }
  ASSERT_GT(inside.rows(), 0);
  const PointList moved = OntoSurface(phantom.Surface, cube, inside, grid);
  for (Eigen::Index point = 0; point < moved.rows(); ++point)
  {
    const Vector3d index = grid.ToIndex(moved.row(point).transpose());
    EXPECT_NEAR(phantom.Surface(index - Vector3d::Constant(47.5)), 0, 1e-4);
  }
}

TEST_P(PlainPhantom, IsCutInAnyOrderIntoTheSameBits)
{
  const ImageGeometry grid = CubeGrid(70, 1);
  const Phantom phantom = MakePlainPhantom(GetParam(), GridExtent(grid), 100, 0);
  SamplingOptions options;
  options.NoiseStandardDeviation = 20;
  options.NoiseCorrelation = 0.3;
  const Volume serial = Sample(phantom, grid, options);
  const Volume scattered = Sample(phantom, grid, options, ScatteredFor);
  EXPECT_EQ(serial.Intensities, scattered.Intensities);
  EXPECT_EQ(serial.Labels, scattered.Labels);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PlainPhantom,
  ::testing::Values(PlainShape::Sphere, PlainShape::Cube, PlainShape::Cup, PlainShape::UTube,
    PlainShape::Vessel));

TEST(ShapeVolume, WithoutPartialVolumeEveryVoxelHasOneOfTheTwoIntensities)
{
  const ImageGeometry grid = CubeGrid(40, 1);
  const Phantom phantom = MakePlainPhantom(PlainShape::Sphere, GridExtent(grid), 70, -30);
  SamplingOptions options;
  options.PartialVolume = false;
  const Volume volume = Sample(phantom, grid, options);
  for (std::size_t at = 0; at < volume.Labels.size(); ++at)
  {
    ASSERT_EQ(volume.Intensities[at], volume.Labels[at] ? 70 : -30);
  }
}

TEST(ShapeVolume, LaterTissuesHideEarlierOnes)
{
  TissueStack stack;
  stack.Background = { -5, 0, 9 };
  stack.Layers.push_back({ MakeSphere(Vector3d::Zero(), 15), { 10, 0, 1 } });
  stack.Layers.push_back({ MakeSphere(Vector3d::Zero(), 8), { 20, 0, 2 } });
  stack.Layers.push_back({ MakeBox(Vector3d::Zero(), { 7, 5, 2 }), { 30, 0, 3 } });
  const ImageGeometry grid = CubeGrid(41, 1);
  Phantom phantom;
  phantom.Tissues = stack;
  const Volume volume = Sample(phantom, grid);
  const auto at = [&](int x) { return grid.Offset(20 + x, 20, 20); };
  EXPECT_EQ(volume.Labels[at(0)], 3);
  EXPECT_EQ(volume.Intensities[at(0)], 30);
  EXPECT_EQ(volume.Intensities[at(7)], 25); // half 30 and half 20
  EXPECT_EQ(volume.Labels[at(7)], 2);
  EXPECT_EQ(volume.Labels[at(12)], 1);
  EXPECT_EQ(volume.Labels[at(18)], 9);
}

TEST(ShapeVolume, ClampsToTheRangeOfShort)
{
  const ImageGeometry grid = CubeGrid(20, 1);
  const Phantom phantom = MakePlainPhantom(PlainShape::Cube, GridExtent(grid), 1e6, -1e6);
  const Volume volume = Sample(phantom, grid);
  EXPECT_EQ(volume.Intensities[grid.Offset(10, 10, 10)], 32767);
  EXPECT_EQ(volume.Intensities[0], -32768);
}

TEST(ShapeVolume, StopsWhenTheMonitorSaysSo)
{
  const ImageGeometry grid = CubeGrid(64, 1);
  const Phantom phantom = MakePlainPhantom(PlainShape::Cube, GridExtent(grid), 1, 0);
  std::vector<std::int16_t> intensities(grid.NumberOfVoxels());
  std::vector<std::uint8_t> labels(grid.NumberOfVoxels());
  int asked = 0;
  EXPECT_FALSE(SampleTissues(phantom.Tissues, grid, {}, intensities.data(), labels.data(),
    SerialFor, [&](double) { return ++asked < 3; }));
  EXPECT_EQ(asked, 3);
}

TEST(ShapeVolume, RefusesWhatIsNoGridNamingIt)
{
  const auto expectRefusal = [](const std::string& part, const auto& change)
  {
    ImageGeometry grid = CubeGrid(4, 1);
    EXPECT_EQ(ErrorOf([&] { RequireGrid(grid); }), "");
    change(grid);
    const std::string error = ErrorOf([&] { RequireGrid(grid); });
    EXPECT_NE(error.find(part), std::string::npos) << part << " not in: " << error;
  };
  const double nan = std::nan("");
  expectRefusal("dimension of axis 1", [](ImageGeometry& grid) { grid.Dimensions[1] = 0; });
  expectRefusal("2^31", [](ImageGeometry& grid) { grid.Dimensions.fill(2000); });
  expectRefusal("spacing of axis 2", [](ImageGeometry& grid) { grid.Spacing[2] = 0; });
  expectRefusal("spacing of axis 2", [&](ImageGeometry& grid) { grid.Spacing[2] = nan; });
  expectRefusal("origin of axis 0", [&](ImageGeometry& grid) { grid.Origin[0] = nan; });
  expectRefusal("direction matrix",
    [](ImageGeometry& grid) { grid.Direction.col(2) = grid.Direction.col(1); });
}

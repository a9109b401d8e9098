#include "Measures/SurfaceDistance.h"

#include "ExampleSurfaces.h"
#include "Geometry/ClosestDirection.h"
#include "Geometry/DistanceQuery.h"
#include "Measures/SurfaceSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

using namespace FlipFree;

namespace
{

SurfaceDistance Measure(const Surface& first, const Surface& second, double spacing = 1)
{
  return MeasureSurfaceDistance(first.Points, first.Triangles, second.Points, second.Triangles,
    spacing);
}

void ExpectSameBits(const SurfaceDistance& one, const SurfaceDistance& two)
{
  EXPECT_EQ(one.Average, two.Average);
  EXPECT_EQ(one.RootMeanSquare, two.RootMeanSquare);
  EXPECT_EQ(one.Hausdorff95, two.Hausdorff95);
  EXPECT_EQ(one.Hausdorff, two.Hausdorff);
}

double BruteForceDistance(const Eigen::Vector3d& point, const Surface& surface)
{
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
  {
    const auto corner = [&](int which) -> Eigen::Vector3d
    { return surface.Points.row(surface.Triangles(triangle, which)); };
    least = std::min(least,
      ClosestDirection({ { point, point, point, point } },
        { { corner(0), corner(1), corner(2), corner(2) } })
        .norm());
  }
  return least;
}

} // namespace

// Consecutive points that are close together or far apart, in any number; every fourth triangle of
// the soup is a needle or a point.
TEST(DistanceQuery, FindsWhatBruteForceFinds)
{
  Surface soup;
  soup.Points = 10 * PointList::Random(300, 3);
  soup.Triangles.resize(100, 3);
  for (int triangle = 0; triangle < 100; ++triangle)
  {
    soup.Triangles.row(triangle) << 3 * triangle, 3 * triangle + 1, 3 * triangle + 2;
    const auto corner = [&](int which) { return soup.Points.row(3 * triangle + which); };
    if (triangle % 4 == 0)
    {
      corner(1) = triangle % 8 == 0 ? corner(0) : corner(1);
      corner(2) = 0.3 * corner(0) + 0.7 * corner(1);
    }
  }
  for (const Surface& surface : { Potato(7, { 1, 2, 3 }, 10), soup })
  {
    const DistanceQuery query(surface.Points, surface.Triangles);
    for (const double spread : { 20.0, 0.4, 0.01 })
    {
      for (const int size : { 0, 1, 8, 300, 301 })
      {
        const PointList points =
          (spread * PointList::Random(size, 3)).rowwise() + 15 * Eigen::RowVector3d::Random();
        const Eigen::VectorXd distances = query.DistancesOf(points);
        ASSERT_EQ(distances.size(), size);
        for (int point = 0; point < size; ++point)
        {
          const double expected = BruteForceDistance(points.row(point), surface);
          ASSERT_NEAR(distances[point], expected, 1e-12 * (1 + expected));
          // However many points are asked about at once.
          ASSERT_EQ(query.DistancesOf(points.row(point))[0], distances[point]);
        }
      }
    }
  }
}

// Boxes are in single precision, whose steps are much larger far from the origin.
TEST(DistanceQuery, FarPointsAndFarSurfacesAreAsExact)
{
  const Surface potato = Potato(7, { 1, 2, 3 }, 10);
  for (const double offset : { 0.0, 1e3, 1e6 })
  {
    const Eigen::RowVector3d origin(offset, -offset, 0.3 * offset);
    Surface moved = potato;
    moved.Points.rowwise() += origin;
    const DistanceQuery query(moved.Points, moved.Triangles);
    for (const double spread : { 1.0, 20.0, 1e4, 1e7 })
    {
      const PointList points = (spread * PointList::Random(40, 3)).rowwise() + origin;
      const Eigen::VectorXd distances = query.DistancesOf(points);
      for (Eigen::Index point = 0; point < points.rows(); ++point)
      {
        const double expected = BruteForceDistance(points.row(point), moved);
        ASSERT_NEAR(distances[point], expected, 1e-12 * (offset + expected));
      }
    }
  }
}

TEST(DistanceQuery, SortingKeepsEveryTriangle)
{
  const Surface potato = Potato(9, { 1, 2, 3 }, 10);
  const auto listOf = [](const TriangleList& triangles)
  {
    std::vector<std::array<int, 3>> list(triangles.rows());
    Eigen::Map<TriangleList>(list.front().data(), triangles.rows(), 3) = triangles;
    std::sort(list.begin(), list.end());
    return list;
  };
  const TriangleList sorted = DistanceQuery(potato.Points, potato.Triangles).GetSortedTriangles();
  EXPECT_EQ(listOf(sorted), listOf(potato.Triangles));
}

namespace
{

// The centroids of the patches that a triangle is cut into, as the header says.
std::vector<Eigen::Vector3d> SamplesOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c, double spacing)
{
  double median = 0;
  for (const Eigen::Vector3d& side : { Eigen::Vector3d(b + c - 2 * a),
         Eigen::Vector3d(c + a - 2 * b), Eigen::Vector3d(a + b - 2 * c) })
  {
    median = std::max(median, side.norm() / 2);
  }
  const int n = std::max(1, static_cast<int>(std::ceil(2 * median / 3 / spacing)));
  const auto node = [&](int i, int j) -> Eigen::Vector3d
  { return a + (b - a) * i / n + (c - a) * j / n; };
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; i + j < n; ++j)
    {
      samples.emplace_back((node(i, j) + node(i + 1, j) + node(i, j + 1)) / 3);
      if (i + j + 1 < n)
      {
        samples.emplace_back((node(i + 1, j + 1) + node(i + 1, j) + node(i, j + 1)) / 3);
      }
    }
  }
  return samples;
}

void ExpectWhatBruteForceFinds(const std::array<Surface, 2>& surfaces, double spacing)
{
  double area = 0;
  double sum = 0;
  double sumOfSquares = 0;
  double maximum = 0;
  double percentile = 0;
  for (int side = 0; side < 2; ++side)
  {
    const Surface& surface = surfaces[side];
    std::vector<std::pair<double, double>> parts; // distances and their areas
    const auto distanceOf = [&other = surfaces[1 - side]](const Eigen::Vector3d& point)
    { return BruteForceDistance(point, other); };
    for (Eigen::Index triangle = 0; triangle < surface.Triangles.rows(); ++triangle)
    {
      const Eigen::Vector3d a = surface.Points.row(surface.Triangles(triangle, 0));
      const Eigen::Vector3d b = surface.Points.row(surface.Triangles(triangle, 1));
      const Eigen::Vector3d c = surface.Points.row(surface.Triangles(triangle, 2));
      const std::vector<Eigen::Vector3d> samples = SamplesOf(a, b, c, spacing);
      const double patch = (b - a).cross(c - a).norm() / 2 / static_cast<double>(samples.size());
      for (const Eigen::Vector3d& sample : samples)
      {
        const double distance = distanceOf(sample);
        area += patch;
        sum += patch * distance;
        sumOfSquares += patch * distance * distance;
        maximum = std::max(maximum, distance);
        parts.emplace_back(distance, patch);
      }
      for (const Eigen::Vector3d& vertex : { a, b, c })
      {
        maximum = std::max(maximum, distanceOf(vertex));
      }
    }
    std::sort(parts.begin(), parts.end());
    double left = 0.95 *
      std::accumulate(parts.begin(), parts.end(), 0.0,
        [](double whole, const auto& part) { return whole + part.second; });
    auto part = parts.begin();
    for (; left > part->second; ++part)
    {
      left -= part->second;
    }
    percentile = std::max(percentile, part->first);
  }
  const SurfaceDistance distance = Measure(surfaces[0], surfaces[1], spacing);
  EXPECT_NEAR(distance.Average, sum / area, 1e-11);
  EXPECT_NEAR(distance.RootMeanSquare, std::sqrt(sumOfSquares / area), 1e-11);
  EXPECT_NEAR(distance.Hausdorff, maximum, 1e-12);
  EXPECT_NEAR(distance.Hausdorff95, percentile, 1e-12);
}

} // namespace

// One sample per triangle or many; the maximum is that of all vertices too, although only few are
// measured.
TEST(SurfaceDistance, IsWhatBruteForceFinds)
{
  for (const double radius : { 2.5, 3.0, 4.2 })
  {
    for (const double spacing : { 100.0, 0.5, 0.1 })
    {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", spacing " << spacing);
      ExpectWhatBruteForceFinds(
        { { Potato(4, { 1, 2, 3 }, 3), Sphere(3, { 1.3, 2, 2.7 }, radius) } }, spacing);
    }
  }
}

TEST(SurfaceDistance, OfAParallelBoxIsClosedForm)
{
  // The second box lies 1 mm inside the first on all sides. From it, all distances are 1. From the
  // first: 1 over each side's middle, and hypot(1, t) in the rim at t from the middle's border.
  const double size = 20;
  const double middle = size - 2;
  // Integrals over a rim of width 1 of sqrt(1 + t^2) and of 1 + t^2, and over its corners.
  const double rim = (std::sqrt(2.0) + std::asinh(1.0)) / 2;
  double corner = 0;
  const int n = 400;
  for (int sample = 0; sample < n * n; ++sample)
  {
    const double s = (sample % n + 0.5) / n;
    const double t = (sample / n + 0.5) / n; // NOLINT(bugprone-integer-division)
    corner += std::sqrt(1 + s * s + t * t) / (n * n);
  }
  const double areas = 6 * (size * size + middle * middle);
  const double sum = 6 * (2 * middle * middle + 4 * middle * rim + 4 * corner);
  const double sumOfSquares = 6 * (2 * middle * middle + 4 * middle * (4.0 / 3) + 4 * (5.0 / 3));
  const SurfaceDistance distance = Measure(Box({ 0, 0, 0 }, { size, size, size }),
    Box({ 1, 1, 1 }, { size - 1, size - 1, size - 1 }), 0.1);
  EXPECT_NEAR(distance.Average, sum / areas, 1e-4);
  EXPECT_NEAR(distance.RootMeanSquare, std::sqrt(sumOfSquares / areas), 1e-4);
  EXPECT_NEAR(distance.Hausdorff, std::sqrt(3.0), 1e-12);
  // Squares of side middle + 2 t hold 95 % of a side; distances in the rim grow with t.
  const double t95 = (std::sqrt(0.95) * size - middle) / 2;
  EXPECT_NEAR(distance.Hausdorff95, std::sqrt(1 + t95 * t95), 0.02);
}

TEST(SurfaceDistance, IsSymmetricBitForBit)
{
  const Surface first = Potato(12, { 0, 0, 0 }, 20);
  const Surface second = Sphere(9, { 2, 1, 0 }, 21);
  const SurfaceDistance there = Measure(first, second);
  const SurfaceDistance back = Measure(second, first);
  ExpectSameBits(there, back);
  EXPECT_LT(there.Average, there.RootMeanSquare);
  EXPECT_LT(there.RootMeanSquare, there.Hausdorff95);
  EXPECT_LT(there.Hausdorff95, there.Hausdorff);
}

TEST(SurfaceDistance, DoesNotDependOnHowASurfaceIsCutIntoTriangles)
{
  // One wall of the box is cut into a thousand triangles: a mean over vertices would drift to it.
  const Surface coarse = Box({ 0, 0, 0 }, { 20, 20, 20 });
  const Surface other = Box({ 0, 0, 0 }, { 20, 20, 24 });
  const int n = 32;
  Surface fine = coarse;
  const auto vertexAt = [](int i, int j) { return 8 + j * (n + 1) + i; };
  fine.Points.conservativeResize(vertexAt(n, n) + 1, 3);
  fine.Triangles.middleRows(2, 2) = coarse.Triangles.bottomRows(2); // instead of the wall
  fine.Triangles.conservativeResize(10 + 2 * n * n, 3);
  Eigen::Index row = 10;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      fine.Points.row(vertexAt(i, j)) << 20.0 * i / n, 20.0 * j / n, 20;
      if (i < n && j < n)
      {
        fine.Triangles.row(row++) << vertexAt(i, j), vertexAt(i + 1, j), vertexAt(i + 1, j + 1);
        fine.Triangles.row(row++) << vertexAt(i, j), vertexAt(i + 1, j + 1), vertexAt(i, j + 1);
      }
    }
  }
  EXPECT_NEAR(Measure(fine, other, 0.5).Average, Measure(coarse, other, 0.5).Average, 2e-3);
}

TEST(SurfaceDistance, AnyNumberOfThreadsGivesTheSameBits)
{
  const Surface first = Potato(12, { 0, 0, 0 }, 20);
  const Surface second = Sphere(9, { 2, 1, 0 }, 21);
  const SurfaceDistance serial = Measure(first, second);
  double last = 0;
  const SurfaceDistance scattered = MeasureSurfaceDistance(first.Points, first.Triangles,
    second.Points, second.Triangles, 1, ScatteredFor,
    [&last](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  EXPECT_GT(last, 0);
  ExpectSameBits(serial, scattered);
}

// Blocks are counted in samples, however few the triangles.
TEST(SurfaceDistance, AsksTheMonitorWithinATriangle)
{
  const Surface box = Box({ 0, 0, 0 }, { 20, 20, 20 });
  const Surface other = Box({ 1, 1, 1 }, { 19, 19, 19 });
  const double spacing = 0.08;
  int asked = 0;
  const Monitor count = [&asked](double)
  {
    ++asked;
    return true;
  };
  const SurfaceDistance distance = MeasureSurfaceDistance(box.Points, box.Triangles, other.Points,
    other.Triangles, spacing, ScatteredFor, count);
  // Patches have sides of about the spacing.
  EXPECT_GT(asked, 6 * (20 * 20 + 18 * 18) / (spacing * spacing) / (1 << 14));
  const SurfaceDistance serial = Measure(box, other, spacing);
  ExpectSameBits(distance, serial);
}

TEST(SurfaceDistance, StopsWheneverTheMonitorSaysSo)
{
  const Surface potato = Potato(9, { 0, 0, 0 }, 20);
  const Surface sphere = Sphere(9, { 2, 1, 0 }, 21);
  bool isComplete = false;
  int last = 0;
  for (; !isComplete; ++last)
  {
    int asked = 0;
    isComplete = MeasureSurfaceDistance(potato.Points, potato.Triangles, sphere.Points,
      sphere.Triangles, 1, SerialFor,
      [&](double) {
        return asked++ < last;
      }).Complete;
    EXPECT_EQ(asked, isComplete ? last : last + 1);
  }
  EXPECT_GT(last, 20); // not between samples alone
}

// Where surfaces coincide, all vertices are measured: it takes as long as the samples.
TEST(SurfaceDistance, OfASurfaceToItselfStopsNearTheEnd)
{
  const Surface sphere = Sphere(60, { 0, 0, 0 }, 20);
  ASSERT_GT(sphere.Points.rows(), 1 << 14);
  for (const double stop : { 0.455, 0.48, 0.955, 0.98 })
  {
    double last = 0;
    const SurfaceDistance distance = MeasureSurfaceDistance(sphere.Points, sphere.Triangles,
      sphere.Points, sphere.Triangles, 1, SerialFor,
      [&](double fraction)
      {
        last = fraction;
        return fraction < stop;
      });
    EXPECT_FALSE(distance.Complete);
    EXPECT_GE(last, stop);
    EXPECT_LT(last, stop + 0.02);
  }
}

// A surface with one vertex that is meters away is measured in seconds, and the rest of it as
// finely as ever.
TEST(SurfaceDistance, TakesNoMoreSamplesOfATriangleThanSayAnything)
{
  const Surface box = Box({ 0, 0, 0 }, { 10, 20, 30 });
  const auto samplesOf = [](const Surface& surface, double spacing)
  {
    return static_cast<double>(
      SurfaceSamples(surface.Points, surface.Triangles, spacing, "the box").Size());
  };
  EXPECT_NEAR(samplesOf(box, 0.1) / samplesOf(box, 0.2), 4, 0.1);
  EXPECT_EQ(samplesOf(box, 1e-3), 12 * 512 * 512);
  Surface spiked = box;
  spiked.Points.row(0) = Eigen::RowVector3d(-1e7, 0, 0);
  Eigen::Index longer = 0; // triangles
  for (Eigen::Index triangle = 0; triangle < 12; ++triangle)
  {
    longer += (spiked.Triangles.row(triangle).array() == 0).any() ? 1 : 0;
  }
  const SurfaceSamples samples(spiked.Points, spiked.Triangles, 0.2, "the box");
  const SurfaceSamples before(box.Points, box.Triangles, 0.2, "the box");
  EXPECT_LE(samples.Size(), longer * 512 * 512 + before.Size());
  for (Eigen::Index triangle = 0; triangle < 12; ++triangle)
  {
    if (!(spiked.Triangles.row(triangle).array() == 0).any())
    {
      EXPECT_EQ(samples.PatchAreaOf(triangle), before.PatchAreaOf(triangle)) << triangle;
    }
  }
}

TEST(SurfaceDistance, RefusesBadInput)
{
  const Surface box = Box({ 1, 1, 1 }, { 3, 3, 3 });
  const auto errorOf = [](const Surface& first, const Surface& second, double spacing)
  { return ErrorOf([&] { Measure(first, second, spacing); }); };
  EXPECT_EQ(errorOf(box, box, 1), "");
  EXPECT_NE(errorOf(Surface(), box, 1).find("the first surface has no polygons"),
    std::string::npos);
  EXPECT_NE(errorOf(box, Surface(), 1).find("the second surface has no polygons"),
    std::string::npos);
  Surface flat = box;
  flat.Points.setZero();
  EXPECT_NE(errorOf(box, flat, 1).find("no area"), std::string::npos);
  EXPECT_NE(errorOf(box, box, 0).find("sample spacing"), std::string::npos);
  // Each of its triangles has as many samples as any may have.
  const Surface many = Sphere(12, { 2, 2, 2 }, 1);
  EXPECT_NE(errorOf(box, many, 1e-6).find("greater sample spacing"), std::string::npos);
  for (const double scale : { 1e80, 1e200, 1e307 })
  {
    Surface huge = box;
    huge.Points *= scale;
    EXPECT_NE(errorOf(box, huge, 1).find("the second surface is too large"), std::string::npos)
      << scale;
  }
  Surface undefined = box;
  undefined.Points(3, 0) = std::numeric_limits<double>::infinity();
  EXPECT_NE(errorOf(box, undefined, 1).find("point 3 of the second surface"), std::string::npos);
}

// Label maps to surfaces: closed, 2-manifold and embedded for any labels, with the voxels of the
// label map where they are exact.
#include "LabelSurface/LabelCells.h"
#include "LabelSurface/SimpleVoxel.h"

#include "Error.h"
#include "ExampleLabelMaps.h"

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <thread>

using namespace FlipFree;

namespace
{

std::string MessageFor(const LabelMap& map, const std::vector<int>& wanted = {})
{
  try
  {
    MakeLabelGrid(map.View(), wanted, "the label map", SerialFor);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

// The corners that are there, and those that are not, must both be connected. That is so for half
// of all sets.
TEST(LabelSurfaces, KnowsSimpleCells)
{
  int simple = 0;
  for (int corners = 0; corners < 256; ++corners)
  {
    EXPECT_EQ(IsSimple(static_cast<unsigned char>(corners)),
      IsSimple(static_cast<unsigned char>(255 - corners)));
    simple += IsSimple(static_cast<unsigned char>(corners)) ? 1 : 0;
  }
  EXPECT_EQ(simple, 128);
  EXPECT_TRUE(IsSimple(0x0f));  // a side
  EXPECT_FALSE(IsSimple(0x09)); // two opposite corners of a side
  EXPECT_FALSE(IsSimple(0x81)); // two opposite corners
}

TEST(LabelSurfaces, AreValidForAllCells)
{
  for (int corners = 1; corners < 256; ++corners)
  {
    LabelMap map(2, 2, 2);
    for (int corner = 0; corner < 8; ++corner)
    {
      map.Voxels[corner] = corners >> corner & 1;
    }
    for (const int iterations : { 0, 20 })
    {
      SCOPED_TRACE(std::to_string(corners) + ", " + std::to_string(iterations));
      const LabelSurfaces surfaces = SurfacesOf(map, ExactSettings(iterations));
      ExpectManifold(surfaces);
      ExpectEmbedded(surfaces);
      ExpectSameVoxels(map, surfaces);
    }
  }
}

TEST(LabelSurfaces, AreManifoldForAllCellsOfThreeLabels)
{
  for (int code = 0; code < 6561; ++code)
  {
    LabelMap map(2, 2, 2);
    int rest = code;
    for (int& voxel : map.Voxels)
    {
      voxel = rest % 3 + 1;
      rest /= 3;
    }
    SCOPED_TRACE(code);
    ExpectManifold(SurfacesOf(map, ExactSettings(0)));
  }
}

// In noise, labels touch by edges and corners in every way.
TEST(LabelSurfaces, AreValidForRandomLabels)
{
  std::mt19937 random(1);
  for (int run = 0; run < 30; ++run)
  {
    LabelMap map = RandomMap(random, 4 + run % 4, 1 + run % 6);
    map.Geometry.Spacing = { 0.7, 0.7, 3 };
    for (const bool exact : { true, false })
    {
      SCOPED_TRACE(std::to_string(run) + (exact ? " exact" : " smooth"));
      LabelSurfaceSettings settings = ExactSettings(run % 3 * 20);
      settings.Exact = exact;
      const LabelSurfaces surfaces = SurfacesOf(map, settings);
      ExpectManifold(surfaces);
      ExpectEmbedded(surfaces);
      if (exact)
      {
        ExpectSameVoxels(map, surfaces);
      }
    }
  }
}

TEST(LabelSurfaces, AreValidForCheckerboards)
{
  for (const int other : { 0, 2 })
  {
    LabelMap map(8, 7, 6);
    for (int k = 0; k < 6; ++k)
    {
      for (int j = 0; j < 7; ++j)
      {
        for (int i = 0; i < 8; ++i)
        {
          map.At(i, j, k) = (i + j + k) % 2 == 0 ? 1 : other;
        }
      }
    }
    const LabelSurfaces surfaces = SurfacesOf(map, ExactSettings());
    ExpectManifold(surfaces);
    ExpectEmbedded(surfaces);
    ExpectSameVoxels(map, surfaces);
  }
}

// Labels that touch by an edge are joined where most voxels around are theirs, else apart.
TEST(LabelSurfaces, FollowTheRuleWhereLabelsTouchByAnEdge)
{
  LabelMap apart(2, 2, 1);
  apart.At(0, 0, 0) = 5;
  apart.At(1, 1, 0) = 5;
  EXPECT_EQ(SurfacesOf(apart, ExactSettings()).Measures[0].EulerNumber, 4);

  LabelMap joined(4, 4, 4);
  std::fill(joined.Voxels.begin(), joined.Voxels.end(), 5);
  joined.At(1, 1, 1) = 0;
  joined.At(2, 2, 1) = 0;
  // Two cavities, not one.
  EXPECT_EQ(SurfacesOf(joined, ExactSettings()).Measures[0].EulerNumber, 6);
}

TEST(LabelSurfaces, ShareWallsAndKeepVolumes)
{
  const LabelMap map = TwoBallsAndBox(40);
  for (const bool exact : { true, false })
  {
    LabelSurfaceSettings settings;
    settings.Exact = exact;
    const LabelSurfaces surfaces = SurfacesOf(map, settings);
    ExpectManifold(surfaces);
    ExpectEmbedded(surfaces);
    ASSERT_EQ(surfaces.Values, (std::vector<int>{ 0, 3, 700, 2147483647 }));
    std::map<std::array<int, 2>, int> walls;
    for (const auto& labels : surfaces.Walls.Labels)
    {
      ++walls[labels];
    }
    // Background is second.
    EXPECT_EQ(walls.size(), 6U);
    EXPECT_GT((walls[{ { 1, 2 } }]), 0);
    EXPECT_GT((walls[{ { 3, 0 } }]), 0);
    for (const LabelMeasures& measures : surfaces.Measures)
    {
      EXPECT_EQ(measures.EulerNumber, 2);
      EXPECT_NEAR(measures.Volume / measures.VoxelVolume, 1, 0.005) << measures.Label;
    }
    EXPECT_LT(surfaces.GreatestDistance, exact ? 0.5 * std::sqrt(3.0) : 2.5);
  }
}

// A ball's surface is smooth: its area is that of the ball, where the voxels' is half as large
// again.
TEST(LabelSurfaces, AreSmooth)
{
  LabelMap map(30, 30, 30);
  const double radius = 11.3;
  for (int k = 0; k < 30; ++k)
  {
    for (int j = 0; j < 30; ++j)
    {
      for (int i = 0; i < 30; ++i)
      {
        map.At(i, j, k) =
          (Eigen::Vector3d(i, j, k) - Eigen::Vector3d(14.6, 14.5, 14.2)).norm() < radius ? 1 : 0;
      }
    }
  }
  const double area = 4 * 3.141592653589793 * radius * radius;
  const LabelSurfaces exact = SurfacesOf(map, ExactSettings());
  ExpectSameVoxels(map, exact);
  EXPECT_NEAR(exact.Measures[0].Area / area, 1, 0.01);
  LabelSurfaceSettings settings;
  EXPECT_NEAR(SurfacesOf(map, settings).Measures[0].Area / area, 1, 0.01);
  EXPECT_GT(SurfacesOf(map, ExactSettings(0)).Measures[0].Area / area, 1.3);
}

// Sheared axes, left-handed ones, and an origin far away.
TEST(LabelSurfaces, ObeyTheGeometry)
{
  LabelMap map = TwoBallsAndBox(20);
  const LabelSurfaces plain = SurfacesOf(map, ExactSettings());
  map.Geometry.Origin = { 250, -1300, 40 };
  map.Geometry.Spacing = { 0.8, 0.9, 2.5 };
  map.Geometry.Direction << 0, 1, 0.3, 1, 0, 0, 0, 0, 1;
  for (const double sign : { 1.0, -1.0 })
  {
    map.Geometry.Direction.col(2) *= sign;
    const LabelSurfaces surfaces = SurfacesOf(map, ExactSettings());
    ExpectManifold(surfaces);
    ExpectEmbedded(surfaces);
    ExpectSameVoxels(map, surfaces);
    EXPECT_EQ(surfaces.Measures[0].EulerNumber, plain.Measures[0].EulerNumber);
  }
}

TEST(LabelSurfaces, HoldInSinglePrecision)
{
  LabelMap map = TwoBallsAndBox(20);
  map.Geometry.Origin = { 123.456, 78.9, -1011.12 };
  const LabelSurfaces surfaces = SurfacesOf(map, {});
  EXPECT_EQ(surfaces.Walls.Points, surfaces.Walls.Points.cast<float>().cast<double>());
  map.Geometry.Origin = { 1e8, 0, 0 };
  EXPECT_THROW(SurfacesOf(map, {}), Error);
}

TEST(LabelSurfaces, DoNotDependOnThreads)
{
  const LabelMap map = TwoBallsAndBox(32);
  const ParallelFor threads = [](std::ptrdiff_t begin, std::ptrdiff_t end, const RangeBody& body)
  {
    std::vector<std::thread> running;
    for (int part = 0; part < 3; ++part)
    {
      const std::ptrdiff_t first = begin + (end - begin) * part / 3;
      const std::ptrdiff_t last = begin + (end - begin) * (part + 1) / 3;
      if (first < last)
      {
        running.emplace_back(body, first, last);
      }
    }
    for (std::thread& thread : running)
    {
      thread.join();
    }
  };
  const LabelSurfaces one = SurfacesOf(map, {});
  const LabelSurfaces three = SurfacesOf(map, {}, threads);
  EXPECT_EQ(one.Walls.Points, three.Walls.Points);
  EXPECT_EQ(one.Walls.Triangles, three.Walls.Triangles);
  EXPECT_EQ(one.Walls.Labels, three.Walls.Labels);
}

TEST(LabelSurfaces, StopWhenAsked)
{
  const LabelMap map = TwoBallsAndBox(20);
  const LabelGrid grid = MakeLabelGrid(map.View(), {}, "the label map", SerialFor);
  double last = 0;
  const auto result = MakeLabelSurfaces(grid, map.Geometry, {}, SerialFor,
    [&last](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return fraction < 0.3;
    });
  EXPECT_FALSE(result.Complete);
  EXPECT_LT(last, 0.4);
}

TEST(LabelSurfaces, TakeTheLabelsThatAreWanted)
{
  const LabelMap map = TwoBallsAndBox(16);
  const LabelGrid grid = MakeLabelGrid(map.View(), { 700 }, "the label map", SerialFor);
  EXPECT_EQ(grid.Values, (std::vector<int>{ 0, 700 }));
  EXPECT_NE(MessageFor(map, { 4 }).find("no voxel with label 4"), std::string::npos);
}

TEST(LabelSurfaces, RefuseWhatIsNoLabelMap)
{
  LabelMap map(3, 3, 3);
  EXPECT_NE(MessageFor(map).find("has no labels"), std::string::npos);
  map.At(1, 2, 0) = -4;
  EXPECT_NE(MessageFor(map).find("has the value -4 at voxel (1, 2, 0)"), std::string::npos);

  LabelMap noise(50, 50, 50);
  for (std::size_t voxel = 0; voxel < noise.Voxels.size(); ++voxel)
  {
    noise.Voxels[voxel] = static_cast<int>(voxel);
  }
  EXPECT_NE(MessageFor(noise).find("more than 65000 different values"), std::string::npos);

  const std::vector<float> halves{ 0, 1.5F };
  ImageGeometry geometry;
  geometry.Dimensions = { { 2, 1, 1 } };
  EXPECT_THROW(MakeLabelGrid(ImageView<float>{ halves.data(), geometry }, {}, "it", SerialFor),
    Error);

  LabelSurfaceSettings settings;
  settings.Distance = 1.5;
  EXPECT_THROW(SurfacesOf(TwoBallsAndBox(8), settings), Error);
}

// A voxel at the end of a line, or in a plane's middle that has others behind it, is simple; one
// that joins two, fills a hole, or stands alone is not.
TEST(LabelSurfaces, KnowSimpleVoxels)
{
  const auto bit = [](int i, int j, int k) { return 1U << (9 * (k + 1) + 3 * (j + 1) + i + 1); };
  EXPECT_FALSE(IsSimpleVoxel(0));
  EXPECT_FALSE(IsSimpleVoxel(((1U << 27) - 1) & ~bit(0, 0, 0)));
  EXPECT_TRUE(IsSimpleVoxel(bit(1, 0, 0)));
  EXPECT_FALSE(IsSimpleVoxel(bit(1, 0, 0) | bit(-1, 0, 0)));
  EXPECT_FALSE(IsSimpleVoxel(bit(1, 1, 0)));
  EXPECT_TRUE(IsSimpleVoxel(0x1ff));
  EXPECT_FALSE(IsSimpleVoxel(0x1ff | 0x1ffU << 18));
  EXPECT_FALSE(IsSimpleVoxel(0x1ffU << 9 & ~bit(0, 0, 0))); // a ring, which it would fill
  EXPECT_FALSE(IsSimpleAcrossFaces(bit(1, 1, 0)));
  EXPECT_TRUE(IsSimpleAcrossFaces(bit(1, 0, 0) | bit(-1, -1, 0)));
}

// Whether the numbers of its points are close together or not, and where it has none.
TEST(TrianglesByLabel, HaveBoundariesWithTheirPointsInOrder)
{
  SharedWalls walls;
  walls.Points = PointList::Random(2000, 3);
  walls.Triangles.resize(4, 3);
  walls.Triangles << 5, 3, 4, 1999, 0, 1000, 4, 3, 6, 7, 1000, 1999;
  walls.Labels = { { { 1, 0 } }, { { 2, 0 } }, { { 1, 2 } }, { { 0, 2 } } };
  const TrianglesByLabel triangles(walls, 4);
  const std::vector<std::vector<int>> expected{ {}, { 3, 4, 5, 6 }, { 0, 3, 4, 6, 7, 1000, 1999 },
    {} };
  for (int label = 1; label < 4; ++label)
  {
    const LabelBoundary boundary = triangles.BoundaryOf(label);
    ASSERT_EQ(boundary.Points.rows(), static_cast<Eigen::Index>(expected[label].size()));
    for (std::size_t place = 0; place < expected[label].size(); ++place)
    {
      EXPECT_EQ(boundary.Points.row(static_cast<Eigen::Index>(place)),
        walls.Points.row(expected[label][place]));
    }
  }
  TriangleList ofFirst(2, 3);
  ofFirst << 2, 0, 1, 1, 0, 3;
  EXPECT_EQ(triangles.BoundaryOf(1).Triangles, ofFirst);
  TriangleList ofSecond(3, 3); // turned around where it is the second label
  ofSecond << 6, 0, 5, 3, 1, 2, 6, 5, 4;
  EXPECT_EQ(triangles.BoundaryOf(2).Triangles, ofSecond);
}

// Fewer triangles: walls stay what they are, apart from each other, near where they were, and,
// where they are exact, with every voxel on its side.
#include "LabelSurface/WallCollapse.h"

#include "Error.h"
#include "ExampleLabelMaps.h"

#include <limits>

using namespace FlipFree;

namespace
{

LabelSurfaceSettings CoarseSettings(double edgeLength, int triangles, bool exact)
{
  LabelSurfaceSettings settings;
  settings.Exact = exact;
  settings.EdgeLength = edgeLength;
  settings.Triangles = triangles;
  return settings;
}

using Edge = std::array<int, 2>;

std::map<Edge, std::vector<int>> TrianglesByEdge(const SharedWalls& walls)
{
  std::map<Edge, std::vector<int>> edges;
  for (int triangle = 0; triangle < walls.Triangles.rows(); ++triangle)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax(
        { walls.Triangles(triangle, corner), walls.Triangles(triangle, (corner + 1) % 3) });
      edges[{ { low, high } }].push_back(triangle);
    }
  }
  return edges;
}

double LongestEdge(const SharedWalls& walls)
{
  double longest = 0;
  for (const auto& edge : TrianglesByEdge(walls))
  {
    longest =
      std::max(longest, (walls.Points.row(edge.first[0]) - walls.Points.row(edge.first[1])).norm());
  }
  return longest;
}

// Around each edge, also where several walls meet, there are the two sides of each label.
void ExpectSharedWalls(const SharedWalls& walls)
{
  for (const auto& edge : TrianglesByEdge(walls))
  {
    std::map<int, int> sides;
    for (const int triangle : edge.second)
    {
      ++sides[walls.Labels[triangle][0]];
      ++sides[walls.Labels[triangle][1]];
    }
    for (const auto& side : sides)
    {
      ASSERT_EQ(side.second, 2) << side.first;
    }
  }
}

std::map<std::array<int, 2>, int> CountByWall(const SharedWalls& walls)
{
  std::map<std::array<int, 2>, int> counts;
  for (const auto& labels : walls.Labels)
  {
    ++counts[labels];
  }
  return counts;
}

void ExpectCoarse(const LabelMap& map, const LabelSurfaceSettings& settings)
{
  LabelSurfaceSettings finest = settings;
  finest.EdgeLength = 0;
  finest.Triangles = 0;
  const LabelSurfaces fine = SurfacesOf(map, finest);
  const LabelSurfaces coarse = SurfacesOf(map, settings);
  ExpectManifold(coarse);
  ExpectEmbedded(coarse);
  ExpectSharedWalls(coarse.Walls);
  EXPECT_LT(coarse.Walls.Triangles.rows(), fine.Walls.Triangles.rows());
  EXPECT_EQ(CountByWall(coarse.Walls).size(), CountByWall(fine.Walls).size());
  for (std::size_t label = 0; label < fine.Measures.size(); ++label)
  {
    EXPECT_EQ(coarse.Measures[label].EulerNumber, fine.Measures[label].EulerNumber);
  }
  EXPECT_EQ(fine.CollapseDistance, 0);
  EXPECT_LE(coarse.CollapseDistance, settings.Tolerance * map.Geometry.Spacing.minCoeff() + 1e-9);
  EXPECT_EQ(coarse.Walls.Points, coarse.Walls.Points.cast<float>().cast<double>());
  if (settings.EdgeLength > 0)
  {
    EXPECT_LE(LongestEdge(coarse.Walls), std::max(settings.EdgeLength, LongestEdge(fine.Walls)));
  }
  if (settings.Exact)
  {
    ExpectSameVoxels(map, coarse);
  }
}

} // namespace

TEST(WallCollapse, KeepsWhatIsPromisedOfLabelsThatMeet)
{
  LabelMap map = TwoBallsAndBox(24);
  for (const bool exact : { true, false })
  {
    SCOPED_TRACE(exact);
    ExpectCoarse(map, CoarseSettings(0, 1, exact));
    ExpectCoarse(map, CoarseSettings(3, 0, exact));
  }
  LabelSurfaceSettings wide = CoarseSettings(0, 1, true);
  wide.Tolerance = 4; // voxels alone limit it
  ExpectCoarse(map, wide);
}

TEST(WallCollapse, KeepsWhatIsPromisedInNoise)
{
  std::mt19937 random(12);
  for (int run = 0; run < 12; ++run)
  {
    SCOPED_TRACE(run);
    LabelMap map = RandomMap(random, 5 + run % 3, 1 + run % 4);
    map.Geometry.Spacing = { 0.8, 1, 2.5 };
    LabelSurfaceSettings settings = CoarseSettings(0, 1, run % 2 == 0);
    settings.Tolerance = 0.2 + 0.3 * (run % 4);
    ExpectCoarse(map, settings);
  }
}

TEST(WallCollapse, ObeysTheGeometry)
{
  LabelMap map = TwoBallsAndBox(20);
  map.Geometry.Origin = { 250, -1300, 40 };
  map.Geometry.Spacing = { 0.8, 0.9, 2.5 };
  map.Geometry.Direction << 0, 1, 0.3, 1, 0, 0, 0, 0, 1;
  for (const double sign : { 1.0, -1.0 })
  {
    map.Geometry.Direction.col(2) *= sign;
    ExpectCoarse(map, CoarseSettings(0, 1, true));
  }
}

TEST(WallCollapse, StopsAtTheNumberOfTriangles)
{
  const LabelMap map = TwoBallsAndBox(24);
  const auto fine =
    static_cast<int>(SurfacesOf(map, CoarseSettings(0, 0, true)).Walls.Labels.size());
  for (const int wanted : { fine / 2, fine - 1 })
  {
    const auto count =
      static_cast<int>(SurfacesOf(map, CoarseSettings(0, wanted, true)).Walls.Labels.size());
    // A collapse takes two triangles, or one for each wall at a curve.
    EXPECT_LE(count, wanted);
    EXPECT_GT(count, wanted - 4);
  }
}

// What is flat needs few triangles, and the fewer, the more tolerance there is.
TEST(WallCollapse, IsCoarsestWhereWallsAreFlat)
{
  LabelMap map(30, 30, 30);
  for (int k = 4; k < 26; ++k)
  {
    for (int j = 4; j < 26; ++j)
    {
      std::fill(&map.At(4, j, k), &map.At(26, j, k), 1);
    }
  }
  std::size_t last = SurfacesOf(map, CoarseSettings(0, 0, true)).Walls.Labels.size();
  const std::size_t first = last;
  for (const double tolerance : { 0.05, 0.2, 0.5 })
  {
    LabelSurfaceSettings settings = CoarseSettings(0, 1, true);
    settings.Tolerance = tolerance;
    const LabelSurfaces surfaces = SurfacesOf(map, settings);
    EXPECT_LT(surfaces.Walls.Labels.size(), last);
    last = surfaces.Walls.Labels.size();
  }
  EXPECT_LT(20 * last, first);
}

TEST(WallCollapse, IsRefusedOutOfRangeAndStopsWhenAsked)
{
  const LabelMap map = TwoBallsAndBox(12);
  const auto expect = [&map](const LabelSurfaceSettings& settings, const std::string& words)
  {
    try
    {
      SurfacesOf(map, settings);
      FAIL() << words;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.GetCode(), ErrorCode::OutOfRange);
      EXPECT_NE(error.GetText().find(words), std::string::npos) << error.GetText();
    }
  };
  expect(CoarseSettings(-1, 0, true), "{EdgeLength} is -1 mm; choose 0, for no limit, to");
  expect(CoarseSettings(0, -1, true), "{Triangles} is -1; choose 0, for no limit, or more");
  LabelSurfaceSettings settings = CoarseSettings(2, 0, true);
  settings.Tolerance = std::numeric_limits<double>::quiet_NaN();
  expect(settings, "{Tolerance} is nan voxels; choose 0 to 10");

  SharedWalls walls = SurfacesOf(map, CoarseSettings(0, 0, true)).Walls;
  PointList indices = walls.Points;
  CollapseSettings collapse;
  collapse.Tolerance = 1;
  EXPECT_FALSE(CollapseWalls(
    collapse, [](double) { return false; }, walls, indices));
}

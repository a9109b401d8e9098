#include "Measures/SurfaceQuality.h"

#include "ExampleSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace FlipFree;

namespace
{

const double Pi = 4 * std::atan(1.0);

PointList MakePoints(std::initializer_list<Eigen::Vector3d> points)
{
  PointList result(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::Index row = 0;
  for (const auto& point : points)
  {
    result.row(row++) = point;
  }
  return result;
}

double ScaledJacobianOf(std::initializer_list<Eigen::Vector3d> polygon)
{
  FaceList face;
  face.Connectivity.resize(polygon.size());
  std::iota(face.Connectivity.begin(), face.Connectivity.end(), 0);
  face.Offsets.push_back(static_cast<int>(polygon.size()));
  return MeasureQuality(MakePoints(polygon), face).MinimumScaledJacobian;
}

FaceList Polygons(const std::vector<std::vector<int>>& polygons)
{
  FaceList faces;
  for (const auto& polygon : polygons)
  {
    for (int vertex : polygon)
    {
      faces.Connectivity.push_back(vertex);
    }
    faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
  }
  return faces;
}

const std::vector<std::vector<int>> BoxPolygons{ { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
  { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };

FaceList BoxFaces(const std::vector<int>& extra = {})
{
  auto polygons = BoxPolygons;
  if (!extra.empty())
  {
    polygons.push_back(extra);
  }
  return Polygons(polygons);
}

} // namespace

TEST(SurfaceQuality, ScaledJacobianIsTheSineOfTheWorstCorner)
{
  const double root3 = std::sqrt(3.0);
  EXPECT_NEAR(ScaledJacobianOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, root3 / 2, 0 } }), 1, 1e-15);
  EXPECT_NEAR(ScaledJacobianOf({ { 0, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 } }), std::sqrt(2 / 3.0),
    1e-15);
  EXPECT_NEAR(ScaledJacobianOf({ { 0, 0, 5 }, { 3, 0, 5 }, { 3, 3, 5 }, { 0, 3, 5 } }), 1, 1e-15);
  EXPECT_NEAR(
    ScaledJacobianOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 1.5, root3 / 2, 0 }, { 0.5, root3 / 2, 0 } }),
    root3 / 2, 1e-15);
  // An arrow head, whose notch turns the other way by a right angle.
  EXPECT_NEAR(ScaledJacobianOf({ { 0, 0, 0 }, { 2, 1, 0 }, { 0, 2, 0 }, { 1, 1, 0 } }), -1, 1e-15);
  EXPECT_EQ(ScaledJacobianOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }), 0);
  EXPECT_EQ(ScaledJacobianOf({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } }), 0);
}

TEST(SurfaceQuality, FirstPercentileLeavesOneFaceInAHundredBelow)
{
  // Rows of separate triangles, the i-th with its apex at height i.
  for (const int count : { 1, 100, 101, 250 })
  {
    PointList points(3 * count, 3);
    std::vector<std::vector<int>> polygons;
    for (int i = 0; i < count; ++i)
    {
      const double height = std::sqrt(3.0) / 2 * (i + 1) / count;
      points.row(3 * i) << 2 * i, 0, 0;
      points.row(3 * i + 1) << 2 * i + 1, 0, 0;
      points.row(3 * i + 2) << 2 * i + 0.5, height, 0;
      polygons.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
    }
    const SurfaceQuality quality = MeasureQuality(points, Polygons(polygons));
    const double percentile = quality.FirstPercentileScaledJacobian;
    const auto& all = quality.ScaledJacobians;
    const auto below =
      std::count_if(all.begin(), all.end(), [=](double value) { return value < percentile; });
    const auto upTo =
      std::count_if(all.begin(), all.end(), [=](double value) { return value <= percentile; });
    EXPECT_LT(100 * below, count);
    EXPECT_GE(100 * upTo, count);
    EXPECT_EQ(quality.MinimumScaledJacobian, *std::min_element(all.begin(), all.end()));
  }
}

TEST(SurfaceQuality, OfABoxOfQuads)
{
  const Surface box = Box({ 0, 0, 0 }, { 2, 2, 2 });
  const SurfaceQuality quality = MeasureQuality(box.Points, BoxFaces());
  EXPECT_EQ(quality.Topology.EulerNumber(), 2);
  EXPECT_EQ(quality.Topology.Edges, 12);
  EXPECT_EQ(quality.Topology.BoundaryEdges, 0);
  EXPECT_NEAR(quality.MinimumScaledJacobian, 1, 1e-15);
  EXPECT_NEAR(quality.MinimumDihedralAngle, 90, 1e-12);
  EXPECT_NEAR(quality.EdgeLengthVariation, 0, 1e-15);

  // Edges of 1, 2 and 3, four of each.
  const Surface cuboid = Box({ 0, 0, 0 }, { 1, 2, 3 });
  EXPECT_NEAR(MeasureQuality(cuboid.Points, BoxFaces()).EdgeLengthVariation, std::sqrt(2.0 / 3) / 2,
    1e-15);
}

TEST(SurfaceQuality, DihedralAngleOfAHinge)
{
  for (const double degrees : { 1.0, 30.0, 90.0, 170.0, 180.0 })
  {
    for (const double sign : { -1, 1 })
    {
      const double angle = degrees * Pi / 180;
      const PointList points = MakePoints({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0.5, 0 },
        { std::cos(angle), 0.5, sign * std::sin(angle) } });
      const FaceList faces = Polygons({ { 0, 2, 1 }, { 0, 1, 3 } });
      EXPECT_NEAR(MeasureQuality(points, faces).MinimumDihedralAngle, degrees, 1e-9);
    }
  }
}

TEST(SurfaceQuality, CountsHolesAndBadEdges)
{
  const Surface box = Box({ 0, 0, 0 }, { 1, 1, 1 });
  const FaceList open = Polygons({ BoxPolygons.begin() + 1, BoxPolygons.end() });
  auto oneTurned = BoxPolygons;
  std::reverse(oneTurned[0].begin(), oneTurned[0].end());
  const FaceList twisted = Polygons(oneTurned);
  const FaceList doubled = BoxFaces({ 0, 2, 7 });
  const SurfaceTopology ofOpen = MeasureQuality(box.Points, open).Topology;
  EXPECT_EQ(ofOpen.BoundaryEdges, 4);
  EXPECT_EQ(ofOpen.EulerNumber(), 1);
  EXPECT_EQ(MeasureQuality(box.Points, twisted).Topology.MisorientedEdges, 4);
  const SurfaceTopology ofDoubled = MeasureQuality(box.Points, doubled).Topology;
  EXPECT_EQ(ofDoubled.NonManifoldEdges, 1);
  EXPECT_EQ(ofDoubled.BoundaryEdges, 2);
}

TEST(SurfaceQuality, UnusedPointsAreNoVertices)
{
  PointList points(9, 3);
  points << Box({ 0, 0, 0 }, { 1, 1, 1 }).Points,
    Eigen::RowVector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(MeasureQuality(points, BoxFaces()).Topology.EulerNumber(), 2);
}

TEST(SurfaceQuality, FlippedCornersAreThoseTurnedByARightAngle)
{
  const Surface box = Box({ -1, -1, -1 }, { 1, 1, 1 });
  const FaceList faces = BoxFaces();
  const auto countTurned = [&](double degrees)
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * Pi / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const Surface turned = Moved(box, turn, { 5, 6, 7 });
    const auto flipped = CountFlippedCorners(turned.Points, box.Points, faces);
    return std::accumulate(flipped.begin(), flipped.end(), 0);
  };
  EXPECT_EQ(countTurned(0), 0);
  EXPECT_EQ(countTurned(89.9), 0);
  // The two sides normal to the axis turn in place.
  EXPECT_EQ(countTurned(90.1), 16);
  EXPECT_EQ(countTurned(180), 16);

  // One vertex pulled through the opposite side turns its own corners and some next to them.
  Surface pulled = box;
  pulled.Points.row(7) << -3, -3, 1;
  const auto flipped = CountFlippedCorners(pulled.Points, box.Points, faces);
  EXPECT_EQ(flipped[0], 0);
  EXPECT_GT(flipped[1], 0);
  EXPECT_EQ(CountFlippedCorners(box.Points, pulled.Points, faces), flipped);

  Surface collapsed = box;
  collapsed.Points.setZero();
  EXPECT_EQ(CountFlippedCorners(collapsed.Points, box.Points, faces), std::vector<int>(6, 4));
}

TEST(SurfaceQuality, RefusesBadFaces)
{
  const Surface box = Box({ 0, 0, 0 }, { 1, 1, 1 });
  const auto errorOf = [&box](const FaceList& faces)
  { return ErrorOf([&] { MeasureQuality(box.Points, faces); }); };
  EXPECT_EQ(errorOf(BoxFaces()), "");
  EXPECT_NE(
    errorOf(BoxFaces({ 1, 2 })).find("polygon 6 of the surface has fewer than three vertices"),
    std::string::npos);
  EXPECT_NE(errorOf(BoxFaces({ 1, 2, -1 })).find("refers to point -1"), std::string::npos);
  EXPECT_NE(errorOf(FaceList()).find("no polygons"), std::string::npos);
}

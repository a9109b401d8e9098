#include "Measures/SurfaceValidity.h"

#include "ExampleSurfaces.h"
#include "Geometry/ClosestDirection.h"
#include "Geometry/SurfaceGap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace FlipFree;

namespace
{

double MinimumGapOf(const Surface& surface)
{
  return MeasureMinimumGap(surface.Points, FaceHulls(surface.Points, FacesOf(surface.Triangles)),
    ScatteredFor);
}

bool ShareVertex(const Surface& surface, int one, int two)
{
  bool share = false;
  for (const int vertex : surface.Triangles.row(one))
  {
    share = share || (surface.Triangles.row(two).array() == vertex).any();
  }
  return share;
}

SurfaceValidity ValidityOf(const Surface& surface, const PointList* reference = nullptr)
{
  return MeasureValidity(surface.Points, FacesOf(surface.Triangles), reference);
}

} // namespace

TEST(SurfaceGap, BetweenBoxesIsClosedForm)
{
  const Surface box = Box({ 0, 0, 0 }, { 4, 4, 4 });
  // Face to face, edge to edge, corner to corner.
  EXPECT_NEAR(MinimumGapOf(Joined(box, Box({ 4.5, 1, 1 }, { 8, 3, 3 }))), 0.5, 1e-14);
  EXPECT_NEAR(MinimumGapOf(Joined(box, Box({ 4.3, 4.4, 1 }, { 8, 8, 3 }))), 0.5, 1e-14);
  EXPECT_NEAR(MinimumGapOf(Joined(box, Box({ 4.2, 4.3, 4.6 }, { 8, 8, 8 }))), 0.7, 1e-14);
  // Two edges that cross at a distance, every vertex far away.
  const Eigen::Matrix3d quarterTurn =
    Eigen::AngleAxisd(2 * std::atan(1.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Surface ridge = Moved(Box({ -1, -1, -1 }, { 1, 1, 1 }),
    Eigen::AngleAxisd(std::atan(1.0), Eigen::Vector3d::UnitX()).toRotationMatrix(), { 0, 0, 0 });
  const double top = std::sqrt(2.0);
  const Surface crossing = Moved(ridge, quarterTurn, { 0, 0, 2 * top + 0.25 });
  EXPECT_NEAR(MinimumGapOf(Joined(ridge, crossing)), 0.25, 1e-14);
}

TEST(SurfaceGap, IsThatOfBruteForce)
{
  const Surface potato = Potato(5, { 0, 0, 0 }, 10);
  const auto cornersOf = [&](int triangle)
  {
    const auto corner = [&](int which) -> Eigen::Vector3d
    { return potato.Points.row(potato.Triangles(triangle, which)); };
    return HullCorners{ { corner(0), corner(1), corner(2), corner(2) } };
  };
  std::vector<std::pair<int, int>> disjoint;
  std::vector<double> distances;
  for (int one = 0; one < potato.Triangles.rows(); ++one)
  {
    for (int two = one + 1; two < potato.Triangles.rows(); ++two)
    {
      if (!ShareVertex(potato, one, two))
      {
        disjoint.emplace_back(one, two);
        distances.push_back(ClosestDirection(cornersOf(one), cornersOf(two)).norm());
      }
    }
  }
  const double minimum = *std::min_element(distances.begin(), distances.end());
  EXPECT_DOUBLE_EQ(MinimumGapOf(potato), minimum);

  const FaceHulls hulls(potato.Points, FacesOf(potato.Triangles));
  for (const double gap : { (1 - 1e-9) * minimum, (1 + 1e-9) * minimum, 3.0, 1000.0 })
  {
    std::vector<std::pair<int, int>> expected;
    for (std::size_t pair = 0; pair < disjoint.size(); ++pair)
    {
      if (distances[pair] < gap)
      {
        expected.push_back(disjoint[pair]);
      }
    }
    std::vector<std::pair<int, int>> found;
    for (const HullPair& pair :
      FindPairsNearerThan(gap, potato.Points, hulls, AdjacentPairsOf(hulls), ScatteredFor))
    {
      if (!ShareVertex(potato, pair.Faces[0], pair.Faces[1]))
      {
        found.push_back(std::minmax({ pair.Faces[0], pair.Faces[1] }));
      }
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << gap;
  }
}

// Shares nothing with ClosestDirection: the distances of many points of both triangles.
TEST(SurfaceGap, IsTheMinimumOverManySamples)
{
  const Surface potato = Potato(5, { 0, 0, 0 }, 10);
  const int n = 8;
  std::vector<PointList> samples;
  for (const auto& corners : potato.Triangles.rowwise())
  {
    const Eigen::RowVector3d a = potato.Points.row(corners[0]);
    const Eigen::RowVector3d b = potato.Points.row(corners[1]);
    const Eigen::RowVector3d c = potato.Points.row(corners[2]);
    PointList& points = samples.emplace_back((n + 1) * (n + 2) / 2, 3);
    Eigen::Index row = 0;
    for (int i = 0; i <= n; ++i)
    {
      for (int j = 0; i + j <= n; ++j)
      {
        points.row(row++) = a + (b - a) * i / n + (c - a) * j / n;
      }
    }
  }
  double minimum = std::numeric_limits<double>::infinity();
  for (int one = 0; one < potato.Triangles.rows(); ++one)
  {
    for (int two = one + 1; two < potato.Triangles.rows(); ++two)
    {
      if (!ShareVertex(potato, one, two))
      {
        for (const auto& sample : samples[one].rowwise())
        {
          minimum =
            std::min(minimum, (samples[two].rowwise() - sample).rowwise().norm().minCoeff());
        }
      }
    }
  }
  EXPECT_LE(MinimumGapOf(potato), minimum + 1e-12);
  EXPECT_GT(MinimumGapOf(potato), 0.8 * minimum);
}

TEST(SurfaceGap, IsInfiniteWhereAllTrianglesShareVertices)
{
  Surface tetrahedron;
  tetrahedron.Points.resize(4, 3);
  tetrahedron.Points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.Triangles.resize(4, 3);
  tetrahedron.Triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  EXPECT_EQ(MinimumGapOf(tetrahedron), std::numeric_limits<double>::infinity());
}

TEST(SurfaceValidity, OfASphereIsPerfect)
{
  const Surface sphere = Sphere(8, { 1, 2, 3 }, 10);
  const SurfaceValidity validity = ValidityOf(sphere, &sphere.Points);
  EXPECT_TRUE(validity.IsValid());
  EXPECT_TRUE(validity.Complete);
  EXPECT_EQ(validity.FlippedCorners, 0);
  EXPECT_GT(validity.MinimumGap, 0);
  EXPECT_EQ(std::count(validity.Defects.begin(), validity.Defects.end(), 0),
    sphere.Triangles.rows());
}

TEST(EnclosedVolume, OfABoxIsExactAndNegativeInsideOut)
{
  Surface box = Box({ 100, -20, 30 }, { 102, -17, 34 });
  EXPECT_NEAR(EnclosedVolume(box.Points, box.Triangles), 24, 1e-12);
  box.Triangles.col(1).swap(box.Triangles.col(2));
  EXPECT_NEAR(EnclosedVolume(box.Points, box.Triangles), -24, 1e-12);
}

TEST(SurfaceValidity, MarksWhatIntersects)
{
  const Surface box = Box({ 0, 0, 0 }, { 4, 4, 4 });
  // A needle of a box through two opposite sides of the other.
  const SurfaceValidity validity = ValidityOf(Joined(box, Box({ -1, 1, 2 }, { 5, 1.2, 2.2 })));
  EXPECT_FALSE(validity.IsValid());
  EXPECT_GT(validity.SelfIntersections, 0);
  EXPECT_EQ(validity.MinimumGap, 0);
  EXPECT_EQ(validity.FlippedCorners, -1);
  for (Eigen::Index triangle = 0; triangle < 12; ++triangle)
  {
    // Only the sides at x = 0 and x = 4 are pierced, each in one of its triangles.
    const bool isPierceable = triangle >= 8;
    if (!isPierceable)
    {
      EXPECT_EQ(validity.Defects[triangle], 0) << triangle;
    }
  }
  EXPECT_EQ(std::count(validity.Defects.begin() + 8, validity.Defects.begin() + 12,
              static_cast<unsigned char>(SurfaceValidity::SelfIntersecting)),
    2);
  EXPECT_TRUE(ValidityOf(Joined(box, Box({ 5, 1, 2 }, { 6, 2, 3 }))).IsValid());
}

TEST(SurfaceValidity, MarksFlippedCornersAndNeedsAReferenceForThem)
{
  const Surface sphere = Sphere(8, { 0, 0, 0 }, 10);
  Surface folded = sphere;
  folded.Points.row(10) *= -0.5;
  const SurfaceValidity validity = ValidityOf(folded, &sphere.Points);
  EXPECT_FALSE(validity.IsValid());
  EXPECT_GT(validity.FlippedCorners, 0);
  for (Eigen::Index triangle = 0; triangle < folded.Triangles.rows(); ++triangle)
  {
    const bool isMoved = (folded.Triangles.row(triangle).array() == 10).any();
    const bool isFlipped = (validity.Defects[triangle] & SurfaceValidity::FlippedCorner) != 0;
    EXPECT_TRUE(isMoved || !isFlipped) << triangle;
  }
}

TEST(SurfaceValidity, MarksEveryFaceOnABadEdge)
{
  // Three fins on one edge, and two triangles that pass an edge the same way.
  PointList points(9, 3);
  points << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0, 9, 0, 0, 9, 1, 0, 10, 0, 0, 8, 0, 0;
  TriangleList triangles(5, 3);
  triangles << 0, 1, 2, 1, 0, 3, 0, 1, 4, 5, 6, 7, 5, 6, 8;
  const SurfaceValidity validity = MeasureValidity(points, FacesOf(triangles), nullptr);
  EXPECT_EQ(validity.Quality.Topology.NonManifoldEdges, 1);
  EXPECT_EQ(validity.Quality.Topology.MisorientedEdges, 1);
  const unsigned char both = SurfaceValidity::BadEdge | SurfaceValidity::BoundaryEdge;
  EXPECT_EQ(validity.Defects, std::vector<unsigned char>(5, both));
  EXPECT_FALSE(validity.IsValid());
}

TEST(SurfaceValidity, AnyNumberOfThreadsAndTheMonitor)
{
  Surface crumpled = Sphere(8, { 0, 0, 0 }, 10);
  crumpled.Points.row(10) *= -1.5;
  const FaceList faces = FacesOf(crumpled.Triangles);
  const SurfaceValidity serial = MeasureValidity(crumpled.Points, faces, nullptr);
  const SurfaceValidity scattered = MeasureValidity(crumpled.Points, faces, nullptr, ScatteredFor);
  EXPECT_GT(serial.SelfIntersections, 0);
  EXPECT_EQ(serial.SelfIntersections, scattered.SelfIntersections);
  EXPECT_EQ(serial.Defects, scattered.Defects);
  EXPECT_FALSE(MeasureValidity(crumpled.Points, faces, nullptr, SerialFor,
    [](double) {
      return false;
    }).Complete);
}

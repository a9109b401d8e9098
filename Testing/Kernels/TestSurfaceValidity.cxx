#include "Measures/SurfaceValidity.h"

#include "ExampleSurfaces.h"
#include "Geometry/SurfaceGap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace FlipFree;

namespace
{

Surface Joined(const Surface& first, const Surface& second)
{
  Surface both;
  both.Points.resize(first.Points.rows() + second.Points.rows(), 3);
  both.Points << first.Points, second.Points;
  both.Triangles.resize(first.Triangles.rows() + second.Triangles.rows(), 3);
  both.Triangles << first.Triangles,
    (second.Triangles.array() + static_cast<int>(first.Points.rows())).matrix();
  return both;
}

double MinimumGapOf(const Surface& surface)
{
  return MeasureMinimumGap(surface.Points, surface.Triangles, ScatteredFor);
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

TEST(SurfaceGap, PairsNearerThanTheLeastGapAreNone)
{
  const Surface potato = Potato(5, { 0, 0, 0 }, 10);
  const TriangleTree tree(potato.Points, potato.Triangles);
  const auto nearerThan = [&](double gap)
  { return FindPairsNearerThan(gap, tree, potato.Points, potato.Triangles, ScatteredFor); };
  const double least = MinimumGapOf(potato);
  EXPECT_TRUE(nearerThan((1 - 1e-9) * least).empty());
  EXPECT_GE(nearerThan((1 + 1e-9) * least).size(), 1U);

  // All pairs without a common vertex, and none twice.
  const auto all = nearerThan(1000);
  std::size_t expected = 0;
  for (Eigen::Index one = 0; one < potato.Triangles.rows(); ++one)
  {
    for (Eigen::Index two = one + 1; two < potato.Triangles.rows(); ++two)
    {
      bool share = false;
      for (int corner = 0; corner < 3; ++corner)
      {
        share = share || (potato.Triangles.row(two).array() == potato.Triangles(one, corner)).any();
      }
      expected += !share;
    }
  }
  EXPECT_EQ(all.size(), expected);
}

TEST(SurfaceGap, IsTheLeastOverManySamples)
{
  const Surface potato = Potato(5, { 0, 0, 0 }, 10);
  const int n = 8;
  std::vector<Eigen::Vector3d> samples;
  for (Eigen::Index triangle = 0; triangle < potato.Triangles.rows(); ++triangle)
  {
    const Eigen::Vector3d a = potato.Points.row(potato.Triangles(triangle, 0));
    const Eigen::Vector3d b = potato.Points.row(potato.Triangles(triangle, 1));
    const Eigen::Vector3d c = potato.Points.row(potato.Triangles(triangle, 2));
    for (int i = 0; i <= n; ++i)
    {
      for (int j = 0; i + j <= n; ++j)
      {
        samples.emplace_back(a + (b - a) * i / n + (c - a) * j / n);
      }
    }
  }
  const std::size_t perTriangle = samples.size() / potato.Triangles.rows();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index one = 0; one < potato.Triangles.rows(); ++one)
  {
    for (Eigen::Index two = one + 1; two < potato.Triangles.rows(); ++two)
    {
      bool isShared = false;
      for (int i = 0; i < 9; ++i)
      {
        isShared |= potato.Triangles(one, i / 3) == potato.Triangles(two, i % 3);
      }
      for (std::size_t i = 0; !isShared && i < perTriangle; ++i)
      {
        for (std::size_t j = 0; j < perTriangle; ++j)
        {
          least = std::min(least,
            (samples[one * perTriangle + i] - samples[two * perTriangle + j]).norm());
        }
      }
    }
  }
  const double gap = MinimumGapOf(potato);
  EXPECT_LE(gap, least + 1e-12);
  EXPECT_GT(gap, 0.8 * least);
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

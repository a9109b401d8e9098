#include "ExampleVessels.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/ContourMesh.h"
#include "Mesh/SurfaceTopology.h"
#include "Vessel/QuadTube.h"

#include <gtest/gtest.h>

using namespace FlipFree;

namespace
{

PointList Arc(double radius, double angle, int points = 60)
{
  PointList line(points, 3);
  for (int point = 0; point < points; ++point)
  {
    const double turn = angle * point / (points - 1);
    line.row(point) << radius * std::cos(turn), radius * std::sin(turn), 0;
  }
  return line;
}

QuadTube TubeAlong(const PointList& line, double radius, int n = 4)
{
  return MakeQuadTube(line, Eigen::VectorXd::Constant(line.rows(), radius), n, "the line",
    SerialFor);
}

std::string MessageFor(const PointList& line, double radius)
{
  try
  {
    TubeAlong(line, radius);
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(QuadTube, HasTheContoursOfABoxAndTheVolumeOfItsTube)
{
  for (const int n : { 2, 3, 8 })
  {
    const PointList line = Arc(40, 2);
    const QuadTube tube = TubeAlong(line, 5, n);
    const ContourMesh mesh = BuildContourMesh(static_cast<int>(tube.Points.rows()), tube.Faces);
    const int m = (mesh.NumberOfPoints() - 2 * n * n) / (4 * n);
    EXPECT_EQ(mesh.NumberOfPoints(), 2 * n * n + 4 * n * m);
    EXPECT_EQ(mesh.EulerNumber(), 2);
    // Rings, and loops along the tube in both directions.
    EXPECT_EQ(static_cast<int>(mesh.Contours.size()), m + 2 * n);
    EXPECT_EQ(CountSelfIntersections(tube.Points, tube.Faces), 0);
    EXPECT_NO_THROW(RequireOutward(tube.Points, Triangulate(tube.Faces), "the tube"));
    // By Pappus' theorem, of a polygon of 4 n corners.
    double volume = 0;
    const TriangleList triangles = Triangulate(tube.Faces);
    for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
    {
      Eigen::Matrix3d corners;
      for (int corner = 0; corner < 3; ++corner)
      {
        corners.row(corner) = tube.Points.row(triangles(triangle, corner));
      }
      volume += corners.determinant() / 6;
    }
    const double turn = 0.5 * EIGEN_PI / n;
    const double exact = 0.5 * 4 * n * std::sin(turn) * 25 * 80;
    EXPECT_NEAR(volume, exact, 0.003 * exact) << n;
  }
}

TEST(QuadTube, FollowsRadii)
{
  const PointList line = Arc(60, 1.5, 100);
  const Eigen::VectorXd radii = Eigen::VectorXd::LinSpaced(100, 3, 8);
  const QuadTube tube = MakeQuadTube(line, radii, 4, "the line", SerialFor);
  for (Eigen::Index vertex = 0; vertex < tube.Points.rows(); ++vertex)
  {
    Eigen::Index nearest = 0;
    const double distance = std::sqrt(
      (line.rowwise() - tube.Points.row(vertex)).rowwise().squaredNorm().minCoeff(&nearest));
    EXPECT_LE(distance, radii[nearest] + 0.1);
    if (nearest > 2 && nearest < 97)
    {
      EXPECT_NEAR(distance, radii[nearest], 0.1);
    }
  }
}

TEST(QuadTube, RefusesWhatIsNoTube)
{
  const auto contains = [](const std::string& message, const char* words)
  { EXPECT_NE(message.find(words), std::string::npos) << message; };
  contains(MessageFor(Arc(4, 2), 5), "bends more tightly than its radius");
  contains(MessageFor(Arc(20, 2 * EIGEN_PI), 5), "would intersect itself near (");
  contains(MessageFor(Arc(20, 1).topRows(1), 5), "fewer than two points");
  contains(MessageFor(Arc(20, 0), 5), "two points at (20, 0, 0)");
  contains(MessageFor(Arc(20, 1), 0), "radii positive");
}

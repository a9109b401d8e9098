#include "Mesh/EdgeLength.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace FlipFree;

TEST(EdgeLength, IsTheMean)
{
  // The octahedron of n = 1: all edges are sqrt(2) times the radius.
  const TestSphere octahedron(1);
  EXPECT_NEAR(TypicalEdgeLength(octahedron.Mesh.Neighbors, octahedron.Points()),
    25 * std::sqrt(2.0), 1e-12);
  const TestSphere sphere(16);
  double sum = 0;
  int count = 0;
  for (const auto& contour : sphere.Mesh.Contours)
  {
    for (std::size_t position = 0; position < contour.size(); ++position)
    {
      sum += (sphere.Points().row(contour[position]) -
        sphere.Points().row(contour[(position + 1) % contour.size()]))
               .norm();
      ++count;
    }
  }
  EXPECT_NEAR(TypicalEdgeLength(sphere.Mesh.Neighbors, sphere.Points()), sum / count, 1e-10);
}

TEST(EdgeLength, StrayVerticesDoNotCount)
{
  for (const int n : { 2, 4, 16 })
  {
    const TestSphere sphere(n);
    const double length = TypicalEdgeLength(sphere.Mesh.Neighbors, sphere.Points());
    PointList points = sphere.Points();
    for (int stray = 0; stray <= n * n / 20; ++stray)
    {
      points(13 * stray + 7, 0) = 1e6 * (1 + stray);
      EXPECT_NEAR(TypicalEdgeLength(sphere.Mesh.Neighbors, points), length, 0.3 * length) << n;
    }
  }
}

TEST(EdgeLength, CollapsedEdgesDoNotHideTheOthers)
{
  const TestSphere sphere(8);
  const double length = TypicalEdgeLength(sphere.Mesh.Neighbors, sphere.Points());
  PointList points = sphere.Points();
  points.bottomRows(points.rows() * 6 / 10).rowwise() = points.bottomRows<1>().eval();
  points(7, 0) = 1e6;
  EXPECT_GT(TypicalEdgeLength(sphere.Mesh.Neighbors, points), 0.3 * length);
}

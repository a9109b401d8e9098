// What the guard promises of faces with more than three corners: all ways to cut them.
#include "AdverseMotions.h"
#include "BruteForceMotion.h"
#include "Geometry/SelfIntersection.h"
#include "Guard/EmbeddingGuard.h"
#include "Mesh/EdgeLength.h"
#include "Mesh/MeshUnion.h"
#include "Mesh/SurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace FlipFree;

namespace
{

// Two polygons and a belt of triangles: all vertices have four neighbors.
struct GuardedDrum
{
  explicit GuardedDrum(int size)
    : Points(2 * size, 3)
  {
    FaceList faces;
    for (int cap = 0; cap < 2; ++cap)
    {
      for (int i = 0; i < size; ++i)
      {
        const double turn = 2 * M_PI * (i + 0.5 * cap) / size;
        this->Points.row(cap * size + i) << 20 * std::cos(turn), 20 * std::sin(turn), 24 * cap - 12;
        faces.Connectivity.push_back(cap == 0 ? size - 1 - i : size + i);
      }
      faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
    }
    for (int i = 0; i < size; ++i)
    {
      const int next = (i + 1) % size;
      faces.Append({ i, next, size + i });
      faces.Append({ next, size + next, size + i });
    }
    this->Mesh = BuildContourMesh(2 * size, faces);
  }

  PointList Points;
  ContourMesh Mesh;
};

// Appends the triangles of a cut, at random, of the polygon of these corners.
void AppendRandomCut(const std::vector<int>& corners, std::mt19937& random, FaceList& triangles)
{
  const int size = static_cast<int>(corners.size());
  if (size < 3)
  {
    return;
  }
  const int apex = std::uniform_int_distribution<int>(1, size - 2)(random);
  triangles.Append({ corners.front(), corners[apex], corners.back() });
  AppendRandomCut({ corners.begin(), corners.begin() + apex + 1 }, random, triangles);
  AppendRandomCut({ corners.begin() + apex, corners.end() }, random, triangles);
}

// Larger faces have their fans alone.
FaceList RandomlyCut(const FaceList& faces, std::mt19937& random)
{
  FaceList triangles;
  for (int face = 0; face < faces.NumberOfFaces(); ++face)
  {
    const int* const v = faces.Face(face);
    const int size = faces.FaceSize(face);
    if (size <= 8)
    {
      AppendRandomCut({ v, v + size }, random, triangles);
      continue;
    }
    for (int corner = 2; corner < size; ++corner)
    {
      triangles.Append({ v[0], v[corner - 1], v[corner] });
    }
  }
  return triangles;
}

// At some times of a motion, under some cuts.
std::ptrdiff_t CountOfRandomCuts(const ContourMesh& mesh, const PointList& from,
  const PointList& to, std::mt19937& random)
{
  std::ptrdiff_t count = 0;
  for (const double time : { 0.25, 0.5, 0.75, 1.0 })
  {
    for (int cut = 0; cut < 3; ++cut)
    {
      count +=
        CountSelfIntersections((1 - time) * from + time * to, RandomlyCut(mesh.Faces, random));
    }
  }
  return count;
}

// Steps of adverse motions from an ever worse surface.
void ExpectAllCutsSafe(const ContourMesh& mesh, PointList points, std::uint32_t seed)
{
  std::mt19937 random(seed);
  EmbeddingGuard guard(mesh);
  const CutFeatures features(mesh.Faces);
  const double edge = TypicalEdgeLength(mesh.Neighbors, points);
  int lostWithout = 0;
  int metWithout = 0;
  for (int kind = 0; kind < NumberOfAdverseMotions; ++kind)
  {
    PointList motion = AdverseMotion(kind, edge, points, random);
    // What it is that the guard prevents; but for what is far out of range.
    if (motion.cwiseAbs().maxCoeff() < 1e3)
    {
      lostWithout += TimeOfLostShape(mesh, points, points + motion) <= 1 ? 1 : 0;
      metWithout += features.TimeNearerThan(1e-3 * edge, points, points + motion) <= 1 ? 1 : 0;
    }
    const PointList to = guard.Limit(points, motion, SerialFor, NeverStop).Positions;
    EXPECT_EQ(CountOfRandomCuts(mesh, points, to, random), 0) << AdverseMotionNames[kind];
    EXPECT_EQ(TimeOfLostShape(mesh, points, to), Never) << AdverseMotionNames[kind];
    // Less than the guard's gap, since that may have been used up by the steps before.
    EXPECT_EQ(features.TimeNearerThan(1e-4 * edge, points, to), Never) << AdverseMotionNames[kind];
    points = kind % 4 == 3 ? to : points;
  }
  EXPECT_GT(lostWithout, 6);
  EXPECT_GT(metWithout, 6);
}

} // namespace

TEST(GuardedPolygons, BothDiagonalsOfQuadsStayApart)
{
  const TestSphere sphere(3);
  ExpectAllCutsSafe(sphere.Mesh, sphere.Points(), 1);
}

// Of so few quads that most are neighbors.
TEST(GuardedPolygons, BothDiagonalsOfASmallTorusStayApart)
{
  const TestTorus torus(4, 4);
  ExpectAllCutsSafe(torus.Mesh, torus.Points, 2);
}

TEST(GuardedPolygons, AllCutsOfPentagonsAndOctagonsStayApart)
{
  for (const int size : { 5, 6, 8 })
  {
    const GuardedDrum drum(size);
    ExpectAllCutsSafe(drum.Mesh, drum.Points, 10 + size);
  }
}

TEST(GuardedPolygons, FansOfLargerFacesStayApart)
{
  const GuardedDrum drum(9);
  ExpectAllCutsSafe(drum.Mesh, drum.Points, 20);
}

// The two cuts of a quad enclose a tetrahedron. What lies in it meets neither, but would change
// sides with the cut: it stays, as do the quad's corners, and the rest goes on.
TEST(GuardedPolygons, WhatLiesBetweenTwoCutsStaysAtRest)
{
  const TestSphere sphere(4);
  ContourMesh mesh = sphere.Mesh;
  PointList points = sphere.Points();
  const Eigen::RowVector3d center = points.colwise().mean();
  ASSERT_EQ(mesh.Faces.FaceSize(0), 4);
  Hull quad;
  std::copy_n(mesh.Faces.Face(0), 4, quad.begin());
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (int corner = 0; corner < 4; ++corner)
  {
    const double height = corner % 2 == 0 ? 1.1 : 0.9;
    points.row(quad[corner]) = center + height * (points.row(quad[corner]) - center);
    middle += points.row(quad[corner]) / 4;
  }
  const QuadSphere ball =
    MakeQuadSphere(1, middle.transpose(), 0.2, QuadSphereSpacing::Equiangular);
  const int numberOfBall = static_cast<int>(ball.Points.rows());
  AppendMesh(BuildContourMesh(numberOfBall, ball.Faces), mesh);
  AppendPoints(ball.Points, points);
  ASSERT_EQ(CountSelfIntersections(points, mesh.Faces), 0);
  PointList motion = PointList::Constant(points.rows(), 3, 0.1);
  const GuardReport report = EmbeddingGuard(mesh).Limit(points, motion, SerialFor, NeverStop);
  EXPECT_TRUE(motion.bottomRows(numberOfBall).isZero(0));
  for (const int corner : quad)
  {
    EXPECT_TRUE(motion.row(corner).isZero(0)) << corner;
  }
  EXPECT_EQ(report.Guarded, numberOfBall + 4);
  // Outside of the quad, it does not matter.
  points.bottomRows(numberOfBall).rowwise() += 0.3 * (middle - center);
  motion.setConstant(0.1);
  EXPECT_EQ(EmbeddingGuard(mesh).Limit(points, motion, SerialFor, NeverStop).Guarded, 0);
}

#include "ExampleSurfaces.h"
#include "Geometry/SelfIntersection.h"
#include "Mesh/MeshRefinement.h"
#include "RandomMotions.h"

#include <gtest/gtest.h>

#include <map>

using namespace FlipFree;

namespace
{

// A torus of quads: sides x sides vertices, four neighbors each.
struct Torus
{
  explicit Torus(int sides)
    : Points(sides * sides, 3)
  {
    const auto at = [sides](int i, int j) { return (i % sides) * sides + j % sides; };
    for (int i = 0; i < sides; ++i)
    {
      for (int j = 0; j < sides; ++j)
      {
        const double u = 2 * EIGEN_PI * i / sides;
        const double v = 2 * EIGEN_PI * j / sides;
        const double radius = 10 + 4 * std::cos(v);
        this->Points.row(at(i, j)) << radius * std::cos(u), radius * std::sin(u), 4 * std::sin(v);
        this->Faces.Append({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
      }
    }
  }
  PointList Points;
  FaceList Faces;
};

// The edge-midpoint mesh of triangles: a triangle per face, a polygon per vertex.
void MidpointMesh(const PointList& points, const TriangleList& triangles, PointList& midpoints,
  FaceList& faces)
{
  std::map<std::pair<int, int>, int> edges;
  std::map<int, std::map<int, int>> around;
  const auto midpoint = [&](int a, int b)
  { return edges.emplace(std::minmax(a, b), static_cast<int>(edges.size())).first->second; };
  for (Eigen::Index triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    const auto t = triangles.row(triangle);
    const int m[3] = { midpoint(t[0], t[1]), midpoint(t[1], t[2]), midpoint(t[2], t[0]) };
    faces.Append({ m[0], m[1], m[2] });
    for (int corner = 0; corner < 3; ++corner)
    {
      around[t[corner]][m[corner]] = m[(corner + 2) % 3];
    }
  }
  for (const auto& [vertex, next] : around)
  {
    int at = next.begin()->first;
    for (std::size_t step = 0; step < next.size(); ++step, at = next.at(at))
    {
      faces.Connectivity.push_back(at);
    }
    faces.Offsets.push_back(static_cast<int>(faces.Connectivity.size()));
  }
  midpoints.resize(static_cast<Eigen::Index>(edges.size()), 3);
  for (const auto& [edge, index] : edges)
  {
    midpoints.row(index) = 0.5 * (points.row(edge.first) + points.row(edge.second));
  }
}

ContourMesh Refined(const ContourMesh& mesh)
{
  const RefinedMesh refined = RefineFaces(mesh);
  return BuildContourMesh(static_cast<int>(refined.Parents.size()), refined.Faces);
}

} // namespace

TEST(MeshRefinement, TheSphereOfNBecomesThatOf2N)
{
  for (int n : { 1, 2, 3, 8 })
  {
    const TestSphere sphere(n);
    const ContourMesh mesh = Refined(sphere.Mesh);
    EXPECT_EQ(mesh.NumberOfPoints(), 6 * (2 * n) * (2 * n));
    int triangles = 0;
    for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
    {
      const int size = mesh.Faces.FaceSize(face);
      ASSERT_TRUE(size == 3 || size == 4);
      triangles += size == 3;
    }
    EXPECT_EQ(triangles, 8);
    EXPECT_EQ(mesh.EulerNumber(), 2);
    ASSERT_EQ(mesh.Contours.size(), 6u * n);
    for (const auto& contour : mesh.Contours)
    {
      EXPECT_EQ(contour.size(), 8u * n);
    }
    // Twice is the same again.
    EXPECT_EQ(Refined(mesh).NumberOfPoints(), 6 * (4 * n) * (4 * n));
  }
}

TEST(MeshRefinement, StaysEmbeddedAndOriented)
{
  for (int n : { 1, 2, 3, 8, 16 })
  {
    const TestSphere sphere(n);
    const ContourMesh mesh = Refined(sphere.Mesh);
    const double volume = EnclosedVolume({ sphere.Points(), sphere.Triangles() });
    for (double reach : { 0.1, 0.5, 1.0 })
    {
      const PointList points = RefinePoints(sphere.Mesh, sphere.Points(), reach);
      ASSERT_EQ(points.rows(), mesh.NumberOfPoints());
      EXPECT_EQ(CountSelfIntersections(points, mesh.Faces), 0) << n << " " << reach;
      // It cuts corners off.
      EXPECT_LT(EnclosedVolume({ points, mesh.Triangles }), volume);
      EXPECT_GT(EnclosedVolume({ points, mesh.Triangles }), (1 - 0.7 * reach) * volume);
    }
  }
}

TEST(MeshRefinement, OtherMeshesKeepTheirGenus)
{
  const Torus torus(12);
  const ContourMesh quads = BuildContourMesh(144, torus.Faces);
  PointList midpoints;
  FaceList faces;
  MidpointMesh(torus.Points, quads.Triangles, midpoints, faces);
  const ContourMesh medial = BuildContourMesh(static_cast<int>(midpoints.rows()), faces);
  const std::pair<const ContourMesh*, const PointList*> cases[] = { { &quads, &torus.Points },
    { &medial, &midpoints } };
  for (const auto& [mesh, points] : cases)
  {
    EXPECT_EQ(mesh->EulerNumber(), 0);
    const ContourMesh refined = Refined(*mesh);
    EXPECT_EQ(refined.EulerNumber(), 0);
    EXPECT_EQ(refined.NumberOfPoints(), 4 * mesh->NumberOfPoints());
    const PointList fine = RefinePoints(*mesh, *points, 1.0);
    EXPECT_EQ(CountSelfIntersections(fine, refined.Faces), 0);
    const double volume = 2 * EIGEN_PI * EIGEN_PI * 10 * 16;
    EXPECT_NEAR(EnclosedVolume({ fine, refined.Triangles }), volume, 0.2 * volume);
  }
}

TEST(MeshRefinement, ReachPullsFromTheParentsIntoTheOldTriangles)
{
  Torus torus(7);
  torus.Points(Eigen::seq(0, 48, 2), 2).array() += 1; // bends its quads
  const ContourMesh mesh = BuildContourMesh(49, torus.Faces);
  const RefinedMesh refined = RefineFaces(mesh);
  const PointList full = RefinePoints(mesh, torus.Points, 1);
  const PointList none = RefinePoints(mesh, torus.Points, 0);
  const double reach = 1e-3;
  const PointList little = RefinePoints(mesh, torus.Points, reach);
  double greatest = 0; // deviation of the full places from the triangles
  for (Eigen::Index triangle = 0; triangle < mesh.Triangles.rows(); ++triangle)
  {
    // A face's triangles are those of its shrunk image, too: the fan from its first corner.
    const int face = static_cast<int>(triangle / 2);
    const int first = mesh.Faces.Offsets[face];
    const Eigen::RowVector3d a = torus.Points.row(mesh.Triangles(triangle, 0));
    const Eigen::Vector3d normal = (torus.Points.row(mesh.Triangles(triangle, 1)) - a)
                                     .cross(torus.Points.row(mesh.Triangles(triangle, 2)) - a)
                                     .normalized();
    const int corners[3] = { first, first + (triangle % 2 == 0 ? 1 : 2),
      first + (triangle % 2 == 0 ? 2 : 3) };
    for (int corner : corners)
    {
      EXPECT_EQ(none.row(corner), torus.Points.row(refined.Parents[corner]));
      const double away = (little.row(corner) - none.row(corner)).norm();
      EXPECT_GT(away, 0.1 * reach);
      EXPECT_LT(away, 10 * reach);
      EXPECT_LT(std::abs((little.row(corner) - a).dot(normal.transpose())), 10 * reach * reach);
      greatest = std::max(greatest, std::abs((full.row(corner) - a).dot(normal.transpose())));
    }
  }
  EXPECT_GT(greatest, 0.05);
}

// Doo and Sabin's masks: a quad's new corner is 9/16, 3/16, 1/16, 3/16 of the old ones.
TEST(MeshRefinement, QuadsHaveTheBiquadraticMask)
{
  const Torus torus(7);
  const ContourMesh mesh = BuildContourMesh(49, torus.Faces);
  const PointList fine = RefinePoints(mesh, torus.Points, 1);
  for (int face = 0; face < mesh.Faces.NumberOfFaces(); ++face)
  {
    const int* v = mesh.Faces.Face(face);
    for (int corner = 0; corner < 4; ++corner)
    {
      const Eigen::RowVector3d expected =
        (9 * torus.Points.row(v[corner]) + 3 * torus.Points.row(v[(corner + 1) % 4]) +
          torus.Points.row(v[(corner + 2) % 4]) + 3 * torus.Points.row(v[(corner + 3) % 4])) /
        16;
      ASSERT_LT((fine.row(mesh.Faces.Offsets[face] + corner) - expected).norm(), 1e-12);
    }
  }
}

TEST(MeshRefinement, PartsFacesThatShareADiagonal)
{
  const PolygonMesh neck = NeckOfTwoFaces();
  const RefinedMesh refined = RefineFaces(BuildContourMesh(16, neck.Faces));
  EXPECT_TRUE(FaceHulls(PointList::Zero(64, 3), refined.Faces).FindOverlappingFaces().empty());
}

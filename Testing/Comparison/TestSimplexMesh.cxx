// The simplex mesh: that the dual of the sphere is one, that its triangles close it, and that ITK's
// filter with our forces ends where it should.
#include "SimplexBalloon.h"
#include "SimplexSphere.h"

#include "../Kernels/ExampleSurfaces.h"
#include "Mesh/SurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace FlipFree;

namespace
{

const Eigen::Vector3d Center(10, -20, 300);

SimplexBalloon::Pointer Balloon(const SimplexMesh& start, const SimplexBalloon::Force& force)
{
  auto filter = SimplexBalloon::New();
  filter->SetStart(start);
  filter->SetForce(force);
  filter->SetIterations(400);
  filter->SetVolumeTolerance(1e-4);
  return filter;
}

// Outward within a ball, inward beyond it.
SimplexBalloon::Force TowardsBall(const Eigen::Vector3d& center, double radius)
{
  return [=](const Eigen::Vector3d& point)
  { return 0.5 * std::max(-1.0, std::min(1.0, radius - (point - center).norm())); };
}

} // namespace

TEST(SimplexMesh, EveryVertexHasThreeNeighborsAroundTheOutwardNormal)
{
  for (const int n : { 1, 2, 9 })
  {
    const SimplexMesh mesh = MakeSimplexSphere(n, Center, 30);
    ASSERT_EQ(mesh.Points.rows(), 12 * n * n - 4);
    EXPECT_EQ(mesh.Faces, 6 * n * n);
    for (int vertex = 0; vertex < mesh.Points.rows(); ++vertex)
    {
      const Eigen::Vector3d point = mesh.Points.row(vertex).transpose() - Center;
      EXPECT_NEAR(point.norm(), 30, 1e-9);
      const auto& neighbors = mesh.Neighbors[vertex];
      EXPECT_EQ(std::set<int>(neighbors.begin(), neighbors.end()).size(), 3U);
      for (const int neighbor : neighbors)
      {
        const auto& back = mesh.Neighbors[neighbor];
        EXPECT_EQ(std::count(back.begin(), back.end(), vertex), 1);
      }
      const Eigen::Vector3d first = mesh.Points.row(neighbors[0]);
      const Eigen::Vector3d second = mesh.Points.row(neighbors[1]);
      const Eigen::Vector3d third = mesh.Points.row(neighbors[2]);
      EXPECT_GT((second - first).cross(third - first).dot(point), 0);
    }
  }
}

TEST(SimplexMesh, TrianglesCloseIt)
{
  const SimplexMesh mesh = MakeSimplexSphere(12, Center, 30);
  const PointList points = SurfacePoints(mesh, mesh.Points);
  ASSERT_EQ(points.rows(), mesh.Points.rows() + mesh.Faces);
  const FaceList faces = FacesOf(mesh.Triangles);
  const SurfaceTopology topology =
    MeasureTopology(faces, CollectEdges(static_cast<int>(points.rows()), faces));
  EXPECT_EQ(topology.Vertices, points.rows());
  EXPECT_EQ(topology.EulerNumber(), 2);
  EXPECT_EQ(topology.BoundaryEdges + topology.NonManifoldEdges + topology.MisorientedEdges, 0);
  const double ball = 4 * std::acos(-1) / 3 * 27000;
  EXPECT_NEAR(EnclosedVolume({ points, mesh.Triangles }) / ball, 1, 0.02); // facets cut corners
}

TEST(SimplexMesh, MiddlesAreThoseOfTheFacesCorners)
{
  const SimplexMesh mesh = MakeSimplexSphere(3, Center, 30);
  const PointList points = SurfacePoints(mesh, mesh.Points);
  std::vector<std::set<int>> corners(mesh.Faces);
  for (Eigen::Index i = 0; i < mesh.Triangles.rows(); ++i)
  {
    auto& face = corners[mesh.Triangles(i, 0) - mesh.Points.rows()];
    face.insert(mesh.Triangles(i, 1));
    face.insert(mesh.Triangles(i, 2));
  }
  for (int face = 0; face < mesh.Faces; ++face)
  {
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (const int corner : corners[face])
    {
      mean += mesh.Points.row(corner) / static_cast<double>(corners[face].size());
    }
    EXPECT_NEAR((points.row(mesh.Points.rows() + face) - mean).norm(), 0, 1e-9);
  }
}

TEST(SimplexMesh, BalloonFillsTheBallThatForcesPointTo)
{
  const SimplexMesh start = MakeSimplexSphere(12, Center, 10);
  const Eigen::Vector3d goal = Center + Eigen::Vector3d(2, 4, -3);
  const auto filter = Balloon(start, TowardsBall(goal, 40));
  filter->Update();
  EXPECT_LT(filter->GetElapsedIterations(), 400); // it settled
  const PointList points = filter->GetSurfacePoints();
  for (Eigen::Index i = 0; i < start.Points.rows(); ++i)
  {
    EXPECT_NEAR((points.row(i).transpose() - goal).norm(), 40, 0.5);
  }
}

TEST(SimplexMesh, InternalForcesSmoothADent)
{
  const auto lengthOfDent = [](double stiffness)
  {
    SimplexMesh start = MakeSimplexSphere(12, Eigen::Vector3d::Zero(), 30);
    start.Points.row(100) *= 0.8;
    const auto filter = Balloon(start, [](const Eigen::Vector3d&) { return 0.0; });
    filter->SetAlpha(stiffness);
    filter->SetIterations(20);
    filter->SetVolumeTolerance(0);
    filter->Update();
    EXPECT_EQ(filter->GetElapsedIterations(), 20);
    return 30 - filter->GetSurfacePoints().row(100).norm();
  };
  EXPECT_NEAR(lengthOfDent(0), 6, 1e-9);
  EXPECT_LT(lengthOfDent(0.2), 2);
}

TEST(SimplexMesh, SurvivesACollapse)
{
  const SimplexMesh start = MakeSimplexSphere(6, Center, 10);
  const auto filter = Balloon(start, [](const Eigen::Vector3d&) { return -1.0; });
  filter->Update();
  EXPECT_TRUE(filter->GetSurfacePoints().allFinite());
}
